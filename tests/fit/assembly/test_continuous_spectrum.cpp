// The continuous spectrum beside the series.
#include "fit/fit_creep.h"
#include "fit/fit_dma.h"
#include "fit/fit_indentation.h"
#include "fit/fit_relaxation.h"
#include "models/material/prony_series.h"
#include "tests/fit/fit_checks.h"
#include "tests/fit/spectra.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

using namespace viscard;
using namespace viscard::test;

namespace {

FitOptions with_spectrum() {
  FitOptions options;
  options.with_curves = false;
  options.with_spectrum = true;
  return options;
}

// The modulus of all terms that a window of half a decade around tau holds for certain, and may hold.
Interval held_modulus_Pa(const PronySeries& truth, double tau_s) {
  constexpr double kHalfDecades = 3.5 / 12.0, kUnsure = 1.0 / 12.0;
  Interval held;
  for (const MaxwellTerm& term : truth.terms) {
    const double away = std::abs(std::log10(term.relaxation_time_s / tau_s));
    if (away < kHalfDecades - kUnsure) held.low += term.modulus_Pa;
    if (away < kHalfDecades + kUnsure) held.high += term.modulus_Pa;
  }
  return held;
}

// Rows whose band holds the mean of the true spectrum.
double share_that_holds(const ContinuousSpectrum& spectrum, const PronySeries& truth) {
  constexpr double kWidth = 7.0 / 12.0 * std::numbers::ln10;
  double held = 0.0;
  for (const SpectrumRow& row : spectrum.rows) {
    const Interval modulus = held_modulus_Pa(truth, row.tau_s);
    const double slack_Pa = 1e-6 * instantaneous_modulus_Pa(truth);
    const bool is_held = row.H_95.low * kWidth <= modulus.high + slack_Pa &&
                         row.H_95.high * kWidth >= modulus.low - slack_Pa;
    held += is_held ? 1.0 : 0.0;
  }
  return held / static_cast<double>(spectrum.rows.size());
}

}  // namespace

TEST_CASE("the bands of a continuous spectrum hold the terms of a discrete one", "[fit]") {
  const PronySeries truth = s6();
  RelaxationData data;
  for (double t = 1e-3; t < 3e4; t *= 1.05) {
    data.time_s.push_back(t);
    data.value.push_back(relaxation_modulus_Pa(truth, t));
  }
  const double E0 = instantaneous_modulus_Pa(truth);
  double held = 0.0, E0_held = 0.0, E_inf_held = 0.0;
  constexpr int kRuns = 20;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal(0.0, 1e-3 * E0);
  for (int run = 0; run < kRuns; ++run) {
    RelaxationData noisy = data;
    for (double& value : noisy.value) value += normal(random);
    const FitResult fit = fit_relaxation(noisy, with_spectrum());
    REQUIRE(fit.spectrum);
    held += share_that_holds(*fit.spectrum, truth) / kRuns;
    E0_held += holds(fit.spectrum->E0_95, E0) ? 1.0 : 0.0;
    E_inf_held += holds(fit.spectrum->E_inf_95, truth.equilibrium_modulus_Pa) ? 1.0 : 0.0;
    for (const SpectrumRow& row : fit.spectrum->rows) {
      CHECK(row.H_95.low >= -1e-9 * E0);
      CHECK(row.H_Pa <= row.H_95.high * 1.01 + 1e-6 * E0);
      CHECK(row.H_Pa >= row.H_95.low * 0.99 - 1e-6 * E0);
    }
  }
  CHECK(held >= 0.92);
  CHECK(E0_held >= 17.0);  // 95 % of 20, less 2.2 standard deviations
  CHECK(E_inf_held >= 17.0);
}

TEST_CASE("the smoothest spectrum of a power law is the closed form", "[fit]") {
  // E(t) = E_1 t^-n has H = E_1 tau^-n / Gamma(n) (Ferry, ch. 4).
  constexpr double kE1_Pa = 1e6, kPower = 0.2;
  RelaxationData data;
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal(0.0, 1e-4);
  for (double t = 1e-3; t < 1e3; t *= 1.04) {
    data.time_s.push_back(t);
    data.value.push_back(kE1_Pa * std::pow(t, -kPower) * (1.0 + normal(random)));
  }
  const FitResult fit = fit_relaxation(data, with_spectrum());
  REQUIRE(fit.spectrum);
  int n_inside = 0, n_held = 0;
  for (const SpectrumRow& row : fit.spectrum->rows) {
    if (row.tau_s < 3e-2 || row.tau_s > 30.0) continue;  // the ends hold what lies beyond
    const double H_Pa = kE1_Pa * std::pow(row.tau_s, -kPower) / std::tgamma(kPower);
    INFO(row.tau_s);
    CHECK(std::abs(row.H_Pa / H_Pa - 1.0) < 0.1);
    n_held += row.H_95.low < H_Pa * 1.005 && row.H_95.high > H_Pa * 0.995 ? 1 : 0;
    ++n_inside;
  }
  CHECK(n_inside >= 10);
  CHECK(n_held >= n_inside - 1);
}

TEST_CASE("a spectrum comes from oscillations and indentations, and not from creep", "[fit]") {
  const PronySeries truth = s2();
  DmaData sweep;
  for (double f = 1e-4; f < 10.0; f *= 1.2) {
    double storage_Pa = truth.equilibrium_modulus_Pa, loss_Pa = 0.0;
    for (const MaxwellTerm& term : truth.terms) {
      const double x = 2.0 * std::numbers::pi * f * term.relaxation_time_s;
      storage_Pa += term.modulus_Pa * x * x / (1.0 + x * x);
      loss_Pa += term.modulus_Pa * x / (1.0 + x * x);
    }
    const double shake = 1.0 + 1e-3 * std::sin(1e4 * f);
    sweep.frequency_Hz.push_back(f);
    sweep.storage_Pa.push_back(storage_Pa * shake);
    sweep.loss_Pa.push_back(loss_Pa * shake);
  }
  const FitResult of_sweep = fit_dma(sweep, with_spectrum());
  REQUIRE(of_sweep.spectrum);
  CHECK(share_that_holds(*of_sweep.spectrum, truth) >= 0.85);
  const FitResult pressed = fit_indentation(
      indentation_of(truth, even_times(120.0, 0.05), ramp_and_hold(1.0), 1e-3, 3), with_spectrum());
  REQUIRE(pressed.spectrum);
  CHECK(share_that_holds(*pressed.spectrum, truth) >= 0.9);
  CHECK(holds(pressed.spectrum->E0_95, instantaneous_modulus_Pa(truth)));
  CreepData creep;
  for (double t = 0.1; t < 200.0; t += 0.1) {
    creep.time_s.push_back(t);
    creep.compliance_1_Pa.push_back((1.0 - 0.2 * std::exp(-t / 10.0) + 1e-4 * std::sin(1e4 * t)) /
                                    1.6);
  }
  CHECK_FALSE(fit_creep(creep, with_spectrum()).spectrum);
}
