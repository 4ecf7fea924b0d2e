#include "io/cards/check_card.h"

#include "io/cards/card.h"
#include "io/cards/card_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>

namespace viscard {
namespace {

constexpr double kExactEnough = 1e-6;  // of E(t): seven digits typed by hand
constexpr double kHandTyped = 2e-3;    // of a single number: digits a hand may leave out

bool has_mistake(const std::vector<CardFinding>& findings) {
  return std::any_of(findings.begin(), findings.end(),
                     [](const CardFinding& finding) { return finding.is_mistake; });
}

double largest_G_difference(const Material& one, const Material& reference,
                            const std::vector<double>& times_s) {
  const PronySeries first = shear_series(one), second = shear_series(reference);
  double largest = 0.0;
  for (const double time_s : times_s) {
    const double expected_Pa = relaxation_modulus_Pa(second, time_s);
    largest = std::max(largest, std::abs(relaxation_modulus_Pa(first, time_s) / expected_Pa - 1.0));
  }
  return largest;
}

void note_times_outside_window(const Material& reference, CardCheck& check) {
  if (!(reference.valid.t_max_s > 0.0)) return;
  for (const MaterialTerm& term : check.read.material.terms) {
    if (term.tau_s >= reference.valid.t_min_s && term.tau_s <= reference.valid.t_max_s) continue;
    check.findings.push_back(
        {"tau-outside-window",
         fmt::format("tau = {:g} s lies outside the measured window {:g} to {:g} s", term.tau_s,
                     reference.valid.t_min_s, reference.valid.t_max_s),
         false});
  }
}

// What the target's fixed columns alone make of E(t), and no mistake of anybody's.
double rounding_of_columns(const Material& reference, const ReadCard& read) {
  try {
    const Card card = write_card(reference, {.target = read.understood.name,
                                             .units = read.units.name,
                                             .may_approximate = true,
                                             .accepts_flags = true});
    const Material ruled = with_bulk_rule(reference, read.understood.bulk);
    return largest_E_difference(card.written, ruled, comparison_times_s(reference));
  } catch (const std::invalid_argument&) {
    return 0.0;  // the target does not take this material at all
  }
}

// E(t) of a nearly incompressible polymer hardly depends on its bulk modulus; what the solver makes
// of a pillar or a layer does.
std::optional<CardFinding> bulk_finding(const ReadCard& read, const Material& reference) {
  const auto bulk_Pa = [](const Material& material) {
    return material.E0_Pa / (3.0 * (1.0 - 2.0 * material.nu));  // infinite at 0.5
  };
  const Material& found = read.material;
  if (!(found.E0_Pa > 0.0) || found.nu == reference.nu) return std::nullopt;
  const double found_Pa = bulk_Pa(found), expected_Pa = bulk_Pa(reference);
  if (std::abs(found_Pa / expected_Pa - 1.0) <= kHandTyped) return std::nullopt;
  return CardFinding{
      "poisson-ratio",
      fmt::format(
          "nu is {:g} and the material's {:g}: the bulk modulus is {:.3g} Pa where it should "
          "be {:.3g} Pa",
          found.nu, reference.nu, found_Pa, expected_Pa),
      true};
}

std::optional<CardFinding> density_finding(const ReadCard& read, const Material& reference) {
  const double found = read.material.rho_kg_m3, expected = reference.rho_kg_m3;
  const bool has_place = read.understood.name != "mfront";
  if (!(expected > 0.0) || !has_place || !(read.material.E0_Pa > 0.0)) return std::nullopt;
  if (!(found > 0.0)) {
    return CardFinding{"density-missing",
                       fmt::format("the card gives no density; the material's is {:g} kg/m3, which "
                                   "dynamic steps and weight need",
                                   expected),
                       false};
  }
  if (std::abs(found / expected - 1.0) <= kHandTyped) return std::nullopt;
  return CardFinding{
      "density", fmt::format("the density is {:g} kg/m3 and the material's {:g}", found, expected),
      true};
}

std::optional<CardFinding> shift_finding(const ReadCard& read, const Material& reference) {
  const bool is_wanted = reference.shift && reference.shift->law == ShiftLaw::kWlf;
  if (!is_wanted || !read.understood.takes_wlf) return std::nullopt;
  const TemperatureShift& expected = *reference.shift;
  if (!read.material.shift) {
    return CardFinding{"shift-missing",
                       fmt::format("the material has a WLF shift ({:g}, {:g} K at {:g} C) and the "
                                   "card none: it holds at {:g} C only",
                                   expected.C1, expected.C2_K, expected.T_ref_C, expected.T_ref_C),
                       true};
  }
  const TemperatureShift& found = *read.material.shift;
  const auto is_close = [](double a, double b) {
    return std::abs(a - b) <= kHandTyped * std::max(1.0, std::abs(b));
  };
  const bool is_C_right = is_close(found.C1, expected.C1) && is_close(found.C2_K, expected.C2_K);
  if (is_C_right && is_close(found.T_ref_C, expected.T_ref_C)) return std::nullopt;
  if (is_C_right && is_close(found.T_ref_C + kAbsoluteZero_C, expected.T_ref_C)) {
    return CardFinding{"reference-temperature-in-kelvin",
                       "the reference temperature is in K; these cards count in C", true};
  }
  constexpr double kLn10 = 2.302585092994046;
  if (is_close(found.C1, kLn10 * expected.C1) && is_close(found.C2_K, expected.C2_K)) {
    return CardFinding{"natural-logarithm-C1",
                       "C1 is that of ln a_T; this field wants that of log10 a_T", true};
  }
  return CardFinding{
      "shift-differs",
      fmt::format(
          "the WLF shift is {:g}, {:g} K at {:g} C and the material's {:g}, {:g} K at {:g} C",
          found.C1, found.C2_K, found.T_ref_C, expected.C1, expected.C2_K, expected.T_ref_C),
      true};
}

void add(const std::optional<CardFinding>& finding, CardCheck& check) {
  if (finding) check.findings.push_back(*finding);
}

void compare(const Material& reference, CardCheck& check) {
  const bool is_solid = !check.read.material.terms.empty() || check.read.numbers.branches.empty();
  const std::vector<double> times_s = comparison_times_s(reference);
  if (is_solid && check.read.material.E0_Pa > 0.0) {
    const Material ruled = with_bulk_rule(reference, check.read.understood.bulk);
    check.G_difference = largest_G_difference(check.read.material, reference, times_s);
    check.E_difference = largest_E_difference(check.read.material, ruled, times_s);
    check.E_difference_with_bulk = largest_E_difference(check.read.material, reference, times_s);
  }
  add(shift_finding(check.read, reference), check);
  const std::optional<CardFinding> bulk = bulk_finding(check.read, reference);
  const std::optional<CardFinding> density = density_finding(check.read, reference);
  const bool is_far = !check.E_difference || !(*check.E_difference <= check.tolerance);
  const bool is_density_off = density && density->is_mistake;
  if (!is_far && !bulk && !is_density_off) {
    add(density, check);
    return;
  }
  // A cause that explains every number at once comes before what each number says alone.
  const std::vector<CardFinding> causes = explain_difference(check.read, reference);
  check.findings.insert(check.findings.end(), causes.begin(), causes.end());
  if (has_mistake(causes)) return;
  add(bulk, check);
  add(density, check);
  if (causes.empty() && is_far && !has_mistake(check.findings)) {
    check.findings.push_back(
        {"differs", "the card is of another material, or wrong in a way not known here", true});
  }
}

// Our own headers state E0 and E_inf, so a card that was edited below betrays itself even when no
// material is named.
void compare_with_header(const std::string& text, CardCheck& check) {
  const std::string mark = "E0 (instantaneous) = ";
  const std::size_t at = text.find(mark);
  const double found_Pa = check.read.material.E0_Pa;
  // COMSOL's expressions carry their own units, the header's number does not.
  const bool is_comparable = check.read.understood.name != "comsol" && found_Pa > 0.0;
  if (at == std::string::npos || !is_comparable) return;
  const double stated = std::strtod(text.c_str() + at + mark.size(), nullptr);
  const double stated_Pa = from_card(stated, check.read.units.stress_exponent);
  // The header has ten digits; columns round E(t) by up to 1e-4 before a card is refused.
  if (std::abs(found_Pa / stated_Pa - 1.0) <= 2e-4) return;
  const bool is_abaqus_default =
      check.read.understood.name == "abaqus" && check.read.understood.at == ModulusAt::kLongTerm;
  check.findings.push_back(
      {is_abaqus_default ? "E0-without-instantaneous" : "header-disagrees",
       fmt::format("the header says E0 = {:g} Pa and the numbers below mean {:g} Pa{}", stated_Pa,
                   found_Pa, is_abaqus_default ? "; *ELASTIC lacks MODULI=INSTANTANEOUS" : ""),
       true});
}

// CSV tables of ours: the unit stands in the column name.
double largest_table_difference(const std::string& text, const Material& reference) {
  const std::vector<CardLine> lines = card_lines(text, "#");
  if (lines.empty()) throw std::runtime_error("the table is empty");
  const std::vector<std::string> names = cells(lines[0].text, ',');
  if (names.size() < 2 || names[0].rfind("time_", 0) != 0 || names[1].rfind("modulus_", 0) != 0) {
    throw std::runtime_error("line " + std::to_string(lines[0].number) +
                             ": expected the columns time_UNIT, modulus_UNIT, ...");
  }
  const std::string time = names[0].substr(5), stress = names[1].substr(8);
  const UnitSystem* units = nullptr;
  for (const UnitSystem& system : unit_systems()) {
    if (units == nullptr && time == system.time && stress == system.stress) units = &system;
  }
  if (units == nullptr)
    throw std::runtime_error("no unit system has times in " + time + " and stresses in " + stress);
  const PronySeries series = young_series(reference);
  double largest = 0.0;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (trimmed(lines[i].text).empty()) continue;
    const auto row = cells(lines[i].text, ',');
    const double time_s = from_card(cell_number(row, 0, lines[i], "time"), units->time_exponent);
    const double found_Pa =
        from_card(cell_number(row, 1, lines[i], "modulus"), units->stress_exponent);
    largest = std::max(largest, std::abs(found_Pa / relaxation_modulus_Pa(series, time_s) - 1.0));
  }
  return largest;
}

CardCheck check_table(const std::string& text, const CheckOptions& options,
                      const Material* reference) {
  CardCheck check;
  check.read.understood = card_target(options.target);
  check.read.units = unit_system("SI");
  check.read.units_were_stated = true;
  if (reference == nullptr) {
    throw std::invalid_argument(
        "a CSV card holds E(t), not a material; name a material file to compare it with");
  }
  check.E_difference = largest_table_difference(text, *reference);
  check.E_difference_with_bulk = check.E_difference;
  check.tolerance = options.tolerance.value_or(kExactEnough);
  check.agrees = *check.E_difference <= check.tolerance;
  if (!check.agrees) {
    check.findings.push_back({"differs", "the table is of another material", true});
  }
  return check;
}

}  // namespace

