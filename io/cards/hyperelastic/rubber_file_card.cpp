#include "io/cards/hyperelastic/rubber_file_card.h"

#include "io/basics/program.h"
#include "io/basics/written_path.h"
#include "io/cards/card_header.h"
#include "io/cards/card_sum.h"
#include "io/cards/header_name.h"
#include "io/cards/hyperelastic/check_rubber.h"
#include "io/cards/targets/card_targets.h"
#include "io/cards/unit_system.h"
#include "io/materials/material_json.h"
#include "models/hyperelastic/law_stability.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace viscard {
namespace {

constexpr int kDigits = 10;  // of numbers that --check compares

std::string relaxation_line(const HyperelasticFile& file, const RubberCardOptions& options) {
  const std::string E0 = text_of(file.E0_Pa, kDigits) + " Pa",
                    E_inf = text_of(file.E_inf_Pa, kDigits) + " Pa";
  if (file.terms.empty()) {
    return "elastic at any rate: the law has no relaxation. Young's modulus at rest " + E0;
  }
  const std::string count = counted(file.terms.size(), "term") + " of relaxation";
  if (options.elastic_only == "long-term") {
    return "elastic: " + count +
           " left out, the law after all relaxation kept. Young's modulus at rest " + E_inf +
           ", at once it is " + E0;
  }
  if (!options.elastic_only.empty()) {
    return "elastic: " + count + " left out, the law at once kept. Young's modulus at rest " + E0 +
           ", after all relaxation it is " + E_inf;
  }
  return count + ": Young's modulus at rest " + E0 + " at once, " + E_inf + " after all";
}

// What is known about the law, one line each.
std::vector<std::string> header_lines(const HyperelasticFile& file, const CardTarget& target,
                                      const RubberCardOptions& options) {
  const LawColumn& laws = *target.laws;
  std::vector<std::string> lines{
      "viscard card: " + name_of(file) + (file.damage ? std::string("+") + kMullinsName : "") +
          " for " + options.target,
      fmt::format("units: {} ({})", options.units, unit_system(options.units).description),
      relaxation_line(file, options)};
  if (!file.terms.empty() && options.elastic_only.empty()) {
    lines.push_back("terms: " + laws.terms);
  }
  const std::string& keyword =
      file.damage && !laws.damage.laws.empty() ? laws.damage.laws : laws.keywords.of(file.law.form);
  lines.push_back("conventions: " +
                  (file.foam ? laws.keywords.foam : keyword + "; volume " + laws.volume));
  if (file.damage) {
    lines.push_back(std::string("damage by the first loading, ") + kMullinsName +
                    ": eta = 1 - erf((W_m - W)/(m + beta W_m))/r. " + laws.damage.convention);
    lines.push_back("damage r " + text_of(file.damage->r, kDigits));
    lines.push_back("damage m " + text_of(file.damage->m_Pa, kDigits) + " Pa");
    lines.push_back("damage beta " + text_of(file.damage->beta, kDigits));
  }
  lines.push_back("evidence: " + (file.foam && options.target == "calculix"
                                      ? std::string("one cube run in CalculiX 2.20")

                                      : laws.evidence));
  if (options.density_kg_m3) {
    lines.push_back("density " + text_of(*options.density_kg_m3, kDigits) + " kg/m3");
  }
  if (file.accepts_implausible || options.plausible == Plausible::kOff) {
    lines.push_back(kPlausibleOffText);
  }
  if (file.is_edited) lines.push_back(std::string("note: ") + kEditedText);
  if (!file.card_doubt.empty()) lines.push_back("note: " + file.card_doubt);
  if (options.bulk_Pa) {
    lines.push_back("bulk modulus " + text_of(*options.bulk_Pa, kDigits) + " Pa");
    const std::string doubt = doubtful_bulk_modulus(file, options);
    if (!doubt.empty()) lines.push_back("warning: " + doubt);
  } else if (file.foam) {
    lines.push_back("at rest: shear modulus " + text_of(shear_modulus_Pa(*file.foam), kDigits) +
                    " Pa, Poisson's ratio " + text_of(poisson_ratio(*file.foam), kDigits));
  } else if (laws.may_be_incompressible) {
    lines.push_back("incompressible: use hybrid (mixed) elements, or --bulk-modulus");
  } else {
    lines.push_back(std::string(kUsualBulkText) + ", chosen because the solver needs one");
  }
  if (file.E0_interval_95.high > file.E0_interval_95.low) {
    lines.push_back("95 % intervals: E0 [" + text_of(file.E0_interval_95.low) + ", " +
                    text_of(file.E0_interval_95.high) + "] Pa, E_inf [" +
                    text_of(file.E_inf_interval_95.low) + ", " +
                    text_of(file.E_inf_interval_95.high) + "] Pa");
  }
  if (file.foam) {
    lines.push_back("measured: " + (file.foam_tests.empty() ? "nothing" : file.foam_tests));
    for (std::size_t t = 0; t < foam_test_names().size(); ++t) {
      const StableRange stable = stable_range(*file.foam, static_cast<FoamTest>(t));
      if (stable.low_is_open && stable.high_is_open) continue;
      lines.push_back(
          fmt::format("{}: stable {} to {}", foam_test_names()[t], text_of(stable.low, 3),
                      text_of(stable.high, 3) + (stable.high_is_open ? " and more" : "")));
    }
  }
  for (std::size_t d = 0; d < file.measured.size() && !file.foam; ++d) {
    const auto& measured = file.measured[d];
    const StableRange stable = stable_range(file.law, static_cast<Deformation>(d));
    lines.push_back(
        fmt::format("{}: {}; stable {} to {}", deformation_names()[d],
                    measured ? "stretches " + text_of(measured->low, 4) + " to " +
                                   text_of(measured->high, 4) + " measured"
                             : std::string("not measured"),
                    text_of(stable.low, 3),
                    text_of(stable.high, 3) + (stable.high_is_open ? " and more" : "")));
  }
  std::vector<std::string> paths;
  for (const auto& raw : file.raw_files) paths.push_back(raw.file);
  const WrittenValues written(paths, "");
  for (const auto& raw : file.raw_files)
    lines.push_back("raw data " + name_in_header(written(raw.file)) +
                    (raw.sha256.empty() ? " in memory" : " sha256 " + raw.sha256));
  if (!options.file_sha256.empty())
    lines.push_back("material file " + name_in_header(written_path(options.file_name)) +
                    " sha256 " + options.file_sha256);
  lines.push_back(unsealed_sum_line());
  if (!options.created_at.empty()) lines.push_back("created " + options.created_at);
  if (!options.command.empty()) lines.push_back("by " + options.command);
  lines.push_back(program_with_version());
  return lines;
}

// Throws if the text does not say what the file does.
void read_back(const std::string& text, const HyperelasticFile& file, const std::string& name,
               const RubberCardOptions& options) {
  const RubberCheck check = check_rubber_card(text, &file,
                                              {.target = options.target,
                                               .units = options.units,
                                               .bulk_Pa = options.bulk_Pa,
                                               .density_kg_m3 = options.density_kg_m3,
                                               .elastic_only = options.elastic_only});
  if (check.agrees) return;
  throw std::runtime_error(name + ": the card for " + options.target +
                           " read back is not the law of the file" +
                           (check.findings.empty() ? "" : ": " + check.findings[0].text));
}

}  // namespace

