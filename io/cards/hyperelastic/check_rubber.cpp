#include "io/cards/hyperelastic/check_rubber.h"

#include "io/cards/card_sum.h"
#include "io/cards/header_name.h"
#include "io/cards/hyperelastic/rubber_card.h"
#include "io/cards/hyperelastic/rubber_mistakes.h"
#include "io/cards/list_differences.h"
#include "io/cards/plausible_card.h"
#include "io/cards/unit_system.h"
#include "io/materials/material_json.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

// The number at a place of viscard's own header, or nothing.
std::optional<double> number_at(const std::string& text, std::size_t at) {
  if (at == std::string::npos || stated_rubber_target(text).empty()) return std::nullopt;
  return number_from_text(std::string_view(text).substr(at, text.find_first_of(" \n", at) - at));
}

// That of the line that begins with this mark.
std::optional<double> stated_number(const std::string& text, const std::string& mark) {
  return number_at(text, behind_mark(text, mark));
}

// Shear modulus at rest of the law that stands in the card.
double shear_in_card_Pa(const RubberParts& parts, bool is_long_term) {
  return youngs_modulus_Pa(parts.law) / 3.0 *
         (is_long_term ? 1.0 - sum_of_shares(parts.terms) : 1.0);
}

// Bulk modulus and density that the card should have: as asked for, of the file, or of viscard's header.
void take_volume(const std::string& text, const HyperelasticFile* file,
                 const RubberCheckOptions& options, const ReadRubber& read, RubberParts& expected) {
  const auto first = [](const auto&... all) {
    std::optional<double> out;
    ((out = out ? out : all), ...);
    return out;
  };
  const std::optional<double> of_density = file == nullptr ? std::nullopt : file->density_kg_m3;
  if (expected.foam) {
    const auto first_density = options.density_kg_m3 ? options.density_kg_m3
                               : of_density          ? of_density
                                                     : stated_number(text, "density ");
    expected.density_kg_m3 = first_density.value_or(0.0);
    return;
  }
  const std::optional<double> of_file = file == nullptr ? std::nullopt : file->bulk_Pa;
  const auto has = [&](const char* words) {
    return !stated_rubber_target(text).empty() && text.find(words) != std::string::npos;
  };
  const std::optional<double> of_header =
      has(" incompressible: use hybrid") ? std::optional(0.0)
      : has(kUsualBulkText) ? std::optional(kUsualBulkRatio * youngs_modulus_Pa(expected.law) / 3.0)
                            : stated_number(text, "bulk modulus ");
  expected.bulk_Pa = first(options.bulk_Pa, of_file, of_header);
  expected.density_kg_m3 =
      first(options.density_kg_m3, file == nullptr ? std::nullopt : file->density_kg_m3,
            stated_number(text, "density "))
          .value_or(0.0);
  if (!expected.bulk_Pa || read.poisson == 0.0) return;
  const double shear_Pa = shear_in_card_Pa(expected, read.is_long_term), K = *expected.bulk_Pa;
  expected.poisson = (3.0 * K - 2.0 * shear_Pa) / (6.0 * K + 2.0 * shear_Pa);
}

// Without the file of the law: numbers that viscard's own header states otherwise.
std::vector<CardFinding> header_findings(const std::string& text, const RubberParts& found,
                                         const RubberParts& expected) {
  std::vector<CardFinding> out;
  const auto compare = [&](const std::string& what, double a, double b) {
    // The header has ten digits, a column of LS-DYNA six and more.
    constexpr double kRounding = 2e-5;
    if (relative_mismatch(a, b) <= kRounding) return;
    out.push_back({"header-differs",
                   fmt::format("{} is {:.9g}, {:.6g} times the {:.9g} stated", what, a, a / b, b),
                   true});
  };
  const std::string modulus = "Young's modulus at rest ";  // stands behind the relaxation
  const std::size_t at = text.find(modulus);
  if (const auto E = number_at(text, at == std::string::npos ? at : at + modulus.size()))
    compare("Young's modulus at rest",
            found.foam ? youngs_modulus_Pa(*found.foam) : youngs_modulus_Pa(found.law), *E);
  if (expected.bulk_Pa && expected.poisson == 0.0)
    compare("the bulk modulus", found.bulk_Pa.value_or(0.0), *expected.bulk_Pa);
  // Ten columns cut Poisson's ratio off, not the bulk modulus.
  constexpr double kCut = 2e-5;
  if (expected.poisson != 0.0 && relative_mismatch(found.poisson, expected.poisson) > kCut)
    compare("the bulk modulus, by Poisson's ratio", *found.bulk_Pa, *expected.bulk_Pa);
  if (found.damage) {
    const double values[] = {found.damage->r, found.damage->m_Pa, found.damage->beta};
    const char* const marks[] = {"damage r", "damage m", "damage beta"};
    for (std::size_t i = 0; i < 3; ++i) {
      if (const auto stated = stated_number(text, std::string(marks[i]) + " "))
        compare(std::string("the ") + marks[i], values[i], *stated);
    }
  }
  if (expected.density_kg_m3 > 0.0)
    compare("the density", found.density_kg_m3, expected.density_kg_m3);
  return out;
}

