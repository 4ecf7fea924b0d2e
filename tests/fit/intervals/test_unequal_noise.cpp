// Intervals where samples are few, and where their noise grows with the value.
#include "fit/assembly/constraints.h"
#include "fit/fit_creep.h"
#include "fit/fit_relaxation.h"
#include "fit/intervals/viscosity.h"
#include "models/material/retardation_spectrum.h"
#include "tests/fit/fit_checks.h"
#include "tests/fit/spectra.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace viscard;
using namespace viscard::test;

namespace {

// A liquid with one retardation; its viscosity is 2e7 Pa s.
const RetardationSpectrum kLiquid{1e-6, {{2e-6, 2.0}}, 5e-8};

// Creep at times even in their logarithm; the noise is a share of the value, or of the mean value.
CreepData creep_of_liquid(std::size_t n, double noise, bool grows, std::uint64_t seed) {
  CreepData data;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  double mean = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(n - 1);
    data.time_s.push_back(0.05 * std::pow(2000.0, part));
    data.compliance_1_Pa.push_back(creep_compliance_1_Pa(kLiquid, data.time_s.back()));
    mean += data.compliance_1_Pa.back() / static_cast<double>(n);
  }
  for (double& value : data.compliance_1_Pa) {
    value += noise * (grows ? value : mean) * normal(random);
  }
  return data;
}

FitResult fit_liquid(const CreepData& data) {
  FitOptions options;
  options.is_liquid = true;
  return fit_creep(data, options);
}

}  // namespace

TEST_CASE("noise that grows with the compliance reaches the interval of a viscosity", "[fit]") {
  constexpr int kRuns = 40;
  int of_viscosity = 0, of_E0 = 0, flagged = 0;
  for (int seed = 1; seed <= kRuns; ++seed) {
    const FitResult fit =
        fit_liquid(creep_of_liquid(200, 0.02, true, static_cast<std::uint64_t>(seed)));
    const auto viscosity = viscosity_of(fit);
    REQUIRE(viscosity);
    of_viscosity += holds(viscosity->interval_95, 2e7) ? 1 : 0;
    of_E0 += holds(fit.E0_interval_95, 1e6) ? 1 : 0;
    flagged += has_flag(fit, "noise-grows") ? 1 : 0;
  }
  CHECK(of_viscosity >= 34);  // 95 % expected; 26 with equal noise
  CHECK(of_E0 >= 34);
  CHECK(flagged >= 38);
}

TEST_CASE("noise that grows with the modulus reaches the intervals of a constrained fit", "[fit]") {
  constexpr int kRuns = 40;
  constexpr double kE_inf_Pa = 1e4, kE_1_Pa = 1e6, kTau_s = 2.0;
  int of_E0 = 0, of_E_inf = 0;
  double half_width_Pa = 0.0;
  for (int seed = 1; seed <= kRuns; ++seed) {
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    std::normal_distribution<double> normal;
    RelaxationData data;
    for (int i = 0; i < 200; ++i) {
      data.time_s.push_back(0.05 * std::pow(2000.0, i / 199.0));
      const double E_Pa = kE_inf_Pa + kE_1_Pa * std::exp(-data.time_s.back() / kTau_s);
      data.value.push_back(E_Pa * (1.0 + 0.02 * normal(random)));
    }
    FitOptions options{.n_terms = 1};
    options.constraints.push_back(constraint_from_text("tau_1=2"));
    const FitResult fit = fit_relaxation(data, options);
    of_E0 += holds(fit.E0_interval_95, kE_inf_Pa + kE_1_Pa) ? 1 : 0;
    of_E_inf += holds(fit.E_inf_interval_95, kE_inf_Pa) ? 1 : 0;
    half_width_Pa += 0.5 * (fit.E_inf_interval_95.high - fit.E_inf_interval_95.low) / kRuns;
  }
  CHECK(of_E0 >= 34);
  CHECK(of_E_inf >= 34);
  CHECK(half_width_Pa < 1000.0);
}

TEST_CASE("equal noise is seldom said to grow", "[fit]") {
  int flagged = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    flagged += has_flag(fit_liquid(creep_of_liquid(200, 0.01, false, seed)), "noise-grows") ? 1 : 0;
  }
  CHECK(flagged <= 1);  // one in a thousand expected
}

TEST_CASE("few samples widen intervals by Student's t", "[fit]") {
  // With one term and so little noise, s/E0 and its interval are linear in the noise, white or not.
  const RelaxationData few = relaxation_of({1e6, {{5e5, 3.0}}}, 10, 20.0, 1e-3, 4);
  FitOptions one;
  one.n_terms = 1;
  const FitResult fit = fit_relaxation(few, one);
  FitOptions known = one;
  known.white_noise = true;  // takes the variance as known
  const FitResult normal = fit_relaxation(few, known);
  REQUIRE(fit.noise.inflation == 1.0);
  // Ten values less three parameters: t = 2.365 for seven degrees of freedom (Abramowitz & Stegun
  // 1964, table 26.10), 1.960 for a known variance.
  CHECK(fit.E0_se_Pa / normal.E0_se_Pa == Approx(2.364624 / 1.959964).epsilon(1e-5));
}
