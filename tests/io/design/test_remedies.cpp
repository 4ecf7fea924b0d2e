// The search for a dimension that passes, against quantities whose answer is known.
#include "io/flow/design/remedies.h"
#include "io/flow/design/verdict.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace viscard;

namespace {

constexpr double kFrom_m = 100e-6;

// scale (x/from)^power, known to a share of itself.
QuantityAt power_law(double scale, double power, double share = 0.0) {
  return [=](double x_m) -> RequiredValue {
    const double value = scale * std::pow(x_m / kFrom_m, power);
    return {true, value, share * value, ""};
  };
}

}  // namespace

TEST_CASE("a value nearer to its limit than its error is undecided, not passed", "[io][design]") {
  CHECK(verdict_of({true, 0.9, 0.05, ""}, 1.0, true) == Verdict::kPass);
  CHECK(verdict_of({true, 0.97, 0.05, ""}, 1.0, true) == Verdict::kUndecided);
  CHECK(verdict_of({true, 1.03, 0.05, ""}, 1.0, true) == Verdict::kUndecided);
  CHECK(verdict_of({true, 1.1, 0.05, ""}, 1.0, true) == Verdict::kFail);
  CHECK(verdict_of({true, 1.1, 0.05, ""}, 1.0, false) == Verdict::kPass);
  CHECK(verdict_of({true, 0.9, 0.05, ""}, 1.0, false) == Verdict::kFail);
  CHECK(verdict_of({true, 1.0, 0.0, ""}, 1.0, true) == Verdict::kPass);
  CHECK(verdict_of({false, 0.0, 0.0, "why"}, 1.0, true) == Verdict::kNotAnswered);
}

TEST_CASE("the nearest dimension that passes is found to three digits on the safe side",
          "[io][design]") {
  // x^-2 = 2 at 70.7 um: 70 um passes a lower limit of 2, 71 um does not.
  const auto shorter = seek_remedy(kFrom_m, 2.0, false, power_law(1.0, -2.0));
  REQUIRE(shorter);
  CHECK(shorter->to_m <= kFrom_m / std::sqrt(2.0));
  CHECK(shorter->to_m == Approx(kFrom_m / std::sqrt(2.0)).epsilon(0.02));
  CHECK(shorter->to_m * 1e7 == Approx(std::round(shorter->to_m * 1e7)).margin(1e-6));
  // Known to 5 % only: what passes must be further out, at x^-2 (1 - 0.05) = 2.
  const auto safe = seek_remedy(kFrom_m, 2.0, false, power_law(1.0, -2.0, 0.05));
  REQUIRE(safe);
  CHECK(safe->to_m <= kFrom_m * std::sqrt(0.95 / 2.0));
  // The other way: x^3 <= 1/8 at half.
  const auto thinner = seek_remedy(kFrom_m, 0.125, true, power_law(1.0, 3.0));
  REQUIRE(thinner);
  CHECK(thinner->to_m == Approx(0.5 * kFrom_m).epsilon(0.02));
}

TEST_CASE("where no single dimension would pass none is invented", "[io][design]") {
  CHECK_FALSE(seek_remedy(kFrom_m, 1e6, false, power_law(1.0, -2.0)));
  CHECK_FALSE(seek_remedy(kFrom_m, 2.0, false, power_law(1.0, 0.0)));
  const QuantityAt refused = [](double) -> RequiredValue { return {.how = "no such scene"}; };
  CHECK_FALSE(seek_remedy(kFrom_m, 1.0, false, refused));
}

TEST_CASE("dimensions are those that stand in the scene, uncertain ones with their value",
          "[io][design]") {
  const auto found = dimensions_of(R"([geometry]
diameter = "40 um +- 1 um"
length = 1.2e-4
film = { thickness = "25 um", material = "pvdf" }
[materials]
length = "7 m"
)",
                                   "scene.toml");
  REQUIRE(found.size() == 3);
  CHECK(found[0].key == "geometry.diameter");
  CHECK(found[0].value_m == Approx(40e-6));
  CHECK(found[1].value_m == Approx(120e-6));
  CHECK(found[2].key == "geometry.film.thickness");
}