CardCheck check_card(const std::string& text, const CheckOptions& options,
                     const Material* reference) {
  if (options.target == "csv") return check_table(text, options, reference);
  CardCheck check;
  check.read = read_card(text, options.target, options.units);
  check.findings = check.read.findings;
  if (!check.read.units_were_stated && options.units.empty()) {
    check.findings.push_back(
        {"units-not-stated",
         "the card does not say its units; it is read as SI (--units names others)", false});
  }
  if (reference != nullptr) {
    check.tolerance =
        options.tolerance
            ? *options.tolerance
            : std::max(kExactEnough, 1.01 * rounding_of_columns(*reference, check.read));
    compare(*reference, check);
    note_times_outside_window(*reference, check);
  } else {
    compare_with_header(text, check);
  }
  // Where a cause is known, that nothing solid is left is only its consequence.
  const bool has_cause = std::any_of(
      check.findings.begin(), check.findings.end(),
      [](const CardFinding& finding) { return finding.is_mistake && finding.name != "no-solid"; });
  if (has_cause) {
    std::erase_if(check.findings, [](const CardFinding& f) { return f.name == "no-solid"; });
  }
  check.agrees = !has_mistake(check.findings) &&
                 (!check.E_difference || *check.E_difference <= check.tolerance);
  return check;
}

}  // namespace viscard
