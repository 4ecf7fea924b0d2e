#include "models/maths/golden_section.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace viscard;

TEST_CASE("golden section brackets the minimum and takes one value for each step", "[models]") {
  constexpr double kMinimum = 0.3, kWidth = 1e-6;
  int n_values = 0;
  const auto f = [&](double x) {
    ++n_values;
    return std::cosh(3.0 * (x - kMinimum));
  };
  const GoldenBracket found = golden_section(f, -1.0, 2.0, kWidth);
  CHECK(found.low <= kMinimum);
  CHECK(found.high >= kMinimum);
  CHECK(found.high - found.low <= kWidth);
  CHECK(found.high - found.low > 0.6 * kWidth);
  CHECK(std::abs(found.best - kMinimum) <= kWidth);
  // 3/phi^n <= 1e-6 from n = 31 on, and two values at the start.
  CHECK(n_values == 33);
}

TEST_CASE("golden section of a function without a minimum inside ends at its lower end",
          "[models]") {
  const auto rising = [](double x) { return x; };
  CHECK(golden_section(rising, 1.0, 2.0, 1e-9).middle() == Approx(1.0).margin(1e-9));
  const auto falling = [](double x) { return -x; };
  CHECK(golden_section(falling, 1.0, 2.0, 1e-9).middle() == Approx(2.0).margin(1e-9));
}
