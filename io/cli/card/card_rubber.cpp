#include "io/basics/atomic_file.h"
#include "io/basics/words.h"
#include "io/cards/hyperelastic/rubber_card.h"
#include "io/cards/unit_system.h"
#include "io/cli/card/card_words.h"
#include "io/cli/words/json_output.h"
#include "io/materials/hyperelastic_file.h"
#include "models/hyperelastic/law_stability.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <ostream>

namespace viscard {
namespace {

// What is known about the law, one line each.
std::vector<std::string> header_lines(const HyperelasticFile& file, const CardWords& words,
                                      const std::string& units) {
  std::vector<std::string> lines{
      "viscard card: " + name_of(file.law.form) + " for " + words.target + ", units " +
          unit_system(units).description,
      "elastic at any rate: the law has no relaxation. Young's modulus at rest " +
          viscard::text_of(youngs_modulus_Pa(file.law), 5) + " Pa"};
  if (words.bulk_Pa) {
    lines.push_back("bulk modulus " + viscard::text_of(*words.bulk_Pa, 5) + " Pa");
  } else if (words.target == "abaqus" || words.target == "ansys") {
    lines.push_back("incompressible: use hybrid (mixed) elements, or --bulk-modulus");
  } else {
    lines.push_back(
        "bulk modulus 1000 times the shear modulus at rest, chosen because the solver needs one");
  }
  for (std::size_t d = 0; d < file.measured.size(); ++d) {
    const auto& measured = file.measured[d];
    const StableRange stable = stable_range(file.law, static_cast<Deformation>(d));
    lines.push_back(
        fmt::format("{}: {}; stable {} to {}", deformation_names()[d],
                    measured ? "stretches " + viscard::text_of(measured->low, 4) + " to " +
                                   viscard::text_of(measured->high, 4) + " measured"
                             : std::string("not measured"),
                    viscard::text_of(stable.low, 3),
                    viscard::text_of(stable.high, 3) + (stable.high_is_open ? " and more" : "")));
  }
  for (const auto& raw : file.raw_files) lines.push_back(raw.file + " sha256 " + raw.sha256);
  return lines;
}

std::string with_header(const std::vector<std::string>& lines, const std::string& target,
                        const std::string& card) {
  std::string text;
  for (const std::string& line : lines) {
    if (target == "febio") {
      text += "<!-- " + line + " -->\n";
    } else {
      text += (target == "ansys" ? "! " : "** ") + line + "\n";
    }
  }
  return text + card;
}

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
  const HyperelasticFile file = read_hyperelastic(words.material);
  if (!file.is_trustworthy && !words.accepts_flags) {
    std::string why;
    for (const std::string& text : file.defects) why += (why.empty() ? "" : "; ") + text;
    throw std::runtime_error(words.material + ": the law is not to be trusted: " + why +
                             ". --accept-flags writes it all the same");
  }
  RubberCardOptions options;
  options.target = words.target;
  options.units = words.units.empty() ? "SI" : words.units;
  options.bulk_Pa = words.bulk_Pa;
  const std::string text = with_header(header_lines(file, words, options.units), words.target,
                                       rubber_card(file.law, options));
  if (!words.out.empty()) write_file(words.out, text, words.force);
  if (words.json) {
    nlohmann::ordered_json json;
    json["target"] = words.target;
    json["units"] = options.units;
    json["out"] = words.out;
    json["law"] = name_of(file.law.form);
    json["E0_Pa"] = youngs_modulus_Pa(file.law);
    if (words.out.empty()) json["card"] = text;
    print_json({"viscard-card-rubber/1", {words.material}}, json, streams);
  } else if (words.out.empty()) {
    streams.out << text;
  } else {
    streams.out << "wrote " << words.out << "\n";
  }
  return kDone;
}

}  // namespace viscard
