// Whether a material has an equilibrium modulus, decided from the data.
#include "fit/assembly/solid_or_liquid.h"
#include "fit/fit_creep.h"
#include "fit/fit_relaxation.h"
#include "models/material/retardation_spectrum.h"
#include "tests/fit/fit_checks.h"
#include "tests/fit/spectra.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace viscard;
using namespace viscard::test;

namespace {

// Creep at n even times up to window_s; the noise is relative to the last value.
CreepData creep_of(const RetardationSpectrum& spectrum, int n, double window_s, double noise) {
  CreepData data;
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  const double sigma = noise * creep_compliance_1_Pa(spectrum, window_s);
  for (int i = 0; i < n; ++i) {
    const double t = window_s * i / (n - 1.0);
    data.time_s.push_back(t);
    data.compliance_1_Pa.push_back(creep_compliance_1_Pa(spectrum, t) + sigma * normal(random));
  }
  return data;
}

// A melt: five modes over four decades, no equilibrium modulus, at n times even in their logarithm.
RelaxationData melt(int n, double noise, PronySeries& truth) {
  truth = {0.0, {{3e4, 0.1}, {2e4, 1.0}, {1e4, 10.0}, {4e3, 100.0}, {1e3, 600.0}}};
  RelaxationData data;
  std::mt19937_64 random(6);
  std::normal_distribution<double> normal;
  for (int i = 0; i < n; ++i) {
    const double t = 0.03 * std::pow(1e5, i / (n - 1.0));
    data.time_s.push_back(t);
    data.value.push_back(relaxation_modulus_Pa(truth, t) + noise * 6.8e4 * normal(random));
  }
  return data;
}

}  // namespace

TEST_CASE("a Burgers creep is recognised as a liquid without --liquid", "[fit]") {
  // E0 1 MPa, one retardation of 20 s, and a linear tail.
  const RetardationSpectrum burgers{1e-6, {{1e-6, 20.0}}, 1e-8};
  const double noise = GENERATE(0.0, 1e-3, 5e-3);
  CAPTURE(noise);
  const FitResult fit = fit_creep(creep_of(burgers, 1500, 1000.0, noise));
  CHECK(fit.E_inf_Pa == 0.0);
  CHECK(has_flag(fit, "liquid"));
  CHECK(*fit.bic_liquid_minus_solid < -6.0);
  CHECK(fit.is_trustworthy);
  CHECK(fit.E0_Pa == Approx(1e6).epsilon(0.005 + 40.0 * noise));
  CHECK(holds(fit.E0_interval_95, 1e6));
  REQUIRE(fit.terms.size() == 2);
  const PronySeries truth = relaxation_from_retardation(burgers);
  CHECK(fit.terms[1].tau_s ==
        Approx(truth.terms[1].relaxation_time_s).epsilon(0.001 + 10.0 * noise));
}

TEST_CASE("the relaxation of a melt is fitted without an equilibrium modulus", "[fit]") {
  PronySeries truth;
  const RelaxationData data = melt(400, 1e-4, truth);
  const FitResult fit = fit_relaxation(data);
  CHECK(fit.E_inf_Pa == 0.0);
  REQUIRE(fit.bic_liquid_minus_solid);
  CHECK(*fit.bic_liquid_minus_solid < 0.0);
  REQUIRE(fit.terms.size() == 5);
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(fit.terms[i].tau_s == Approx(truth.terms[i].relaxation_time_s).epsilon(0.1));
  }
  CHECK(fit.noise.sigma == Approx(6.8).epsilon(0.15));
}

TEST_CASE("a solid stays one, in relaxation and in creep", "[fit]") {
  const FitResult relaxation = fit_relaxation(relaxation_of(s2(), 2000, 1000.0, 1e-3, 4));
  CHECK_FALSE(has_flag(relaxation, "liquid"));
  CHECK_FALSE(has_flag(relaxation, "solid-or-liquid"));
  CHECK_FALSE(relaxation.bic_liquid_minus_solid);  // E_inf is far from zero: nothing to try
  const RetardationSpectrum slow{1.0, {{0.4, 5.0}, {0.3, 300.0}}, 0.0};
  const FitResult creep = fit_creep(creep_of(slow, 1500, 1000.0, 1e-3));
  CHECK(creep.E_inf_Pa == Approx(1.0 / 1.7).epsilon(0.02));
  CHECK_FALSE(has_flag(creep, "liquid"));
  CHECK_FALSE(has_flag(creep, "solid-or-liquid"));
  CHECK(creep.E_inf_interval_95.low > 0.5);
  REQUIRE(creep.bic_liquid_minus_solid);
  CHECK(*creep.bic_liquid_minus_solid > 3.0);
}

TEST_CASE("a record too short to decide between solid and liquid has intervals that hold both",
          "[fit]") {
  int n_held = 0, n_doubted = 0;
  constexpr int kRuns = 20;
  for (int seed = 1; seed <= kRuns; ++seed) {
    const PronySeries truth{0.1, {{0.5, 1.0}, {0.4, 60.0}}};
    const FitResult fit =
        fit_relaxation(relaxation_of(truth, 300, 100.0, 0.02, static_cast<std::uint64_t>(seed)));
    n_held += holds(fit.E_inf_interval_95, 0.1) ? 1 : 0;
    n_doubted += has_flag(fit, "solid-or-liquid") ? 1 : 0;
  }
  CHECK(n_held >= kRuns - 3);
  CHECK(n_doubted > 0);
}

TEST_CASE("an equilibrium modulus that was asked for is kept", "[fit]") {
  const RetardationSpectrum burgers{1e-6, {{1e-6, 20.0}}, 1e-8};
  FitOptions options;
  options.is_solid = true;
  const FitResult fit = fit_creep(creep_of(burgers, 500, 1000.0, 1e-3), options);
  CHECK(fit.E_inf_Pa > 0.0);
  CHECK_FALSE(fit.bic_liquid_minus_solid);
  CHECK(has_flag(fit, "slower-relaxation"));
}
