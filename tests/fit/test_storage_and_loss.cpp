// Storage and loss modulus of one material: what a joint fit can do, and where it cannot.
#include "fit/fit_dma.h"
#include "models/material/prony_series.h"
#include "tests/fit/fit_checks.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

using namespace viscard;
using namespace viscard::test;

namespace {

// Sweeps from 10^from to 10^to Hz with noise relative to each value.
DmaData sweep(const PronySeries& series, double from, double to, int per_decade, double noise,
              std::uint64_t seed) {
  DmaData data;
  std::mt19937_64 dice(seed);
  std::normal_distribution<double> normal;
  const int n = static_cast<int>(std::lround((to - from) * per_decade));
  for (int i = 0; i <= n; ++i) {
    const double f_Hz = std::pow(10.0, from + static_cast<double>(i) / per_decade);
    const ComplexModulus modulus = complex_modulus_Pa(series, 2.0 * std::numbers::pi * f_Hz);
    data.frequency_Hz.push_back(f_Hz);
    data.storage_Pa.push_back(modulus.storage_Pa * (1.0 + noise * normal(dice)));
    data.loss_Pa.push_back(modulus.loss_Pa * (1.0 + noise * normal(dice)));
  }
  return data;
}

// A melt: no equilibrium modulus, two terms a decade from far below to far above the window.
PronySeries melt() {
  PronySeries series;
  for (int i = -12; i <= 10; ++i) {
    const double tau_s = std::pow(10.0, 0.5 * i);
    series.terms.push_back({1e5 * std::pow(tau_s, -0.35) * std::exp(-tau_s / 30.0), tau_s});
  }
  return series;
}

constexpr const char* kFlag = "storage-loss-contradict";

}  // namespace

TEST_CASE("a term far beyond the measured frequencies is no contradiction but a dashpot", "[fit]") {
  const double E_inf_Pa = GENERATE(1e5, 1e3);
  const double noise = GENERATE(0.0, 0.003);
  CAPTURE(E_inf_Pa, noise);
  const PronySeries truth{E_inf_Pa, {{1e6, 1e-5}}};
  const FitResult fit = fit_dma(sweep(truth, -1.0, 2.0, 10, noise, 5));
  for (const auto& flag : fit.flags) UNSCOPED_INFO(flag.text);
  CHECK_FALSE(has_flag(fit, kFlag));
  CHECK(fit.noise.sigma < 0.01);  // terms within the window left 9.8 %
  REQUIRE(fit.dashpot_Pa_s);
  CHECK(has_flag(fit, "fast-dashpot"));
  CHECK(*fit.dashpot_Pa_s == Approx(10.0).epsilon(0.01));
  CHECK(fit.E_inf_Pa == Approx(E_inf_Pa).epsilon(0.02));
}

TEST_CASE("a solvent beside a polymer is found as a dashpot, and a polymer alone has none",
          "[fit]") {
  const PronySeries polymer{0.0, {{300.0, 0.05}, {200.0, 0.5}, {100.0, 5.0}}};
  DmaData data = sweep(polymer, -2.0, 2.0, 10, 0.005, 8);
  FitOptions options;
  options.is_liquid = true;
  CHECK_FALSE(fit_dma(data, options).dashpot_Pa_s);
  for (std::size_t i = 0; i < data.loss_Pa.size(); ++i) {
    data.loss_Pa[i] += 2.0 * 2.0 * std::numbers::pi * data.frequency_Hz[i];
  }
  const FitResult fit = fit_dma(data, options);
  REQUIRE(fit.dashpot_Pa_s);
  CHECK(std::abs(*fit.dashpot_Pa_s - 2.0) < 4.0 * fit.dashpot_se_Pa_s);
  CHECK(fit.dashpot_se_Pa_s < 0.1);
  CHECK_FALSE(has_flag(fit, kFlag));
}

