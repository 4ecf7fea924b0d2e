// Each cell of the table of targets against what writing, refusing and --check do for that target.
#include "io/cards/card.h"
#include "io/cards/check_card.h"
#include "io/cards/targets/card_targets.h"
#include "io/cards/targets/target_table.h"
#include "io/cards/unit_system.h"
#include "models/material/frequency_band.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>

using namespace viscard;

namespace {

// The cells of the printed table by target: linear, bulk, temperature, harmonic, density, units.
std::map<std::string, std::vector<std::string>> rows_of_table() {
  std::map<std::string, std::vector<std::string>> rows;
  std::istringstream lines(target_table());
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> cells;
    for (std::size_t from = 2, at = 0; (at = line.find(" |", from)) != std::string::npos;
         from = at + 3) {
      cells.push_back(line.substr(from, at - from));
    }
    if (cells.size() == 7) rows[cells[0]] = {cells.begin() + 1, cells.end()};
  }
  return rows;
}

// What tests/README.md lists targets for: each writes this material.
Material material_for(const CardTarget& target) {
  Material material;
  material.name = "example";
  material.E0_Pa = 1e6;
  material.nu = 0.495;
  material.rho_kg_m3 = 1000.0;
  material.terms = {{0.25, 0.25, 0.1}, {0.25, 0.25, 1.0}};
  if (target.max_terms == 1) material.terms = {{0.5, 0.5, 1.0}};
  return material;
}

Material with_stated_bulk(Material material) {
  for (MaterialTerm& term : material.terms) term.k = 0.2 * term.g;
  material.provenance.bulk_origin = "measured";
  return material;
}

Material with_shift(Material material, ShiftLaw law) {
  material.T_ref_C = 23.0;
  material.shift = TemperatureShift{
      .law = law, .T_ref_C = 23.0, .C1 = 8.86, .C2_K = 101.6, .activation_J_mol = 5e4};
  return material;
}

