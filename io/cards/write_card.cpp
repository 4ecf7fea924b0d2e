#include "io/cards/card.h"
#include "io/cards/card_header.h"
#include "io/cards/card_sum.h"
#include "io/cards/card_values.h"
#include "io/cards/material_difference.h"
#include "io/cards/read_card.h"
#include "models/material/material.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

// Of E(t), relative. A card rounded by more is refused; above kExact the header states it.
constexpr double kWorstRounding = 1e-4;
constexpr double kExact = 1e-9;

void check_flags(const Material& material, const CardOptions& options) {
  if (options.accepts_flags) return;
  for (const MaterialFlag& flag : material.flags) {
    if (flag.term > 0) {
      throw std::invalid_argument(
          fmt::format("the fit has flagged term {} ({}: {}); pass --accept-flags to write it "
                      "anyway, or fit again with fewer terms",
                      flag.term, flag.name, flag.text));
    }
    if (is_defect(flag.name)) {
      throw std::invalid_argument(
          fmt::format("the fit is not to be trusted ({}: {}); pass --accept-flags to write it "
                      "anyway, or repeat the measurement",
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
                                "states it) or set nu in the material file");
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

// The bulk relaxation is rarely measured. If it is the default assumption (k = g), the target's own
// rule replaces it and the header states the difference. A stated or measured one is not replaced
// without --approximate.
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
        "E(t)); pass --approximate to accept that, or choose another target{}",
        target.code, rule, difference,
        target.name == "febio" ? ", such as febio-uncoupled, whose bulk modulus is constant" : ""));
  }
  fidelity.push_back(
      {"bulk", Mapping::kApproximated,
       fmt::format(
           "{}, where the material's is {} ({:.1e} in E(t))", rule,
           has_constant_poisson_ratio(material) ? "constant nu (" + origin + ")" : "another",
           difference)});
  material = mapped;
}

void refuse_missing_density(const Material& material, const CardTarget& target) {
  if (!target.needs_density || material.rho_kg_m3 > 0.0) return;
  throw std::invalid_argument("the material gives no density, which " + target.code +
                              " needs even for slow tests; set rho_kg_m3 in the material file");
}

// A shift without a place in the card is refused, unless the user accepts a card of one temperature.
void settle_shift(const Material& material, const CardTarget& target, const CardOptions& options,
                  std::vector<FidelityItem>& fidelity) {
  if (!material.shift) return;
  const TemperatureShift& shift = *material.shift;
  const bool is_wlf = shift.law == ShiftLaw::kWlf;
  const std::string law =
      is_wlf
          ? fmt::format("WLF, C1 = {}, C2 = {} K at {} C", shift.C1, shift.C2_K, shift.T_ref_C)
          : fmt::format("Arrhenius, {:.6g} J/mol at {} C", shift.activation_J_mol, shift.T_ref_C);
  if (takes_shift(target, material)) {
    fidelity.push_back({"temperature", Mapping::kExact,
                        law + fmt::format("; temperatures in the card in {}", target.temperature)});
    return;
  }
  if (!options.may_approximate) {
    throw std::invalid_argument(fmt::format(
        "the material has {} shift ({}) and cards for {} have no place for one{}; name a "
        "temperature with --at-temperature, for example {:g}, for a card of that temperature, or "
        "choose another target",
        is_wlf ? "a WLF" : "an Arrhenius", law.substr(law.find(", ") + 2), target.code,
        is_wlf ? target.why_no_wlf : "", shift.T_ref_C));
  }
  fidelity.push_back({"temperature", Mapping::kApproximated,
                      law + fmt::format("; the card holds at {} C only", shift.T_ref_C)});
}

// Throws unless the shift was written wherever the target has a place for it.
void check_shift(const Material& read, const Material& material, const CardTarget& target) {
  if (!material.shift || !takes_shift(target, material)) return;
  // Ten columns keep at least seven digits.
  const auto is_same = [](double a, double b) { return std::abs(a - b) <= 1e-6 * std::abs(b); };
  const TemperatureShift& wanted = *material.shift;
  const TemperatureShift found = read.shift.value_or(TemperatureShift{});
  const bool are_constants_same =
      wanted.law == ShiftLaw::kWlf
          ? is_same(found.C1, wanted.C1) && is_same(found.C2_K, wanted.C2_K)
          : is_same(found.activation_J_mol, wanted.activation_J_mol);
  const bool is_reference_same =
      is_same(found.T_ref_C - kAbsoluteZero_C, wanted.T_ref_C - kAbsoluteZero_C);
  if (!read.shift || found.law != wanted.law || !are_constants_same || !is_reference_same) {
    throw std::logic_error("viscard wrote a wrong temperature shift for " + target.name);
  }
}

