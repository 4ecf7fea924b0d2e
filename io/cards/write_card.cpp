#include "io/cards/card.h"
#include "io/cards/card_body.h"
#include "io/cards/card_header.h"
#include "io/cards/read_card.h"
#include "models/material/fit_defects.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

// Beyond this a rounded card is refused; beyond kExact the header states the rounding.
constexpr double kWorstRounding = 1e-4;
constexpr double kExact = 1e-9;

void check_flags(const Material& material, const CardOptions& options) {
  if (options.accepts_flags) return;
  for (const MaterialFlag& flag : material.flags) {
    if (flag.term > 0) {
      throw std::invalid_argument(
          fmt::format("the fit has flagged term {} ({}: {}); pass --accept-flags to write it all "
                      "the same, or fit "
                      "again with fewer terms",
                      flag.term, flag.name, flag.text));
    }
    if (is_defect(flag.name)) {
      throw std::invalid_argument(
          fmt::format("the fit is not to be trusted ({}: {}); pass --accept-flags to write it all "
                      "the same, or repeat the measurement",
                      flag.name, flag.text));
    }
  }
}

void settle_nu(Material& material, const CardTarget& target, const CardOptions& options,
               std::vector<FidelityItem>& fidelity) {
  if (options.clamped_nu && material.nu > *options.clamped_nu) {
    fidelity.push_back({"nu", Mapping::kApproximated,
                        fmt::format("clamped from {} to {}", material.nu, *options.clamped_nu)});
    material.nu = *options.clamped_nu;
  }
  if (material.nu == 0.5 && !target.takes_incompressible) {
    throw std::invalid_argument("nu is 0.5 and " + target.code +
                                " needs a finite bulk modulus; pass --clamp-nu 0.4995 (the header "
                                "will say so) or set nu in "
                                "the material file");
  }
}

void settle_terms(Material& material, const CardTarget& target) {
  std::erase_if(material.terms, [&](const MaterialTerm& term) {
    return term.g == 0.0 && (term.k == 0.0 || target.bulk != BulkRule::kOwnNumbers);
  });
  if (target.max_terms > 0 && static_cast<int>(material.terms.size()) > target.max_terms) {
    throw std::invalid_argument(fmt::format(
        "the material has {} and {} takes at most {}; pass --approximate for the best "
        "series of {}, or choose another target",
        counted(material.terms.size(), "term"), target.code, target.max_terms, target.max_terms));
  }
}

// The bulk part was rarely measured: where it is the default assumption (k = g) the target's own
// rule may stand in its place, with the difference stated. A bulk part that was stated or measured
// may not.
void settle_bulk(Material& material, const CardTarget& target, const CardOptions& options,
                 std::vector<FidelityItem>& fidelity) {
  const Material mapped = with_bulk_rule(material, target.bulk);
  bool is_same = true;
  for (std::size_t i = 0; i < material.terms.size(); ++i) {
    is_same = is_same && material.terms[i].k == mapped.terms[i].k;
  }
  const std::string origin = material.provenance.bulk_origin;
  const std::string rule = mapped.terms.empty() ? "no relaxation" : to_word(target.bulk);
  if (is_same || material.nu == 0.5) {
    fidelity.push_back({"bulk", Mapping::kExact, rule + " (" + origin + ")"});
    return;
  }
  const double difference = largest_E_difference(mapped, material, comparison_times_s(material));
  const bool is_assumed = has_constant_poisson_ratio(material) && origin == "assumed";
  if (!is_assumed && !options.may_approximate) {
    throw std::invalid_argument(fmt::format(
        "the bulk relaxation of this material is stated, and in {} the bulk modulus {} ({:.1e} in "
        "E(t)); pass --approximate to write it so, or choose another target",
        target.code, rule, difference));
  }
  fidelity.push_back(
      {"bulk", Mapping::kApproximated,
       fmt::format(
           "{}, where the material's is {} ({:.1e} in E(t))", rule,
           has_constant_poisson_ratio(material) ? "constant nu (" + origin + ")" : "another",
           difference)});
  material = mapped;
}

// Only WLF has a common form; what else is known of temperature stands in the header alone.
void settle_shift(const Material& material, const CardTarget& target,
                  std::vector<FidelityItem>& fidelity) {
  if (!material.shift) return;
  const TemperatureShift& shift = *material.shift;
  const bool is_wlf = shift.law == ShiftLaw::kWlf;
  const std::string law =
      is_wlf ? fmt::format("WLF, C1 = {}, C2 = {} K at {} C", shift.C1, shift.C2_K, shift.T_ref_C)
             : fmt::format("Arrhenius, {} J/mol at {} C", shift.activation_J_mol, shift.T_ref_C);
  if (is_wlf && target.takes_wlf) {
    fidelity.push_back({"temperature", Mapping::kExact, law + "; temperatures in C"});
  } else {
    fidelity.push_back({"temperature", Mapping::kDropped,
                        law + (is_wlf ? "; no shift is written for this target"
                                      : "; only WLF is written, so the card holds at its "
                                        "reference temperature")});
  }
}

