#include "io/basics/number_text.h"
#include "io/cards/card.h"
#include "io/cards/material_difference.h"
#include "io/cards/read_card.h"
#include "io/cards/targets/card_targets.h"
#include "tests/io/cards/card_materials.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <string>

using namespace viscard;
using namespace viscard::test;

namespace {

// Largest relative rounding of any number of the card when it gets all ten columns.
double worst_of_ten_columns(const Material& material, const CardTarget& target,
                            const UnitSystem& units) {
  const CardNumbers numbers = numbers_from_material(material, target, units);
  std::vector<double> values{numbers.bulk, numbers.equilibrium, numbers.equilibrium};
  for (const CardBranch& branch : numbers.branches) {
    values.push_back(branch.shear);
    values.push_back(branch.time);
    values[2] += branch.shear;  // 006 states the sum
  }
  double worst = 0.0;
  for (const double value : values) {
    const double written = std::stod(nearest_number(value, 10));
    worst = std::max(worst, std::abs(written / value - 1.0));
  }
  return worst;
}

}  // namespace

TEST_CASE("ten columns of LS-DYNA keep E(t) within 2e-6 if the numbers fit the columns",
          "[cards]") {
  int held = 0, tried = 0;
  for (const char* name : {"lsdyna", "lsdyna006"}) {
    const CardTarget& target = card_target(name);
    for (const UnitSystem& units : unit_systems()) {
      for (const int n : {1, 2, 6, 12, 17}) {
        if (n > target.max_terms) continue;
        CAPTURE(target.name, units.name, n);
        const Material material = with_bulk_rule(material_of_terms(n, 0.495), target.bulk);
        ++tried;
        // A term's share of E(t) is below 1, so its rounding counts at most once.
        if (worst_of_ten_columns(material, target, units) > 3e-7) continue;
        ++held;
        const Card card = write_card(material, target, {.units = units.name});
        const ReadCard read = read_card(card.text, target, "");
        CHECK(largest_E_difference(read.material, material, comparison_times_s(material)) <= 2e-6);
      }
    }
  }
  CHECK(tried == 36);
  CHECK(held >= 18);  // at least the systems with moduli near 1
}

TEST_CASE("every target and unit system reads back as it was written", "[cards]") {
  for (const CardTarget& target : card_targets()) {
    if (!states_material(target)) continue;  // test_harmonic_cards.cpp
    for (const UnitSystem& units : unit_systems()) {
      for (const int n : {0, 1, 2, 6, 12, 30}) {
        for (const double nu : {0.0, 0.3, 0.4999}) {
          if (target.max_terms > 0 && n > target.max_terms) continue;
          CAPTURE(target.name, units.name, n, nu);
          const Material material = with_bulk_rule(material_of_terms(n, nu), target.bulk);
          const bool is_ten_columns = target.name.rfind("lsdyna", 0) == 0;
          const CardOptions options{.units = units.name};
          Card card;
          try {
            card = write_card(material, target, options);
          } catch (const std::invalid_argument& error) {
            // Ten columns are too few for some numbers in some systems; then the card is refused.
            REQUIRE(is_ten_columns);
            CHECK(std::string(error.what()).find("do not fit") != std::string::npos);
            continue;
          }
          const ReadCard read = read_card(card.text, target, "");
          CHECK(read.findings.empty());
          CHECK(read.units_were_stated);
          if (target.name != "ansys") CHECK(read.name == "Spectrum");  // MAPDL numbers materials
          const double difference =
              largest_E_difference(read.material, material, comparison_times_s(material));
          if (is_ten_columns) {
            CHECK(difference <= 1e-4);
            const bool is_stated = card.text.find("rounded to the columns") != std::string::npos;
            CHECK((difference <= 1e-9 || is_stated));
          } else {
            CHECK(difference <= 1e-9);
            if (target.name != "mfront") {
              CHECK(read.material.rho_kg_m3 == Approx(1030.0).epsilon(1e-12));  // rounding
            }
          }
        }
      }
    }
  }
}

TEST_CASE("a bulk relaxation of its own reads back from every target that has a place for it",
          "[cards]") {
  Material material = material_of_terms(4, 0.3);
  for (std::size_t i = 0; i < 4; ++i) material.terms[i].k = 0.05 * static_cast<double>(i);
  for (const char* target : {"abaqus", "ansys", "mfront", "json"}) {
    CAPTURE(target);
    const Material read =
        read_card(write_card(material, card_target(target)).text, card_target(target), "").material;
    REQUIRE(read.terms.size() == 4);
    for (std::size_t i = 0; i < 4; ++i) {
      CHECK(read.terms[i].k == Approx(material.terms[i].k).epsilon(1e-12).margin(1e-15));
    }
  }
}

TEST_CASE("an MFront card brings the property list of the gallery's law, which reads back too",
          "[cards]") {
  Material material = material_of_terms(3, 0.3);
  const Card card = write_card(material, card_target("mfront"), {.units = "mm-t-s"});
  REQUIRE(card.companions.size() == 1);
  const ReadCard read = read_card(card.companions[0].text, card_target("mfront"), "");
  CHECK(largest_E_difference(read.material, material, comparison_times_s(material)) <= 1e-9);
  CHECK(read.material.terms[2].k == Approx(material.terms[2].k).epsilon(1e-12));  // rounding
}