namespace {

// Of the law at rest, at once; rubber hardly changes its volume.
double shear_modulus_Pa(const HyperelasticFile& file) {
  return file.E0_Pa / 3.0;
}

}  // namespace

void refuse_bulk_modulus(const HyperelasticFile& file, const RubberCardOptions& options) {
  if (options.bulk_Pa && file.foam)
    throw std::invalid_argument("the bulk modulus of a foam follows from its constants; omit it");
  if (!options.bulk_Pa || options.plausible == Plausible::kOff) return;
  const double least_Pa = 2.0 * shear_modulus_Pa(file) / 3.0;
  if (*options.bulk_Pa >= least_Pa) return;
  throw std::invalid_argument(
      text_with_unit(*options.bulk_Pa, "Pa") + " is below 2G/3 = " + text_of(least_Pa, 4) +
      " Pa, where G is the shear modulus at rest: the Poisson ratio would be negative. Rubber has "
      "1 to 3 GPa, such as \"2 GPa\"; if the value is right, add --plausible off");
}

std::string doubtful_bulk_modulus(const HyperelasticFile& file, const RubberCardOptions& options) {
  constexpr double kLeastRatio = 10.0;
  if (!options.bulk_Pa) return "";
  const double ratio = *options.bulk_Pa / shear_modulus_Pa(file);
  if (ratio >= kLeastRatio) return "";
  return "the bulk modulus is " + text_of(ratio, 3) +
         " times the shear modulus at rest; rubber has about 1000 times, and below " +
         text_of(kLeastRatio) + " it loses volume visibly";
}

std::string rubber_file_card(const HyperelasticFile& file, const std::string& name,
                             const RubberCardOptions& options) {
  if (!file.is_trustworthy && !options.accepts_flags) {
    std::string why;
    for (const std::string& text : file.defects) why += (why.empty() ? "" : "; ") + text;
    throw std::runtime_error(name + ": the law is not to be trusted: " + why +
                             ". --accept-flags writes it all the same");
  }
  refuse_bulk_modulus(file, options);
  if (!options.elastic_only.empty() && file.terms.empty()) {
    throw std::invalid_argument(
        name +
        ": --elastic-only is for laws with terms of relaxation, and this one has none; omit it");
  }
  const CardTarget& target = law_target(options.target);
  const std::string card = file.foam ? foam_card(*file.foam, options)
                                     : rubber_card(file.law, file.terms, options, file.damage);
  const std::string text =
      sealed(as_comments(header_lines(file, target, options), target.comment) + card);
  read_back(text, file, name, options);
  return text;
}

}  // namespace viscard