// What a reader of the body gets, and how far the printed digits take E(t) and the density from the
// numbers they stand for.
void read_back(const std::string& body, const CardTarget& target, const UnitSystem& units,
               const Material& material, Card& card) {
  const ReadCard read = read_card(body, target.name, units.name);
  for (const CardFinding& finding : read.findings) {
    if (finding.is_mistake) throw std::logic_error("viscard wrote a wrong card: " + finding.text);
  }
  card.written = read.material;
  if (target.takes_wlf && material.shift && material.shift->law == ShiftLaw::kWlf) {
    const auto& back = read.material.shift;
    const auto is_same = [](double a, double b) { return std::abs(a - b) <= 1e-12 * std::abs(b); };
    if (!back || !is_same(back->C1, material.shift->C1) ||
        !is_same(back->C2_K, material.shift->C2_K)) {
      throw std::logic_error("viscard wrote a wrong temperature shift for " + target.name);
    }
  }
  const double rounding =
      largest_E_difference(read.material, material, comparison_times_s(material));
  if (!(rounding <= kWorstRounding)) {
    throw std::invalid_argument(
        fmt::format("in {} the numbers do not fit the columns of {} (E(t) would be off by {:.1e}); "
                    "choose another "
                    "unit system with --units",
                    units.name, target.code, rounding));
  }
  if (rounding > kExact) {
    card.fidelity.push_back({"numbers", Mapping::kApproximated,
                             fmt::format("rounded to the columns, {:.1e} in E(t)", rounding)});
  } else {
    card.fidelity.push_back({"numbers", Mapping::kExact, ""});
  }
  const bool states_density = target.name != "mfront";
  if (material.rho_kg_m3 > 0.0 && states_density) {
    const double off = std::abs(read.material.rho_kg_m3 / material.rho_kg_m3 - 1.0);
    card.fidelity.push_back(
        {"density", off > kExact ? Mapping::kApproximated : Mapping::kExact,
         off > kExact ? fmt::format("rounded to the columns, {:.1e}", off) : ""});
  } else {
    card.fidelity.push_back({"density", Mapping::kDropped,
                             states_density ? "not given by the material"
                                            : "the behaviour has none; its value is a comment"});
  }
}

}  // namespace

Card write_card(const Material& given, const CardOptions& options) {
  const CardTarget& target = card_target(options.target);
  const UnitSystem& units = unit_system(options.units);
  validate(given);
  check_flags(given, options);
  Card card;
  card.fidelity = options.done_before;
  Material material = given;
  settle_nu(material, target, options, card.fidelity);
  settle_terms(material, target);
  settle_bulk(material, target, options, card.fidelity);
  settle_shift(material, target, card.fidelity);
  const bool is_reduced =
      std::any_of(card.fidelity.begin(), card.fidelity.end(),
                  [](const FidelityItem& item) { return item.item == "terms"; });
  if (!is_reduced) {
    card.fidelity.insert(card.fidelity.begin(),
                         {"terms", Mapping::kExact, std::to_string(material.terms.size())});
  }
  CardBody body{card_identifier(given.name),
                numbers_from_material(material, target, units),
                target,
                units,
                material,
                {}};
  if (target.name == "csv") {
    card.written = material;
  } else {
    read_back(card_body(body), target, units, material, card);
  }
  card.largest_difference = largest_E_difference(card.written, given, comparison_times_s(given));
  body.header = card_header(material, target, units, options, card.fidelity);
  const std::string comments = as_comments(body.header, target.comment);
  card.text = target.comment.empty() ? card_body(body) : comments + card_body(body);
  card.companions = card_companions(body);
  for (CompanionFile& companion : card.companions) companion.text = comments + companion.text;
  return card;
}

std::string to_word(Mapping mapping) {
  switch (mapping) {
    case Mapping::kExact:
      return "exact";
    case Mapping::kApproximated:
      return "approximated";
    case Mapping::kDropped:
      return "dropped";
  }
  return "";
}

std::vector<double> comparison_times_s(const Material& material, int count) {
  double from_s = material.valid.t_min_s, to_s = material.valid.t_max_s;
  if (!(to_s > 0.0)) {
    from_s = 1e-2;
    to_s = 1e2;
    for (std::size_t i = 0; i < material.terms.size(); ++i) {
      const double tau_s = material.terms[i].tau_s;
      from_s = i == 0 ? tau_s / 100.0 : std::min(from_s, tau_s / 100.0);
      to_s = i == 0 ? tau_s * 100.0 : std::max(to_s, tau_s * 100.0);
    }
  }
  if (!(from_s > 0.0)) from_s = to_s * 1e-6;
  std::vector<double> times_s;
  for (int i = 0; i < count; ++i) {
    times_s.push_back(from_s * std::pow(to_s / from_s, static_cast<double>(i) / (count - 1)));
  }
  return times_s;
}

double largest_E_difference(const Material& one, const Material& reference,
                            const std::vector<double>& times_s) {
  const PronySeries first = young_series(one), second = young_series(reference);
  double largest = 0.0;
  for (const double time_s : times_s) {
    const double expected_Pa = relaxation_modulus_Pa(second, time_s);
    const double difference =
        std::abs(relaxation_modulus_Pa(first, time_s) - expected_Pa) / expected_Pa;
    if (!(difference <= largest)) largest = difference;  // NaN counts as the largest
  }
  return largest;
}

}  // namespace viscard