TEST_CASE(
    "melts whose spectrum reaches beyond the window at both ends do not contradict themselves",
    "[fit]") {
  const int per_decade = GENERATE(4, 10, 20);  // 11 to 51 rows
  const double noise = GENERATE(0.0, 0.002, 0.01, 0.03);
  CAPTURE(per_decade, noise);
  int n_flags = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const double from = -1.5 - 0.1 * static_cast<double>(seed);
    n_flags += has_flag(fit_dma(sweep(melt(), from, from + 2.5, per_decade, noise, seed)), kFlag);
  }
  CHECK(n_flags == 0);
}

TEST_CASE("a single term between two times of the grid does not contradict itself", "[fit]") {
  // Half a step of the grid away from a time of it, where the narrow peak misses every time.
  const double tau_s = 1e-2 * std::pow(10.0, GENERATE(0.0, 1.0 / 32.0, 1.0 / 16.0, 3.0 / 32.0));
  int n_flags = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const PronySeries truth{1.4e6, {{0.5e6, tau_s}}};
    n_flags += has_flag(fit_dma(sweep(truth, -1.0, 3.0, 15, 0.01, seed)), kFlag);
  }
  CHECK(n_flags == 0);
}

TEST_CASE(
    "noise relative to the complex modulus makes no contradiction of a loss between two peaks",
    "[fit]") {
  // The loss is 1 to 40 % of the complex modulus, so that its own scatter is 1 to 50 %.
  struct Sweep {
    PronySeries truth;
    double from, to;
    int per_decade;
  };
  const auto [truth, from, to, per_decade] =
      GENERATE(Sweep{{1e6, {{5e5, 0.01}, {3e5, 1.0}}}, -2.0, 3.0, 10},
               Sweep{{1e6, {{5e5, 1.6}, {3e5, 0.01}}}, -1.0, 2.0, 10});
  const double noise = GENERATE(0.001, 0.005);
  CAPTURE(from, noise);
  int n_flags = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    DmaData data = sweep(truth, from, to, per_decade, 0.0, seed);
    std::mt19937_64 dice(seed);
    std::normal_distribution<double> normal;
    for (std::size_t i = 0; i < data.loss_Pa.size(); ++i) {
      const double scatter_Pa = noise * std::hypot(data.storage_Pa[i], data.loss_Pa[i]);
      data.storage_Pa[i] += scatter_Pa * normal(dice);
      data.loss_Pa[i] += scatter_Pa * normal(dice);
    }
    n_flags += has_flag(fit_dma(data), kFlag);
  }
  CHECK(n_flags <= 1);
}

TEST_CASE("a modulus that is 5 % off over one decade is found with its place and size", "[fit]") {
  const bool is_loss = GENERATE(true, false);
  const double factor = GENERATE(1.05, 0.95);
  const double noise = GENERATE(0.0, 0.002, 0.01);
  CAPTURE(is_loss, factor, noise);
  DmaData data = sweep(melt(), -2.0, 2.0, 10, noise, 17);
  REQUIRE_FALSE(has_flag(fit_dma(data), kFlag));
  for (std::size_t i = 0; i < data.frequency_Hz.size(); ++i) {
    if (data.frequency_Hz[i] < 0.3 || data.frequency_Hz[i] > 3.0) continue;
    (is_loss ? data.loss_Pa : data.storage_Pa)[i] *= factor;
  }
  const FitResult fit = fit_dma(data);
  REQUIRE(has_flag(fit, kFlag));
  const std::string text = std::find_if(fit.flags.begin(), fit.flags.end(), [](const auto& flag) {
                             return flag.name == kFlag;
                           })->text;
  INFO(text);
  if (noise < 0.005) CHECK(text.find(is_loss ? "the loss" : "the storage") == 0);
  CHECK(text.find("Hz is ") != std::string::npos);
}

