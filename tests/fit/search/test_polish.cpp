// The last polish: the optimum of all samples, not only that of their averages.
#include "fit/fit_relaxation.h"
#include "tests/fit/spectra.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace viscard;
using namespace viscard::test;

namespace {

// Samples at even times up to window_s, with two stretches sampled ten times as fast, so that
// averages of very different numbers of samples stand beside each other.
RelaxationData uneven(const PronySeries& series, double window_s, double noise,
                      std::uint64_t seed) {
  RelaxationData data = relaxation_of(series, 20000, window_s, noise, seed);
  RelaxationData thinned;
  for (std::size_t i = 0; i < data.time_s.size(); ++i) {
    const bool is_fast = i < 2000 || (i > 9000 && i < 11000);
    if (!is_fast && i % 10 != 0) continue;
    thinned.time_s.push_back(data.time_s[i]);
    thinned.value.push_back(data.value[i]);
  }
  return thinned;
}

// By averages with the last polish, and the same order by every sample.
struct BothFits {
  FitResult quick, full;
};

BothFits fitted_both_ways(const RelaxationData& data) {
  FitOptions options;
  options.drift = TableDrift::kNone;
  BothFits both;
  both.quick = fit_relaxation(data, options);
  options.full_data = true;
  options.n_terms = static_cast<int>(both.quick.terms.size());
  both.full = fit_relaxation(data, options);
  return both;
}

}  // namespace

TEST_CASE("the default fit reaches the optimum of all samples to 1e-9", "[fit]") {
  const int n_terms = GENERATE(2, 4, 7);
  const double noise = GENERATE(1e-2, 1e-4);
  PronySeries series{1.0, {}};
  for (int i = 0; i < n_terms; ++i) {
    const double decade = -2.0 + 5.5 * i / (n_terms - 1.0);
    series.terms.push_back({0.3 / (1.0 + i), std::pow(10.0, decade)});
  }
  for (const bool is_even : {true, false}) {
    const RelaxationData data =
        is_even ? relaxation_of(series, 20000, 3000.0, noise, 3) : uneven(series, 3000.0, noise, 4);
    const auto [quick, full] = fitted_both_ways(data);
    CAPTURE(n_terms, noise, is_even, quick.terms.size(), quick.rss / full.rss - 1.0);
    CHECK(quick.rss <= full.rss * (1.0 + 1e-9));
    REQUIRE(full.terms.size() == quick.terms.size());
    // Flat directions move far for little: within a hundredth of the standard error.
    for (std::size_t i = 0; i < quick.terms.size(); ++i) {
      const double apart = std::log(quick.terms[i].tau_s / full.terms[i].tau_s);
      CHECK(std::abs(apart) < 0.01 * full.terms[i].ln_tau_se + 1e-9);
    }
  }
}

TEST_CASE("the default fit reaches the optimum of all samples in slow noise", "[fit]") {
  // A power law in noise with a memory of 30 samples: the optimum is flat, and averages miss it.
  const double exponent = GENERATE(0.1, 0.2, 0.3);
  RelaxationData data;
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  constexpr double kRho = 0.97;
  double noise = 0.0;
  for (int i = 1; i <= 18000; ++i) {
    noise = kRho * noise + std::sqrt(1.0 - kRho * kRho) * normal(random);
    data.time_s.push_back(0.1 * i);
    data.value.push_back(1.0 + 0.5 * std::pow(1.0 + 0.2 * i, -exponent) + 2e-4 * noise);
  }
  const auto [quick, full] = fitted_both_ways(data);
  CAPTURE(exponent, quick.terms.size(), quick.rss / full.rss - 1.0);
  CHECK(quick.rss <= full.rss * (1.0 + 1e-9));
}