// The errors of fewer terms, of the bulk rule and of the columns add up or cancel; the header
// states the difference that all of them make together.
void state_total(const Material& original, const Material& given, Card& card) {
  card.largest_difference = largest_E_difference(card.written, original, comparison_times_s(given));
  const auto n_approximated =
      std::count_if(card.fidelity.begin(), card.fidelity.end(), [](const FidelityItem& item) {
        return item.mapping != Mapping::kExact && item.item != "density" &&
               item.item != "temperature" && item.item != "harmonic";
      });
  if (n_approximated < 2) return;
  card.fidelity.push_back(
      {"total", Mapping::kApproximated,
       fmt::format("{:.1e} in E(t), all of the above together", card.largest_difference)});
}

void refuse_band(const CardBody& body, const CardOptions& options) {
  if (body.target.band_refusal == nullptr || options.may_approximate) return;
  const std::string why = body.target.band_refusal(body);
  if (!why.empty()) throw std::invalid_argument(why);
}

FidelityItem density_item(const Material& read, const Material& material,
                          const CardTarget& target) {
  if (!target.states_density && target.values != nullptr) {
    return {"density", Mapping::kDropped,
            material.rho_kg_m3 > 0.0
                ? fmt::format("no place in the card; set {} kg/m3 in the model", material.rho_kg_m3)
                : "no place in the card, and not given by the material"};
  }
  if (!target.states_density) {
    return {"density", Mapping::kDropped, "the behaviour has none; its value is a comment"};
  }
  if (!(material.rho_kg_m3 > 0.0)) {
    return {"density", Mapping::kDropped, "not given by the material"};
  }
  const double off = std::abs(read.rho_kg_m3 / material.rho_kg_m3 - 1.0);
  if (!(off > kExact)) return {"density", Mapping::kExact, ""};
  return {"density", Mapping::kApproximated, fmt::format("rounded to the columns, {:.1e}", off)};
}

// Reads the body as the solver would and reports the rounding of E(t) and of the density.
void read_back(const std::string& body, const CardTarget& target, const UnitSystem& units,
               const Material& material, Card& card) {
  const ReadCard read = read_card(body, target, units.name);
  for (const CardFinding& finding : read.findings) {
    if (finding.is_mistake) throw std::logic_error("viscard wrote a wrong card: " + finding.text);
  }
  card.written = read.material;
  check_shift(read.material, material, target);
  const double rounding =
      largest_E_difference(read.material, material, comparison_times_s(material));
  if (!(rounding <= kWorstRounding)) {
    throw std::invalid_argument(
        fmt::format("in {} the numbers do not fit the columns of {} (E(t) would be off by {:.1e}); "
                    "choose another unit system with --units",
                    units.name, target.code, rounding));
  }
  card.fidelity.push_back({"numbers", Mapping::kExact, ""});
  if (rounding > kExact) {
    card.fidelity.back() = {"numbers", Mapping::kApproximated,
                            fmt::format("rounded to the columns, {:.1e} in E(t)", rounding)};
  }
  card.fidelity.push_back(density_item(read.material, material, target));
}

}  // namespace

Card write_card(const Material& given, const CardTarget& target, const CardOptions& options) {
  const UnitSystem& units = unit_system(options.units);
  validate(given);
  check_flags(given, options);
  Card card;
  card.fidelity = options.done_before;
  Material material = given;
  settle_nu(material, target, options, card.fidelity);
  settle_terms(material, target);
  settle_bulk(material, target, options, card.fidelity);
  settle_shift(material, target, options, card.fidelity);
  refuse_missing_density(material, target);
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
                {},
                card_frequencies_Hz(material, target, options.band)};
  if (target.table_difference != nullptr) {
    card.written = material;
  } else if (target.values != nullptr) {
    refuse_band(body, options);
    read_back_values(body, card);
    card.fidelity.push_back(density_item(card.written, material, target));
  } else {
    read_back(target.write(body), target, units, material, card);
  }
  state_total(options.original.value_or(given), given, card);
  body.header = card_header(material, target, units, options, card.fidelity);
  if (!body.frequencies_Hz.empty()) {
    body.header.insert(body.header.begin() + 2, band_line(body.band(), material));
  }
  for (const std::string& line : body.header) {
    if (line.find("EXTRAPOLATED") != std::string::npos) card.warnings.push_back(line);
  }
  const std::string comments = as_comments(body.header, target.comment);
  card.name = body.name;
  card.text = sealed(target.comment.empty() ? target.write(body)
                                            : target.first_line + comments + target.write(body));
  if (target.companions != nullptr) card.companions = target.companions(body);
  for (CompanionFile& companion : card.companions)
    companion.text = sealed(comments + companion.text);
  return card;
}

}  // namespace viscard
