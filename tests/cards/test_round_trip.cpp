#include "io/cards/card.h"
#include "io/cards/read_card.h"
#include "tests/cards/card_materials.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace viscard;
using namespace viscard::test;

TEST_CASE("every target and unit system reads back as it was written", "[cards]") {
  for (const CardTarget& target : card_targets()) {
    if (target.name == "csv") continue;
    for (const UnitSystem& units : unit_systems()) {
      for (const int n : {0, 1, 2, 6, 12, 30}) {
        for (const double nu : {0.0, 0.3, 0.4999}) {
          if (target.max_terms > 0 && n > target.max_terms) continue;
          CAPTURE(target.name, units.name, n, nu);
          const Material material = with_bulk_rule(material_of_terms(n, nu), target.bulk);
          const bool is_ten_columns = target.name.rfind("lsdyna", 0) == 0;
          CardOptions options{.target = target.name, .units = units.name};
          Card card;
          try {
            card = write_card(material, options);
          } catch (const std::invalid_argument& error) {
            // Ten columns do not hold every number in every system; then the card is refused.
            REQUIRE(is_ten_columns);
            CHECK(std::string(error.what()).find("do not fit") != std::string::npos);
            continue;
          }
          const ReadCard read = read_card(card.text, target.name, "");
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

TEST_CASE("bulk terms of their own survive where the target has a place for them", "[cards]") {
  Material material = material_of_terms(4, 0.3);
  for (std::size_t i = 0; i < 4; ++i) material.terms[i].k = 0.05 * static_cast<double>(i);
  for (const char* target : {"abaqus", "ansys", "mfront", "json"}) {
    CAPTURE(target);
    const Material read =
        read_card(write_card(material, {.target = target}).text, target, "").material;
    REQUIRE(read.terms.size() == 4);
    for (std::size_t i = 0; i < 4; ++i) {
      CHECK(read.terms[i].k == Approx(material.terms[i].k).epsilon(1e-12).margin(1e-15));
    }
  }
}

TEST_CASE("an MFront card brings the property list of the gallery's law, which reads back too",
          "[cards]") {
  Material material = material_of_terms(3, 0.3);
  const Card card = write_card(material, {.target = "mfront", .units = "mm-t-s"});
  REQUIRE(card.companions.size() == 1);
  const ReadCard read = read_card(card.companions[0].text, "mfront", "");
  CHECK(largest_E_difference(read.material, material, comparison_times_s(material)) <= 1e-9);
  CHECK(read.material.terms[2].k == Approx(material.terms[2].k).epsilon(1e-12));  // rounding
}
