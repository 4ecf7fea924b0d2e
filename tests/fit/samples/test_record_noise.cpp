// Noise as it is: growing with the value, of unequal rows, with a cycle.
#include "fit/fit_creep.h"
#include "fit/fit_indentation.h"
#include "fit/fit_relaxation.h"
#include "fit/samples/check_record.h"
#include "fit/samples/cycle.h"
#include "fit/samples/spikes.h"
#include "models/material/prony_series.h"
#include "models/material/retardation_spectrum.h"
#include "tests/fit/fit_checks.h"
#include "tests/fit/samples/checked_records.h"
#include "tests/fit/spectra.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

using namespace viscard;
using namespace viscard::test;
using Catch::Matchers::Contains;

TEST_CASE("good rows are no spikes if the noise grows with the value", "[fit]") {
  const double falls_to = GENERATE(0.02, 0.05, 0.5);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    RelaxationData data;
    for (std::size_t i = 1; i <= 3000; ++i) {
      data.time_s.push_back(0.1 * static_cast<double>(i));
      const double share = falls_to + (1.0 - falls_to) * std::exp(-data.time_s.back() / 5.0);
      data.value.push_back(1e6 * share * (1.0 + 0.01 * normal(random)));
    }
    CAPTURE(falls_to, seed);
    CHECK(isolated_spikes(data.time_s, data.value).empty());
    if (seed < 3) CHECK(fit_relaxation(data).n_spikes == 0);
  }
}

TEST_CASE("a cycle in a record is fitted beside the relaxation", "[fit]") {
  const double period_s = GENERATE(9.0, 27.0, 41.0);
  const PronySeries truth{1e6, {{0.2e6, 0.5}, {0.2e6, 8.0}}};
  int holding = 0, found = 0;
  constexpr int kRuns = 4;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal(0.0, 1e3);
    RelaxationData data;
    for (int i = 1; i <= 2000; ++i) {
      const double t = 0.06 * i;
      data.time_s.push_back(t);
      data.value.push_back(relaxation_modulus_Pa(truth, t) + normal(random) +
                           1e4 * std::sin(2.0 * M_PI * t / period_s + static_cast<double>(seed)));
    }
    const FitResult fit = fit_relaxation(data);
    CAPTURE(period_s, seed, fit.E0_Pa, fit.E_inf_Pa);
    found += has_flag(fit, "cycle-fitted") ? 1 : 0;
    CHECK(fit.terms.size() >= 2);
    CHECK(fit.E0_Pa == Approx(1.4e6).epsilon(0.01));
    holding += holds(fit.E0_interval_95, 1.4e6) ? 1 : 0;
    holding += holds(fit.E_inf_interval_95, 1e6) ? 1 : 0;
  }
  CHECK(found == kRuns);
  CHECK(holding >= 2 * kRuns - 1);
}

TEST_CASE("noise with a memory has no cycle", "[fit]") {
  const double rho = GENERATE(0.9, 0.97, 0.99);
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const RelaxationData data = relaxation_of(s2(), 2000, 1000.0, 0.01, seed, rho);
    found += find_cycle(data.time_s, data.value) ? 1 : 0;
  }
  CAPTURE(rho);
  CHECK(found == 0);
}

TEST_CASE("readings of unequal noise weigh by their own, and the least modulus is covered",
          "[fit]") {
  // A master curve that was shifted beforehand, from 1 GPa to 2 MPa, with 1 % of each value.
  PronySeries truth{2e6, {}};
  for (int k = 0; k < 14; ++k) {
    truth.terms.push_back({9.98e8 * 0.4 * std::pow(0.6, k), 1e-6 * std::pow(10.0, k)});
  }
  int of_E_inf = 0, of_E0 = 0;
  constexpr int kRuns = 6;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    RelaxationData data;
    for (int i = 0; i < 300; ++i) {
      data.time_s.push_back(1e-7 * std::pow(10.0, 17.0 * i / 299.0));
      data.value.push_back(relaxation_modulus_Pa(truth, data.time_s.back()) *
                           (1.0 + 0.01 * normal(random)));
    }
    const FitResult fit = fit_relaxation(data);
    CAPTURE(seed, fit.E_inf_Pa, fit.E_inf_interval_95.low, fit.E_inf_interval_95.high);
    CHECK(has_flag(fit, "noise-grows"));
    CHECK(fit.E_inf_Pa == Approx(2e6).epsilon(0.03));
    of_E_inf += holds(fit.E_inf_interval_95, 2e6) ? 1 : 0;
    of_E0 += holds(fit.E0_interval_95, instantaneous_modulus_Pa(truth)) ? 1 : 0;
  }
  CHECK(of_E_inf >= kRuns - 1);
  CHECK(of_E0 >= kRuns - 2);
}

TEST_CASE("intervals of moduli do not reach below zero", "[fit]") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const FitResult fit = fit_relaxation(relaxation_of(s2(), 12, 1.0, 0.5, seed));
    CHECK(fit.E0_interval_95.low >= 0.0);
    CHECK(fit.E_inf_interval_95.low >= 0.0);
    for (const FittedTerm& term : fit.terms) CHECK(term.modulus_Pa_95.low >= 0.0);
  }
}
