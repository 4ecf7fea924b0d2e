#include "io/cards/check_card.h"

#include "io/cards/byte_order_mark.h"
#include "io/cards/card.h"
#include "io/cards/card_form.h"
#include "io/cards/card_sum.h"
#include "io/cards/header_name.h"
#include "io/cards/list_differences.h"
#include "io/cards/material_difference.h"
#include "io/cards/plausible_card.h"
#include "models/maths/leading_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

constexpr double kExactEnough = 1e-6;  // of E(t): seven digits typed by hand

bool has_mistake(const std::vector<CardFinding>& findings) {
  return std::any_of(findings.begin(), findings.end(),
                     [](const CardFinding& finding) { return finding.is_mistake; });
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

// The error of E(t) in a right card, which the target's fixed columns cause.
double rounding_of_columns(const Material& reference, const CardTarget& target,
                           const ReadCard& read) {
  // The two forms of FEBio are distinguished by the card itself.
  const bool is_of_target = read.understood.name == target.name;
  try {
    const Card card =
        write_card(reference, is_of_target ? target : read.understood,
                   {.units = read.units.name, .may_approximate = true, .accepts_flags = true});
    const Material ruled = with_bulk_rule(reference, read.understood.bulk);
    return largest_E_difference(card.written, ruled, comparison_times_s(reference));
  } catch (const std::invalid_argument&) {
    return 0.0;  // the target does not take this material at all
  }
}

// E(t) of a nearly incompressible polymer hardly depends on K, but a layer's deformation does.
std::optional<CardFinding> bulk_finding(const ReadCard& read, const Material& reference) {
  const auto bulk_Pa = [](const Material& material) {
    return material.E0_Pa / (3.0 * (1.0 - 2.0 * material.nu));  // infinite at 0.5
  };
  const Material& found = read.material;
  if (!(found.E0_Pa > 0.0) || found.nu == reference.nu) return std::nullopt;
  // At the material's E0: a wrong modulus has its own finding.
  Material at_found = reference;
  at_found.nu = found.nu;
  const double found_Pa = bulk_Pa(at_found), expected_Pa = bulk_Pa(reference);
  if (std::abs(found_Pa / expected_Pa - 1.0) <= kHandTyped) return std::nullopt;
  return CardFinding{
      "poisson-ratio",
      fmt::format("nu is {:g} and the material's {:g}: the bulk modulus is {:.3g} "
                  "Pa where it should be {:.3g} Pa{}",
                  found.nu, reference.nu, found_Pa, expected_Pa, factor_of(found_Pa, expected_Pa)),
      true};
}

// Others have no E(t): their bulk modulus is negative.
bool has_solid_nu(const ReadCard& read) {
  return read.material.nu > -1.0 && read.material.nu <= 0.5;
}

std::optional<CardFinding> density_finding(const ReadCard& read, const Material& reference) {
  const double found = read.material.rho_kg_m3, expected = reference.rho_kg_m3;
  const bool has_place = read.understood.states_density;
  if (!(expected > 0.0) || !has_place || !(read.material.E0_Pa > 0.0)) return std::nullopt;
  if (!(found > 0.0)) {
    return CardFinding{"density-missing",
                       fmt::format("the card gives no density; the material's is {:g} kg/m3, which "
                                   "dynamic steps and weight need",
                                   expected),
                       false};
  }
  if (std::abs(found / expected - 1.0) <= kHandTyped) return std::nullopt;
  return CardFinding{"density",
                     fmt::format("the density is {:g} kg/m3 and the material's {:g}{}", found,
                                 expected, factor_of(found, expected)),
                     true};
}

std::string in_words(const TemperatureShift& shift) {
  return shift.law == ShiftLaw::kWlf
             ? fmt::format("WLF, {:g}, {:g} K at {:g} C", shift.C1, shift.C2_K, shift.T_ref_C)
             : fmt::format("Arrhenius, {:g} J/mol at {:g} C", shift.activation_J_mol,
                           shift.T_ref_C);
}

CardFinding shift_differs(const TemperatureShift& found, const TemperatureShift& expected) {
  return {"shift-differs",
          "the shift is " + in_words(found) + " and the material's " + in_words(expected), true};
}

std::optional<CardFinding> shift_finding(const ReadCard& read, const Material& reference) {
  if (!reference.shift && read.material.shift) {
    return CardFinding{"shift-unexpected",
                       "the card has a temperature shift (" + in_words(*read.material.shift) +
                           ") and the material none",
                       true};
  }
  if (!reference.shift) return std::nullopt;
  const TemperatureShift& expected = *reference.shift;
  if (!takes_shift(read.understood, reference)) {
    return CardFinding{"shift-not-held",
                       fmt::format("the material has a shift ({}), which cards for {} cannot hold: "
                                   "this one holds at {:g} C only",
                                   in_words(expected), read.understood.code, expected.T_ref_C),
                       false};
  }
  if (!read.material.shift) {
    return CardFinding{"shift-missing",
                       fmt::format("the material has a shift ({}) and the card none: it holds at "
                                   "{:g} C only",
                                   in_words(expected), expected.T_ref_C),
                       true};
  }
  const TemperatureShift& found = *read.material.shift;
  const auto is_close = [](double a, double b) {
    return std::abs(a - b) <= kHandTyped * std::max(1.0, std::abs(b));
  };
  if (found.law != expected.law) return shift_differs(found, expected);
  if (found.law == ShiftLaw::kArrhenius) {
    const bool is_same = is_close(found.activation_J_mol, expected.activation_J_mol) &&
                         is_close(found.T_ref_C, expected.T_ref_C);
    return is_same ? std::nullopt : std::optional(shift_differs(found, expected));
  }
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
  return shift_differs(found, expected);
}

void add(const std::optional<CardFinding>& finding, CardCheck& check) {
  if (finding) check.findings.push_back(*finding);
}

void add_all(const std::vector<CardFinding>& more, CardCheck& check) {
  check.findings.insert(check.findings.end(), more.begin(), more.end());
}

CardNumbers expected_numbers(const Material& reference, const ReadCard& read) {
  return numbers_from_material(with_bulk_rule(reference, read.understood.bulk), read.understood,
                               read.units);
}

void compare(const Material& reference, CardCheck& check) {
  const bool is_solid =
      (!check.read.material.terms.empty() || check.read.numbers.branches.empty()) &&
      has_solid_nu(check.read);
  const std::vector<double> times_s = comparison_times_s(reference);
  if (is_solid && check.read.material.E0_Pa > 0.0) {
    const Material ruled = with_bulk_rule(reference, check.read.understood.bulk);
    check.G_difference = largest_G_difference(check.read.material, reference, times_s);
    check.E_difference = largest_E_difference(check.read.material, ruled, times_s);
    check.E_difference_with_bulk = largest_E_difference(check.read.material, reference, times_s);
  }
  add(shift_finding(check.read, reference), check);
  const auto bulk = bulk_finding(check.read, reference);
  const auto density = density_finding(check.read, reference);
  const bool is_far = !check.E_difference || !(*check.E_difference <= check.tolerance);
  const bool is_density_off = density && density->is_mistake;
  if (!is_far && !bulk && !is_density_off) {
    add(density, check);
    const CardNumbers expected = expected_numbers(reference, check.read);
    add_all(near_numbers(check.read.numbers, expected, check.read.understood), check);
    return;
  }
  // One cause that explains all numbers is reported instead of each number.
  const std::vector<CardFinding> causes = explain_difference(check.read, reference);
  add_all(causes, check);
  if (has_mistake(causes)) return;
  add(bulk, check);
  add(density, check);
  if (!causes.empty() || !is_far || has_mistake(check.findings)) return;
  const std::vector<CardFinding> listed = listed_differences(
      check.read.numbers, expected_numbers(reference, check.read), check.read.understood);
  add_all(listed, check);
  if (!listed.empty()) return;
  check.findings.push_back(
      {"differs", "the card is of another material, or wrong in a way not known here", true});
}

// The header of a card by viscard states E0. It reveals edited numbers, even without a material.
void compare_with_header(const std::string& text, CardCheck& check) {
  const std::size_t at = behind_mark(text, "E0 (instantaneous) = ");
  const double found_Pa = check.read.material.E0_Pa;
  // The header's number is in the unit system, which the reader of such a card does not know.
  const bool is_comparable = !check.read.understood.numbers_carry_units && found_Pa > 0.0;
  if (at == std::string::npos || !is_comparable) return;
  const double stated = leading_number(std::string_view(text).substr(at));
  const double stated_Pa = from_card(stated, check.read.units.stress_exponent);
  // The header has ten digits; columns round E(t) by up to 1e-4 before a card is refused.
  if (std::abs(found_Pa / stated_Pa - 1.0) <= 2e-4) return;
  const std::string& missing = check.read.missing_keyword;
  check.findings.push_back(
      {missing.empty() ? "header-disagrees" : "E0-without-instantaneous",
       fmt::format("the header states E0 = {:g} Pa and the numbers below mean {:g} Pa{}{}",
                   stated_Pa, found_Pa, factor_of(found_Pa, stated_Pa),
                   missing.empty() ? "" : "; " + missing),
       true});
}

// A unit that another mistake explains is not named twice.
std::optional<CardFinding> implausible(const std::string& text, const CheckOptions& options,
                                       const CardCheck& check) {
  const ReadCard& read = check.read;
  if (has_mistake(check.findings)) return std::nullopt;
  return implausible_finding(text,
                             {read.material.E0_Pa, read.material.rho_kg_m3,
                              read.understood.numbers_carry_units ? nullptr : &read.units},
                             options.plausible);
}

CardCheck check_table(const std::string& text, const CardTarget& target,
                      const CheckOptions& options, const Material* reference) {
  const std::string stated = stated_unit_system(text);
  CardCheck check{.read = {target, unit_system("SI"), true},
                  .units = stated.empty() ? "those of the columns" : stated};
  if (reference == nullptr) {
    throw std::invalid_argument(
        "a CSV card holds E(t), not a material; name a material file to compare it with");
  }
  check.E_difference = target.table_difference(text, *reference);
  check.E_difference_with_bulk = check.E_difference;
  check.tolerance = options.tolerance.value_or(kExactEnough);
  check.agrees = *check.E_difference <= check.tolerance;
  // If viscard wrote the table of this very material, the other columns must be its own too.
  const auto form = form_difference(text, target, *reference);
  if (form && (!check.agrees || *check.E_difference <= 1e-9)) {
    check.findings.push_back({"table-differs", form->text, true});
    check.agrees = false;
  } else if (!check.agrees) {
    check.findings.push_back({"differs", "the table is of another material", true});
  } else {
    add_all(header_differences(text, check.read, target, reference), check);
    check.agrees = !has_mistake(check.findings);
  }
  return check;
}

CardCheck check_plain_card(const std::string& text, const CardTarget& target,
                           const CheckOptions& options, const Material* reference) {
  if (target.table_difference != nullptr) return check_table(text, target, options, reference);
  if (target.values != nullptr) return check_card_values(text, target, options, reference);
  CardCheck check{.read = read_card(text, target, options.units)};
  check.findings = check.read.findings;
  note_unread_tokens(text, target, options.units, check.findings);
  check.units = check.read.units.name;
  // The reader converts numbers that carry their unit to SI; the header states what they are in.
  if (check.read.understood.numbers_carry_units) {
    const std::string stated = stated_unit_system(text);
    check.units = stated.empty() ? "of each number" : stated;
  }
  if (!check.read.units_were_stated && options.units.empty()) {
    check.findings.push_back(
        {"units-not-stated",
         "the card does not state its units; it is read as SI (--units names others)", false});
  }
  if (reference != nullptr) {
    check.tolerance =
        options.tolerance
            ? *options.tolerance
            : std::max(kExactEnough, 1.01 * rounding_of_columns(*reference, target, check.read));
    compare(*reference, check);
    note_times_outside_window(*reference, check);
  } else {
    compare_with_header(text, check);
    if (!has_solid_nu(check.read)) {
      check.findings.push_back(
          {"poisson-ratio",
           fmt::format("nu is {:g}; that of a solid lies above -1 and is at most 0.5",
                       check.read.material.nu),
           true});
    }
    add(implausible(text, options, check), check);
  }
  // "no-solid" is only a consequence of any other mistake.
  const bool has_cause = std::any_of(
      check.findings.begin(), check.findings.end(),
      [](const CardFinding& finding) { return finding.is_mistake && finding.name != "no-solid"; });
  if (has_cause) {
    std::erase_if(check.findings, [](const CardFinding& f) { return f.name == "no-solid"; });
  }
  if (!has_mistake(check.findings)) {
    add(form_difference(text, check.read), check);
    add_all(header_differences(text, check.read, target, reference), check);
  }
  check.agrees = !has_mistake(check.findings) &&
                 (!check.E_difference || *check.E_difference <= check.tolerance);
  return check;
}

}  // namespace

CardCheck check_card(const std::string& text, const CardTarget& target, const CheckOptions& options,
                     const Material* reference) {
  const std::string plain = without_byte_order_mark(text);
  CardCheck check = check_plain_card(plain, target, options, reference);
  // What was found in a comparison explains the edit.
  const bool is_explained =
      reference != nullptr ? !check.findings.empty() : has_mistake(check.findings);
  if (!is_explained) add(sum_finding(plain, reference != nullptr), check);
  if (plain.size() == text.size()) return check;
  check.findings.insert(check.findings.begin(), byte_order_mark_finding(target));
  check.agrees = check.agrees && !check.findings.front().is_mistake;
  return check;
}

}  // namespace viscard
