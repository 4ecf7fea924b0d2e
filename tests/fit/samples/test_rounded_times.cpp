#include "fit/fit_relaxation.h"
#include "fit/samples/rounded_times.h"
#include "models/material/prony_series.h"
#include "tests/fit/fit_checks.h"
#include "tests/fit/spectra.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>
#include <vector>

using namespace viscard;
using namespace viscard::test;

TEST_CASE("times that an export rounded are spread evenly again", "[fit]") {
  std::vector<double> even, times;
  for (int i = 1; i <= 300; ++i) {
    even.push_back(0.23 * i);
    times.push_back(std::round(0.23 * i));
  }
  const auto rounded = rounded_times(times);
  REQUIRE(rounded);
  CHECK(rounded->step_s == 1.0);
  REQUIRE(rounded->time_s.size() == even.size());
  for (std::size_t i = 0; i < even.size(); ++i) {
    CHECK(std::abs(rounded->time_s[i] - even[i]) < 0.15);
  }
}

TEST_CASE("times that are not rounded stay as they are", "[fit]") {
  CHECK_FALSE(rounded_times(even_times(10.0, 0.1)));
  CHECK_FALSE(rounded_times(std::vector<double>{}));
  CHECK_FALSE(rounded_times(std::vector<double>(40, 1.0)));
  std::vector<double> uneven;  // repeats at unequal distances
  for (int i = 0; i < 40; ++i) {
    uneven.push_back(std::pow(1.3, i));
    uneven.push_back(std::pow(1.3, i));
  }
  CHECK_FALSE(rounded_times(uneven));
}

TEST_CASE("a relaxation with times rounded to seconds states E0 and its doubt", "[fit]") {
  const PronySeries truth = s2();  // its fast term, 0.8 s, is shorter than the rounding
  int n_held = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::mt19937_64 dice(seed);
    std::normal_distribution<double> normal;
    RelaxationData data;
    for (int i = 1; i <= 3000; ++i) {
      data.time_s.push_back(std::round(0.2 * i));
      data.value.push_back(relaxation_modulus_Pa(truth, 0.2 * i) + 1e-3 * normal(dice));
    }
    const FitResult fit = fit_relaxation(data);
    CHECK(has_flag(fit, "times-rounded"));
    n_held += holds(fit.E0_interval_95, 1.8) ? 1 : 0;
  }
  CHECK(n_held >= 18);
}