// Rubber hardly changes its volume.
std::optional<CardFinding> soft_volume(const std::string& text, const ReadRubber& read) {
  if (read.foam) return std::nullopt;
  constexpr double kLeastRatio = 10.0;
  const double ratio = read.bulk_Pa / (youngs_modulus_Pa(read.law) / 3.0);
  if (read.bulk_Pa == 0.0 || ratio >= kLeastRatio) return std::nullopt;
  const bool is_negative = ratio < 2.0 / 3.0 * (1.0 - 1e-6);
  return CardFinding{"soft-volume",
                     fmt::format("the bulk modulus is {:.4g} times the shear modulus at rest{}; "
                                 "rubber has about 1000 times",
                                 ratio, is_negative ? ", so that Poisson's ratio is negative" : ""),
                     is_negative && text.find(kPlausibleOffText) == std::string::npos};
}

// What ten columns of lsdyna lose of the law: the difference that viscard's own card has. At most 1 %.
double rounding_of(const RubberParts& expected, const RubberCheckOptions& options,
                   const ReadRubber& read) {
  if (options.target != "lsdyna") return 0.0;
  constexpr double kAnyDensity_kg_m3 = 1000.0, kMost = 1e-2;
  RubberCardOptions writing{.target = options.target, .units = read.units->name};
  writing.density_kg_m3 = read.density_kg_m3 > 0.0 ? read.density_kg_m3 : kAnyDensity_kg_m3;
  if (read.bulk_Pa > 0.0) writing.bulk_Pa = read.bulk_Pa;
  writing.may_approximate = true;
  if (expected.foam) {
    writing.bulk_Pa.reset();
    RubberParts rounded;
    rounded.foam =
        read_rubber_card(foam_card(*expected.foam, writing), options.target, read.units->name).foam;
    RubberParts law_alone = expected;
    law_alone.density_kg_m3 = 0.0;
    return std::min(kMost, largest_mismatch(rounded, law_alone));
  }
  const ReadRubber own = read_rubber_card(rubber_card(expected.law, expected.terms, writing),
                                          options.target, read.units->name);
  const RubberParts rounded{own.law, own.terms};
  return std::min(kMost, largest_mismatch(rounded, in_form(expected, own.law.form)));
}

}  // namespace

RubberCheck check_rubber_card(const std::string& text, const HyperelasticFile* file,
                              const RubberCheckOptions& options) {
  RubberCheck check{.read = read_rubber_card(text, options.target, options.units)};
  check.findings = check.read.findings;
  check.tolerance = options.tolerance.value_or(1e-6);
  const RubberParts found{check.read.law,           check.read.terms,   check.read.bulk_Pa,
                          check.read.density_kg_m3, check.read.poisson, check.read.damage,
                          check.read.foam};
  if (file != nullptr) {
    RubberParts expected{file->law, file->terms};
    expected.damage = file->damage;
    expected.foam = file->foam;
    if (!options.elastic_only.empty()) {
      expected.law = law_without_terms(file->law, file->terms, options.elastic_only);
      expected.terms.clear();
    }
    if (!options.tolerance) {
      constexpr double kMore = 1.5;  // another program may round the last digit differently
      check.tolerance =
          std::max(check.tolerance, kMore * rounding_of(expected, options, check.read));
    }
    take_volume(text, file, options, check.read, expected);
    if (!expected.foam && !found.foam) expected = in_form(expected, found.law.form);
    check.difference = largest_mismatch(found, expected);
    if (*check.difference > check.tolerance) {
      const auto why = explained(found, expected, options.target, *check.read.units);
      check.findings.insert(check.findings.end(), why.begin(), why.end());
    }
  } else {
    RubberParts expected{check.read.law, check.read.terms};
    expected.damage = check.read.damage;
    expected.foam = check.read.foam;
    take_volume(text, file, options, check.read, expected);
    const auto differ = header_findings(text, found, expected);
    check.findings.insert(check.findings.end(), differ.begin(), differ.end());
    const CardScale scale{
        found.foam ? youngs_modulus_Pa(*found.foam) : youngs_modulus_Pa(found.law),
        found.density_kg_m3, check.read.units};
    const auto doubt = implausible_finding(text, scale, options.plausible);
    if (check.findings.empty() && doubt) check.findings.push_back(*doubt);
  }
  // Behind what may explain it.
  if (const auto soft = soft_volume(text, check.read)) check.findings.push_back(*soft);
  const bool has_mistake =
      std::any_of(check.findings.begin(), check.findings.end(),
                  [](const CardFinding& finding) { return finding.is_mistake; });
  const bool is_explained = file != nullptr ? !check.findings.empty() : has_mistake;
  if (const auto doubt = sum_finding(text, file != nullptr); doubt && !is_explained)
    check.findings.push_back(*doubt);
  check.agrees = (!check.difference || *check.difference <= check.tolerance) && !has_mistake;
  return check;
}

}  // namespace viscard
