#include "io/basics/atomic_file.h"
#include "io/basics/words.h"
#include "io/cards/hyperelastic/rubber_file_card.h"
#include "io/cli/card/card_words.h"
#include "io/cli/words/json_output.h"
#include "io/materials/hyperelastic_file.h"
#include "models/hyperelastic/hyperelastic_law.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <ostream>

namespace viscard {
namespace {

void require_rubber_target(const CardWords& words) {
  const auto& known = rubber_card_targets();
  if (std::find(known.begin(), known.end(), words.target) != known.end()) return;
  throw UsageError(words.material + " is a law of rubber, and --for " + words.target +
                   " has no card of rubber; use " + listed(known));
}

}  // namespace

bool is_rubber(const CardWords& words) {
  return !words.list && words.check.empty() && words.prove.empty() && words.deck.empty() &&
         looks_like_hyperelastic_file(words.material);
}

int write_rubber_card(const CardWords& words, Streams& streams) {
  require_rubber_target(words);
  const HyperelasticFile file = read_hyperelastic(words.material, words.plausible);
  RubberCardOptions options;
  options.target = words.target;
  options.units = words.units.empty() ? "SI" : words.units;
  options.bulk_Pa = words.bulk_Pa;
  options.density_kg_m3 = words.density_kg_m3;
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
    nlohmann::ordered_json json;
    json["target"] = words.target;
    json["units"] = options.units;
    json["out"] = words.out;
    json["law"] = name_of(file.law.form);
    json["E0_Pa"] = file.E0_Pa;
    json["E_inf_Pa"] = file.E_inf_Pa;
    json["terms"] = words.elastic_only.empty() ? file.terms.size() : 0;
    json["warnings"] = doubt.empty() ? Words{} : Words{doubt};
    if (words.out.empty()) json["card"] = text;
    print_json({"viscard-card-rubber/1", {words.material}}, json, streams);
  } else if (words.out.empty()) {
    streams.out << text;
  } else {
    streams.out << "wrote " << words.out << "\n";
  }
  if (!doubt.empty()) streams.err << "viscard: warning: " << doubt << "\n";
  return kDone;
}

}  // namespace viscard
