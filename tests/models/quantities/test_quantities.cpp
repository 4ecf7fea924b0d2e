// The table of quantities: its own consistency, and how numbers are judged.
#include "models/quantities/plausible.h"

#include <catch2/catch.hpp>

#include <fstream>
#include <iterator>
#include <limits>
#include <set>
#include <string>

namespace viscard {
namespace {

TEST_CASE("every quantity has a range, an example, a reason and a meaning", "[models]") {
  std::set<const Quantity*> seen;
  for (const Quantity* quantity : all_quantities()) {
    INFO(quantity->name);
    CHECK(seen.insert(quantity).second);
    for (const PlausibleRange& range : {quantity->measured, quantity->scene}) {
      CHECK(range.lowest < range.highest);
    }
    for (const char* text :
         {quantity->unit, quantity->example, quantity->reason, quantity->meaning}) {
      CHECK(std::string(text) != "");
    }
  }
}

std::string range_text(const PlausibleRange& range, const char* unit) {
  return text_with_unit(range.lowest, unit) + " to " + text_with_unit(range.highest, unit);
}

// The row of a quantity in README.md.
std::string row_of(const Quantity& quantity) {
  return std::string("| ") + quantity.name + " | " + quantity.unit + " | " +
         (quantity.kind == QuantityKind::kEach ? "each" : "largest") + " | " +
         range_text(quantity.measured, quantity.unit) + " | " +
         range_text(quantity.scene, quantity.unit) + " | " + quantity.reason + " | " +
         quantity.meaning + " |\n";
}

TEST_CASE("the README of the room has the table of the code", "[models]") {
  std::string table =
      "| quantity | unit | judged | measured | in a scene | why | what it is |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const Quantity* quantity : all_quantities()) table += row_of(*quantity);
  std::ifstream file(VISCARD_SOURCE_DIR "/models/quantities/README.md");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  INFO(table);
  CHECK(text.find(table) != std::string::npos);
}

TEST_CASE("a number that is not plausible is named with its range and what was meant", "[models]") {
  const auto doubt = doubt_about(quantities::kModulus, 2.0, Plausible::kMeasured);
  REQUIRE(doubt);
  CHECK(doubt->value_text == "2 Pa");
  CHECK(doubt->range == "100 Pa to 1 TPa");
  CHECK(doubt->meant == "2 MPa");
  CHECK(doubt->meant_factor == 1e6);
  CHECK(doubt->with_remedy("write E", "say off") ==
        "is 2 Pa; plausible are 100 Pa to 1 TPa (" + std::string(quantities::kModulus.reason) +
            "). If 2 MPa was meant, write E; if the value is right, say off");
  const auto light = doubt_about(quantities::kDensity, 1.1, Plausible::kMeasured);
  REQUIRE(light);
  CHECK(light->meant == "1.1 g/cm3");
  // A unit that would make a number larger than any is not what was meant.
  CHECK(doubt_about(quantities::kModulus, 1e308, Plausible::kMeasured)->meant.empty());
  // Of several units, the one that is nearest to the example.
  CHECK(doubt_about(quantities::kBulkModulus, 2.0, Plausible::kMeasured)->meant == "2 GPa");
  CHECK(doubt_about(quantities::kStress, 0.02, Plausible::kMeasured)->meant == "0.02 MPa");
  CHECK(doubt_about(quantities::kLength, 40.0, Plausible::kScene)->meant == "40 um");
  CHECK(doubt_about(quantities::kDepth, 0.13, Plausible::kMeasured)->meant == "0.13 mm");
  // No unit makes it plausible.
  const auto nothing = doubt_about(quantities::kModulus, 1e30, Plausible::kMeasured);
  REQUIRE(nothing);
  CHECK(nothing->meant == "");
}

TEST_CASE("limits belong to a range, scenes have wider ones, and off accepts anything",
          "[models]") {
  for (const Quantity* quantity : all_quantities()) {
    INFO(quantity->name);
    for (const double at : {quantity->measured.lowest, quantity->measured.highest}) {
      CHECK_FALSE(doubt_about(*quantity, at, Plausible::kMeasured));
      CHECK_FALSE(doubt_about(*quantity, 1e3 * at + 1.0, Plausible::kOff));
    }
  }
  CHECK(doubt_about(quantities::kModulus, 1e13, Plausible::kMeasured));
  CHECK_FALSE(doubt_about(quantities::kModulus, 1e13, Plausible::kScene));
  CHECK(doubt_about(quantities::kModulus, 1.8, Plausible::kScene));
  CHECK_FALSE(doubt_about(quantities::kDensity, 0.0, Plausible::kMeasured));  // not given
  CHECK_FALSE(doubt_about(quantities::kForce, -1.0, Plausible::kMeasured));   // pulled
  CHECK(doubt_about(quantities::kPoissonRatio, -1.5, Plausible::kMeasured));
}

TEST_CASE("a sign that cannot be right is named, and no unit and no way around it are proposed",
          "[models]") {
  int n_signed = 0;
  for (const Quantity* quantity : all_quantities()) {
    if (quantity->sign == Sign::kAny) continue;
    ++n_signed;
    INFO(quantity->name);
    CHECK(quantity->measured.lowest >= 0.0);
    for (const double value : {-1.0, -1e-3, -1e3, -quantity->measured.highest}) {
      for (const Plausible judged : {Plausible::kMeasured, Plausible::kScene}) {
        const auto doubt = doubt_about(*quantity, value, judged);
        REQUIRE(doubt);
        const std::string text = doubt->with_remedy("write it so", "switch it off");
        CHECK(text == doubt->text());
        CHECK(text.find(quantity->sign == Sign::kPositive
                            ? "it must be positive"
                            : "it must not be negative") != std::string::npos);
      }
    }
  }
  CHECK(n_signed == 22);
  CHECK_FALSE(doubt_about(quantities::kForce, -1.0, Plausible::kMeasured));
  CHECK_FALSE(doubt_about(quantities::kLength, -1e-3, Plausible::kMeasured));
  CHECK_FALSE(doubt_about(quantities::kDensity, 0.0, Plausible::kMeasured));
  CHECK(doubt_about(quantities::kTipSize, 0.0, Plausible::kMeasured)->sign ==
        "it must be positive");
  // A column has the other sign only if nothing in it is positive.
  const auto flipped = doubt_about(quantities::kModulus, {-2.0, -1.0}, Plausible::kMeasured);
  REQUIRE(flipped);
  CHECK(flipped->meant_factor == -1e6);
  CHECK(doubt_about(quantities::kModulus, {-2.0, 1.0}, Plausible::kMeasured)->sign.empty());
}

TEST_CASE("a column is judged by its largest value or by each, as the quantity says", "[models]") {
  const double gap = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(doubt_about(quantities::kModulus, {2e6, 3.0, gap}, Plausible::kMeasured));
  CHECK(doubt_about(quantities::kModulus, {2.0, 1.5, gap}, Plausible::kMeasured));
  CHECK(doubt_about(quantities::kStretch, {1.0, 1.5, 110.0}, Plausible::kMeasured));
  CHECK_FALSE(doubt_about(quantities::kStretch, {1.0, 1.5, 11.0}, Plausible::kMeasured));
  CHECK_FALSE(doubt_about(quantities::kModulus, {0.0, gap}, Plausible::kMeasured));
}

TEST_CASE("ranges are printed with prefixes", "[models]") {
  CHECK(text_with_unit(1e12, "Pa") == "1 TPa");
  CHECK(text_with_unit(0.05, "m") == "50 mm");
  CHECK(text_with_unit(1e-8, "m") == "10 nm");
  CHECK(text_with_unit(2.0, "m") == "2 m");
  CHECK(text_with_unit(30.0 * 86400.0, "s") == "30 days");
  CHECK(text_with_unit(1e-3, "s") == "1 ms");
  CHECK(text_with_unit(25000.0, "kg/m3") == "25000 kg/m3");
}

}  // namespace
}  // namespace viscard