std::optional<Card> written(const Material& material, const CardTarget& target,
                            bool may_approximate = false, const char* units = "SI") {
  try {
    return write_card(material, target, {.units = units, .may_approximate = may_approximate});
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

bool has(const std::string& cell, const std::string& words) {
  return cell.find(words) != std::string::npos;
}

// The first number behind the words of a cell.
double number_behind(const std::string& cell, const std::string& words) {
  const std::size_t at = cell.find(words);
  return at == std::string::npos ? NAN : std::strtod(cell.c_str() + at + words.size(), nullptr);
}

// The largest relative difference of E(t) that --check finds between the text and the material.
double checked_difference(const Card& card, const CardTarget& target, const Material& material) {
  const CardCheck check = check_card(card.text, target, {}, &material);
  REQUIRE(check.E_difference_with_bulk);
  return *check.E_difference_with_bulk;
}

bool agrees(const Card& card, const CardTarget& target, const Material& material) {
  return check_card(card.text, target, {}, &material).agrees;
}

// The card without its comments.
std::string lines_below_header(const Card& card, const CardTarget& target) {
  std::istringstream lines(card.text);
  std::string out;
  for (std::string line; std::getline(lines, line);) {
    const bool is_comment = !target.comment.empty() && line.rfind(target.comment, 0) == 0;
    if (!is_comment) out += line + "\n";
  }
  return out;
}

constexpr double kExact = 1e-9, kSameNumber = 0.06;  // the table prints two digits

void check_linear(const std::string& cell, const CardTarget& target) {
  const Material material = material_for(target);
  const std::optional<Card> card = written(material, target, true);
  REQUIRE(card);
  CHECK(agrees(*card, target, material));
  const CardCheck check = check_card(card->text, target, {}, &material);
  if (target.band_note != nullptr) return;  // numbers over frequency; see check_harmonic
  if (target.values == nullptr) {
    REQUIRE(check.E_difference);  // under the target's bulk rule
    const double stated = has(cell, "approximate") ? number_behind(cell, "approximate, ") : 0.0;
    CHECK(*check.E_difference <= std::max(kExact, (1.0 + kSameNumber) * stated));
    if (stated > 0.0) CHECK(*check.E_difference >= (1.0 - kSameNumber) * stated);
  }
  // One term more than the table allows is refused.
  const double most = number_behind(cell, "; ");
  CHECK(std::isnan(most) == (target.max_terms == 0));
  if (std::isnan(most)) return;
  Material many = material;
  many.terms.clear();
  for (int i = 0; i < static_cast<int>(most); ++i) {
    const double g = 0.5 / most;
    many.terms.push_back({g, g, std::pow(10.0, 3.0 * i / most)});
  }
  CHECK(written(many, target));
  many.terms.push_back({0.01, 0.01, 1e4});
  CHECK_FALSE(written(many, target));
}

void check_bulk(const std::string& cell, const CardTarget& target) {
  if (cell == "one Poisson ratio") {
    CHECK(target.band_note != nullptr);
    return;
  }
  const auto check_one = [&](const Material& material, const std::string& words) {
    const std::optional<Card> card = written(material, target);
    CHECK(card.has_value() == !has(words, "refused"));
    const std::optional<Card> any = written(material, target, true);
    REQUIRE(any);
    if (target.values != nullptr) return;  // states no whole material
    const double stated = has(words, "refused (")       ? number_behind(words, "refused (")
                          : has(words, "approximate, ") ? number_behind(words, "approximate, ")
                                                        : 0.0;
    const double found = checked_difference(*any, target, material);
    CHECK(found <= std::max(1e-8, (1.0 + kSameNumber) * stated));  // ten columns of LS-DYNA
    if (stated > 0.0) CHECK(found >= (1.0 - kSameNumber) * stated);
  };
  const std::size_t second = cell.find("; stated ");
  check_one(material_for(target), cell.substr(0, second));
  check_one(with_stated_bulk(material_for(target)),
            second == std::string::npos ? cell : cell.substr(second));
}

void check_temperature(const std::string& cell, const CardTarget& target) {
  for (const ShiftLaw law : {ShiftLaw::kWlf, ShiftLaw::kArrhenius}) {
    const char* name = law == ShiftLaw::kWlf ? "WLF" : "Arrhenius";
    CAPTURE(name);
    const Material material = with_shift(material_for(target), law);
    const bool is_exact = cell == "exact" || has(cell, std::string(name) + " exact");
    const std::optional<Card> card = written(material, target);
    CHECK(card.has_value() == is_exact);
    if (!card || target.values != nullptr) continue;
    CHECK(agrees(*card, target, material));
    Material other = material;
    other.shift->C1 *= 1.001;
    other.shift->activation_J_mol *= 1.001;
    CHECK_FALSE(agrees(*card, target, other));
  }
}

// Interpolates a table linearly over frequency, as the solver does, between its rows.
void check_harmonic(const std::string& cell, const CardTarget& target) {
  CHECK(has(cell, "approximate") == (target.band_note != nullptr));
  if (target.rows_per_decade == 0 || target.name == "abaqus-table") return;
  const Material material = material_for(target);
  const std::optional<Card> card = written(material, target);
  REQUIRE(card);
  const CardCheck check = check_card(card->text, target, {}, &material);
  const std::vector<double>& f = check.read.frequencies_Hz;
  CHECK(has(cell, std::to_string(f.size()) + " rows"));
  const double stated = number_behind(cell, "off by up to ");
  double worst = 0.0;
  for (std::size_t row = 0; row + 1 < f.size(); ++row) {
    for (double part = 0.1; part < 0.95; part += 0.1) {
      const auto at = [&](double Hz) { return dynamic_moduli(material, Hz).shear_Pa; };
      const double Hz = f[row] + part * (f[row + 1] - f[row]);
      const auto between = (1.0 - part) * at(f[row]) + part * at(f[row + 1]);
      worst = std::max(worst, std::abs(between - at(Hz)) / std::abs(at(Hz)));
    }
  }
  CHECK(worst <= (1.0 + kSameNumber) * stated);
  CHECK(worst >= 0.5 * stated);  // the stated one covers interpolation over log f too
}

void check_density(const std::string& cell, const CardTarget& target) {
  Material material = material_for(target);
  const std::optional<Card> card = written(material, target, true);
  REQUIRE(card);
  Material heavier = material, without = material;
  heavier.rho_kg_m3 *= 1.01;
  without.rho_kg_m3 = 0.0;
  const bool has_place = !has(cell, "refused");
  if (has_place) CHECK_FALSE(agrees(*card, target, heavier));
  const std::optional<Card> other = written(heavier, target, true);
  REQUIRE(other);
  CHECK((lines_below_header(*card, target) != lines_below_header(*other, target)) == has_place);
  CHECK(written(without, target, true).has_value() == !has(cell, "needed"));
}

void check_units(const std::string& cell, const CardTarget& target) {
  const Material material = material_for(target);
  for (const UnitSystem& system : unit_systems()) {
    CAPTURE(system.name);
    const std::optional<Card> card = written(material, target, true, system.name);
    const bool is_refused = has(cell, "refused") && has(cell, system.name);
    CHECK(card.has_value() == !is_refused);
    if (card) CHECK(agrees(*card, target, material));
  }
}

}  // namespace

TEST_CASE("every cell of the table of targets is what writing and --check do", "[cards]") {
  const auto rows = rows_of_table();
  CHECK(rows.size() == card_targets().size() + 1);  // and the titles
  for (const CardTarget& target : card_targets()) {
    CAPTURE(target.name);
    REQUIRE(rows.count(target.name) == 1);
    const std::vector<std::string>& cells = rows.at(target.name);
    check_linear(cells[0], target);
    check_bulk(cells[1], target);
    check_temperature(cells[2], target);
    check_harmonic(cells[3], target);
    check_density(cells[4], target);
    check_units(cells[5], target);
  }
}

TEST_CASE("the bulk column of the table is that of simple tension at constant K", "[cards]") {
  // E = 9 K G/(3 K + G) at long times, G halved, K as it was: E relaxes by less than half.
  const double G = 1e6 / 2.99, K = 1e6 / 0.03, half = 9.0 * K * 0.5 * G / (3.0 * K + 0.5 * G);
  const std::string cell = rows_of_table().at("calculix")[1];
  CHECK(number_behind(cell, "assumed approximate, ") == Approx(half / 0.5e6 - 1.0).epsilon(0.05));
}
