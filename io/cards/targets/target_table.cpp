#include "io/cards/targets/target_table.h"

#include "io/cards/card.h"
#include "io/cards/targets/card_targets.h"
#include "io/cards/unit_system.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

namespace viscard {
namespace {

// Half of E relaxes, and nu is that of a rubber.
Material example(const CardTarget& target) {
  Material material;
  material.name = "example";
  material.E0_Pa = 1e6;
  material.nu = 0.495;
  material.rho_kg_m3 = 1000.0;
  material.terms = {{0.25, 0.25, 0.1}, {0.25, 0.25, 1.0}};
  if (target.max_terms == 1) material.terms = {{0.5, 0.5, 1.0}};
  return material;
}

std::optional<Card> card_of(const Material& material, const CardTarget& target,
                            bool may_approximate = false, const char* units = "SI") {
  try {
    return write_card(
        material, target,
        {.units = units, .is_reproducible = true, .may_approximate = may_approximate});
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

const FidelityItem* item_of(const Card& card, const std::string& name) {
  const auto at = std::find_if(card.fidelity.begin(), card.fidelity.end(),
                               [&](const FidelityItem& item) { return item.item == name; });
  return at == card.fidelity.end() ? nullptr : &*at;
}

// "1.3e-08" of the text of an approximated item.
std::string amount_in(const FidelityItem& item) {
  const std::size_t end = item.text.find(" in E(t)");
  if (end == std::string::npos) return item.text;
  const std::size_t begin = item.text.find_last_of(" (", end - 1);
  return item.text.substr(begin + 1, end - begin - 1);
}

// Tables over frequency, and one set of numbers for a band, are no material in time.
bool is_for_a_band(const CardTarget& target) {
  return target.band_note != nullptr;
}

std::string linear_cell(const CardTarget& target) {
  if (is_for_a_band(target)) {
    return target.rows_per_decade > 0 ? "over frequency alone" : "one modulus for a band";
  }
  const std::optional<Card> card = card_of(example(target), target, true);
  if (!card) return "refused";
  const FidelityItem* numbers = item_of(*card, "numbers");
  std::string out = "exact";
  if (numbers != nullptr && numbers->mapping == Mapping::kApproximated) {
    out = "approximate, " + amount_in(*numbers);
  }
  if (target.max_terms > 0) {
    out += fmt::format("; {} {}", target.max_terms, target.max_terms == 1 ? "term" : "terms");
  }
  return out;
}

// A bulk part that is assumed (k = g), and one that is stated (k = 0.2 g).
std::string bulk_cell(const CardTarget& target) {
  if (is_for_a_band(target) && target.rows_per_decade == 0) return "one Poisson ratio";
  Material stated = example(target);
  for (MaterialTerm& term : stated.terms) term.k = 0.2 * term.g;
  stated.provenance.bulk_origin = "measured";
  const std::optional<Card> assumed = card_of(example(target), target),
                            exact = card_of(stated, target), near = card_of(stated, target, true);
  const auto of = [](const std::optional<Card>& card) -> std::string {
    const FidelityItem* item = card ? item_of(*card, "bulk") : nullptr;
    if (item == nullptr) return "refused";
    return item->mapping == Mapping::kExact ? "exact" : "approximate, " + amount_in(*item);
  };
  const std::string refused =
      near ? "refused (" + amount_in(*item_of(*near, "bulk")) + ")" : "refused";
  const std::string first = of(assumed), second = exact ? of(exact) : refused;
  return first == second ? first : "assumed " + first + "; stated " + second;
}

std::string temperature_cell(const CardTarget& target) {
  Material material = example(target);
  material.T_ref_C = 23.0;
  material.shift = TemperatureShift{
      .law = ShiftLaw::kWlf, .T_ref_C = 23.0, .C1 = 8.86, .C2_K = 101.6, .activation_J_mol = 5e4};
  const bool has_wlf = card_of(material, target).has_value();
  material.shift->law = ShiftLaw::kArrhenius;
  const bool has_arrhenius = card_of(material, target).has_value();
  if (has_wlf && has_arrhenius) return "exact";
  if (!has_wlf && !has_arrhenius) return "refused";
  return has_wlf ? "WLF exact; Arrhenius refused" : "WLF refused; Arrhenius exact";
}

std::string harmonic_cell(const CardTarget& target) {
  const std::optional<Card> card = card_of(example(target), target, true);
  const FidelityItem* item = card ? item_of(*card, "harmonic") : nullptr;
  if (item == nullptr) return target.harmonic;
  const std::string word = item->mapping == Mapping::kExact          ? "exact"
                           : item->mapping == Mapping::kApproximated ? "approximate"
                                                                     : "refused";
  std::string text = item->text;
  // Bars would end a cell.
  for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at)) {
    text.erase(at, 1);
  }
  return word + (text.empty() ? "" : ": " + text);
}

std::string density_cell(const CardTarget& target) {
  const std::optional<Card> card = card_of(example(target), target, true);
  const FidelityItem* item = card ? item_of(*card, "density") : nullptr;
  if (item == nullptr) return "refused";
  if (item->mapping == Mapping::kDropped) return "refused: a comment";
  const std::string word = item->mapping == Mapping::kExact ? "exact" : "approximate";
  return word + (target.needs_density ? ", needed" : "");
}

std::string units_cell(const CardTarget& target) {
  std::string refused;
  for (const UnitSystem& system : unit_systems()) {
    if (card_of(example(target), target, true, system.name)) continue;
    refused += (refused.empty() ? "" : ", ") + std::string(system.name);
  }
  if (!refused.empty()) return "exact; refused " + refused;
  return target.numbers_carry_units ? "exact, beside each number" : "exact";
}

}  // namespace

std::string target_table() {
  std::string out =
      "| target | linear | bulk relaxation | temperature | harmonic | density | units |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const CardTarget& target : card_targets()) {
    out += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", target.name, linear_cell(target),
                       bulk_cell(target), temperature_cell(target), harmonic_cell(target),
                       density_cell(target), units_cell(target));
  }
  return out;
}

}  // namespace viscard
