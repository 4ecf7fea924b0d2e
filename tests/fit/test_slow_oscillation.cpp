// What an oscillation knows about E_inf below its lowest frequency and about E0 above its highest.
#include "fit/fit_dma.h"
#include "fit/fit_together.h"
#include "models/material/prony_series.h"
#include "tests/fit/fit_checks.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

using namespace viscard;
using namespace viscard::test;

namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;

// Noise relative to each modulus, or to the complex modulus, as a phase meter has it.
enum class NoiseOf { kEach, kComplex };

DmaData sweep_of(const PronySeries& series, double from_Hz, double to_Hz, int n, double noise,
                 NoiseOf noise_of, std::uint64_t seed) {
  DmaData data;
  std::mt19937_64 dice(seed);
  std::normal_distribution<double> normal;
  for (int i = 0; i < n; ++i) {
    const double f_Hz = from_Hz * std::pow(to_Hz / from_Hz, i / (n - 1.0));
    const ComplexModulus true_Pa = complex_modulus_Pa(series, kTwoPi * f_Hz);
    const double size_Pa = std::hypot(true_Pa.storage_Pa, true_Pa.loss_Pa);
    const bool is_each = noise_of == NoiseOf::kEach;
    data.frequency_Hz.push_back(f_Hz);
    data.storage_Pa.push_back(true_Pa.storage_Pa +
                              noise * (is_each ? true_Pa.storage_Pa : size_Pa) * normal(dice));
    data.loss_Pa.push_back(true_Pa.loss_Pa +
                           noise * (is_each ? true_Pa.loss_Pa : size_Pa) * normal(dice));
  }
  return data;
}

double width(const Interval& interval) {
  return interval.high - interval.low;
}

std::string text_of_flag(const FitResult& fit, const std::string& name) {
  const auto found = std::find_if(fit.flags.begin(), fit.flags.end(),
                                  [&](const MaterialFlag& flag) { return flag.name == name; });
  return found == fit.flags.end() ? "" : found->text;
}

}  // namespace

TEST_CASE("an oscillation far above the relaxation times does not claim to know E_inf", "[fit]") {
  // E' is a plateau of 2 MPa, of which 0.6 MPa relax 1.5 to 3.5 decades below the lowest frequency.
  const double w_tau = GENERATE(30.0, 100.0, 300.0, 1000.0, 3000.0);
  const double noise = GENERATE(0.002, 0.005);
  const PronySeries truth{1.4e6, {{0.6e6, w_tau / kTwoPi}}};
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const FitResult fit = fit_dma(sweep_of(truth, 1.0, 100.0, 30, noise, NoiseOf::kEach, seed));
    CAPTURE(w_tau, noise, seed, fit.E_inf_Pa, fit.E_inf_interval_95.low);
    CHECK(holds(fit.E_inf_interval_95, truth.equilibrium_modulus_Pa));
    CHECK((has_flag(fit, "slower-relaxation") || has_flag(fit, "slow-dashpot")));
    CHECK(fit.E0_Pa == Approx(2e6).epsilon(0.005));
  }
}

TEST_CASE("a slow loss that is within the noise widens the interval of E_inf by name", "[fit]") {
  // The loss of the slow term at 1 Hz is 0.3 % of the complex modulus, the noise 0.5 %.
  const PronySeries truth{1.4e6, {{0.6e6, 100.0 / kTwoPi}}};
  int n_held = 0, n_named = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const FitResult fit = fit_dma(sweep_of(truth, 1.0, 100.0, 30, 0.005, NoiseOf::kComplex, seed));
    n_held += holds(fit.E_inf_interval_95, truth.equilibrium_modulus_Pa);
    n_named += has_flag(fit, "slow-term-hidden") || has_flag(fit, "slower-relaxation") ||
               has_flag(fit, "slow-dashpot");
  }
  CHECK(n_held >= 18);
  CHECK(n_named >= 18);
  // The words name the time and the share.
  const FitResult fit = fit_dma(sweep_of(truth, 1.0, 100.0, 30, 0.005, NoiseOf::kComplex, 2));
  CHECK_THAT(text_of_flag(fit, "slow-term-hidden"), Catch::Contains("a term of 15.9 s"));
}

TEST_CASE("two sweeps together claim no more of E_inf than one", "[fit]") {
  const PronySeries truth{1.4e6, {{0.6e6, 100.0 / kTwoPi}, {0.4e6, 0.005}}};
  const FitOptions options{.keep_rows = true};
  std::vector<MaterialTest> tests;
  for (const std::uint64_t seed : {3u, 4u}) {
    const DmaData data = sweep_of(truth, 1.0, 100.0, 60, 0.005, NoiseOf::kEach, seed);
    tests.push_back({"sweep " + std::to_string(seed), fit_dma(data, options)});
  }
  const FitResult fit = fit_together(tests, {});
  CAPTURE(fit.E_inf_Pa, fit.E_inf_interval_95.low, fit.E_inf_interval_95.high);
  CHECK(holds(fit.E_inf_interval_95, truth.equilibrium_modulus_Pa));
}

TEST_CASE("an E_inf that the lowest frequencies show is not doubted", "[fit]") {
  // The loss at 0.01 Hz is 3 % of its peak and falls with the frequency.
  const PronySeries truth{1.4e6, {{0.6e6, 0.5}, {0.5e6, 1e-3}}};
  int n_held = 0, n_doubted = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const FitResult fit = fit_dma(sweep_of(truth, 0.01, 1000.0, 60, 0.005, NoiseOf::kEach, seed));
    n_held += holds(fit.E_inf_interval_95, truth.equilibrium_modulus_Pa);
    n_doubted += has_flag(fit, "slow-term-hidden") || has_flag(fit, "slower-relaxation");
    CHECK(fit.E_inf_Pa == Approx(1.4e6).epsilon(0.01));
    if (!has_flag(fit, "slower-relaxation")) CHECK(width(fit.E_inf_interval_95) < 0.04 * 1.4e6);
  }
  CHECK(n_held >= 38);
  CHECK(n_doubted <= 2);
}

TEST_CASE("E0 of an oscillation is compared with E' at the highest frequency", "[fit]") {
  // At 10 Hz a term of 0.01 s shows 28 % of its modulus.
  const PronySeries truth{1.0e6, {{0.5e6, 0.01}, {0.3e6, 1.0}}};
  const FitResult fit = fit_dma(sweep_of(truth, 0.01, 10.0, 40, 0.003, NoiseOf::kEach, 4));
  REQUIRE(fit.highest);
  CHECK(fit.highest->frequency_Hz == Approx(10.0));
  const double true_Pa = complex_modulus_Pa(truth, kTwoPi * 10.0).storage_Pa;
  CHECK(holds(fit.highest->interval_95, true_Pa));
  CHECK(width(fit.highest->interval_95) < 0.01 * true_Pa);
  CHECK(holds(fit.E0_interval_95, 1.8e6));
  CHECK_THAT(text_of_flag(fit, "E0-extrapolated"),
             Catch::Contains("the storage modulus at the highest frequency (10 Hz)"));
  // Two decades above the fastest term nothing is extrapolated.
  const FitResult whole = fit_dma(sweep_of(truth, 0.01, 3000.0, 60, 0.003, NoiseOf::kEach, 4));
  REQUIRE(whole.highest);
  CHECK(whole.highest->modulus_Pa == Approx(whole.E0_Pa).epsilon(1e-3));
  CHECK_FALSE(has_flag(whole, "E0-extrapolated"));
}