TEST_CASE("relaxation slower than the sweep becomes a slow dashpot, not a bad fit", "[fit]") {
  const double noise = GENERATE(0.0, 0.001, 0.005);
  const double E_inf_Pa = GENERATE(0.0, 1e5);
  CAPTURE(noise, E_inf_Pa);
  const PronySeries truth{E_inf_Pa, {{3e5, 1e-2}, {2e5, 0.1}, {2e5, 100.0}}};
  const FitResult fit = fit_dma(sweep(truth, -2.0, 2.0, 10, noise, 3));
  for (const auto& flag : fit.flags) UNSCOPED_INFO(flag.name + ": " + flag.text);
  CHECK(fit.is_trustworthy);
  CHECK(has_flag(fit, "slow-dashpot"));
  CHECK_FALSE(has_flag(fit, "liquid"));
  CHECK(fit.noise.sigma < 0.005 + 1.3 * noise);  // terms within the window left 25 %
  CHECK(holds(fit.E_inf_interval_95, E_inf_Pa));
  CHECK(fit.E0_Pa == Approx(7e5 + E_inf_Pa).epsilon(0.01));
  if (E_inf_Pa > 0.0) return;
  REQUIRE(fit.terms.size() == 3);
  CHECK(fit.terms[2].tau_s == Approx(100.0).epsilon(0.05));
  CHECK(fit.terms[2].modulus_Pa == Approx(2e5).epsilon(0.01));
}

TEST_CASE("a sweep whose residual has structure is not trusted", "[fit]") {
  const PronySeries truth{0.0, {{3e5, 1e-2}, {2e5, 0.1}, {2e5, 100.0}}};
  FitOptions options;
  options.is_solid = true;
  const FitResult fit = fit_dma(sweep(truth, -2.0, 2.0, 10, 0.001, 3), options);
  CHECK(has_flag(fit, "misfit"));
  CHECK_FALSE(fit.is_trustworthy);
  // A solid within the sweep is trusted, with many noises.
  const PronySeries solid{1e5, {{3e5, 3e-3}, {2e5, 3e-2}, {2e5, 0.3}, {1e5, 3.0}}};
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const FitResult good = fit_dma(sweep(solid, -2.0, 2.0, 10, 0.01, seed));
    CAPTURE(seed);
    CHECK(good.is_trustworthy);
    CHECK_FALSE(has_flag(good, "slow-dashpot"));
  }
}

TEST_CASE("an absolute floor of the noise of an oscillation is found, and intervals hold",
          "[fit]") {
  const bool is_liquid = GENERATE(false, true);
  const PronySeries truth{is_liquid ? 0.0 : 1e5, {{6e5, 0.01}, {3e5, 0.3}, {1e5, 10.0}}};
  int of_times = 0, of_E0 = 0, flagged = 0, same = 0;
  constexpr int kRuns = 40;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    DmaData data = sweep(truth, -3.0, 3.0, 8, 0.01, seed);
    std::mt19937_64 dice(1000 + seed);
    std::normal_distribution<double> normal(0.0, 2e-3 * 1.1e6);
    for (double& value : data.storage_Pa) value += normal(dice);
    for (double& value : data.loss_Pa) value += normal(dice);
    FitOptions options;
    options.is_liquid = is_liquid;
    const FitResult fit = fit_dma(data, options);
    flagged += has_flag(fit, "noise-floor") ? 1 : 0;
    of_E0 += holds(fit.E0_interval_95, instantaneous_modulus_Pa(truth)) ? 1 : 0;
    if (fit.terms.size() != 3) continue;
    ++same;
    of_times += holds(fit.terms[2].tau_s_95, 10.0) ? 1 : 0;
  }
  CAPTURE(is_liquid, flagged, same, of_times, of_E0);
  CHECK(flagged >= 36);
  CHECK(same >= 32);
  CHECK(of_times >= same - 5);
  CHECK(of_E0 >= 34);
}

TEST_CASE("relative noise of an oscillation has no floor", "[fit]") {
  const PronySeries truth{1e5, {{6e5, 0.01}, {3e5, 0.3}, {1e5, 10.0}}};
  int flagged = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    flagged += has_flag(fit_dma(sweep(truth, -3.0, 3.0, 8, 0.01, seed)), "noise-floor") ? 1 : 0;
  }
  CHECK(flagged <= 2);
}
