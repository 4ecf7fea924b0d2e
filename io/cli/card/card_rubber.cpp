#include "io/basics/atomic_file.h"
#include "io/basics/timestamp.h"
#include "io/basics/words.h"
#include "io/cards/hyperelastic/rubber_file_card.h"
#include "io/cards/hyperelastic/rubber_targets.h"
#include "io/cli/card/card_words.h"
#include "io/cli/words/json_output.h"
#include "io/materials/hyperelastic_file.h"
#include "models/hyperelastic/hyperelastic_law.h"

#include <algorithm>
#include <filesystem>
#include <ostream>

namespace viscard {
namespace {

void require_rubber_target(const CardWords& words) {
  const auto& known = rubber_card_targets();
  if (std::find(known.begin(), known.end(), words.target) != known.end()) return;
  throw UsageError(words.material + " is a law of rubber, and --for " + words.target +
                   " has no card of rubber; use " + listed(known));
}

void show_rubber_card(ResultVisitor& v, const HyperelasticFile& file, const CardWords& words,
                      const std::string& doubt, const std::string& text) {
  v("target", words.target, "solver of the card");
  v("units", words.units.empty() ? "SI" : words.units, "unit system");
  v("out", words.out, "the card; empty: stdout");
  v("law", name_of(file), "name of the law");
  v("E0_Pa", file.E0_Pa, "Young's modulus at rest, at once");
  v("E_inf_Pa", file.E_inf_Pa, "Young's modulus at rest after all relaxation; E0_Pa without terms");
  v("terms", words.elastic_only.empty() ? file.terms.size() : 0,
    "number of terms of relaxation in the card; 0 for an elastic law and with --elastic-only");
  v.when(file.damage.has_value(),
         [&] { v("damage", kMullinsName, "softening by the first loading, beside the law"); });
  v("warnings", doubt.empty() ? Words{} : Words{doubt}, "what is doubtful about the card");
  v.when(words.out.empty(), [&] { v("card", text, "the card itself, without --out"); });
}

}  // namespace

DescribedResult result_of_rubber_card() {
  return {"card-rubber", "viscard card of a law of rubber", {[](ResultVisitor& v) {
            show_rubber_card(v, {}, {}, "", "");
          }}};
}

bool is_rubber(const CardWords& words) {
  return !words.list && words.check.empty() && words.prove.empty() && words.deck.empty() &&
         looks_like_hyperelastic_file(words.material);
}

int write_rubber_card(const CardWords& words, Streams& streams) {
  require_rubber_target(words);
  const HyperelasticFile file = read_hyperelastic(words.material, words.plausible);
  const bool has_density = rubber_target(words.target).has_density;
  if (!has_density && words.density_kg_m3) {
    throw UsageError("cards for " + words.target +
                     " have no place for a density, the solver that uses them has; omit --density");
  }
  RubberCardOptions options;
  options.file_sha256 = sha256_as_read(words.material);
  options.file_name = std::filesystem::path(words.material).filename().string();
  if (!words.is_reproducible) {
    options.created_at = now_iso8601();
    options.command = words.command_line;
  }
  options.target = words.target;
  options.units = words.units.empty() ? "SI" : words.units;
  options.bulk_Pa = words.bulk_Pa ? words.bulk_Pa : file.bulk_Pa;
  options.density_kg_m3 = words.density_kg_m3 ? words.density_kg_m3 : file.density_kg_m3;
  if (!has_density) options.density_kg_m3.reset();
  options.accepts_flags = words.accepts_flags;
  options.may_approximate = words.may_approximate;
  options.elastic_only = words.elastic_only;
  options.plausible = words.plausible;
  try {
    refuse_bulk_modulus(file, options);
  } catch (const std::invalid_argument& error) {
    throw UsageError("--bulk-modulus: " + std::string(error.what()));
  }
  const std::string doubt = doubtful_bulk_modulus(file, options);
  const std::string text = rubber_file_card(file, words.material, options);
  if (!words.out.empty()) write_file(words.out, text, words.force);
  if (words.json) {
    print_result(
        {"viscard-card-rubber/1", {words.material}},
        [&](ResultVisitor& v) { show_rubber_card(v, file, words, doubt, text); }, streams);
  } else if (words.out.empty()) {
    streams.out << text;
  } else {
    streams.out << "wrote " << words.out << "\n";
  }
  if (!doubt.empty()) streams.err << "viscard: warning: " << doubt << "\n";
  return kDone;
}

}  // namespace viscard
