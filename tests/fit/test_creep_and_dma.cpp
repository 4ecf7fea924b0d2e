#include "fit/fit_creep.h"
#include "fit/fit_dma.h"
#include "models/material/retardation_spectrum.h"
#include "tests/fit/fit_checks.h"
#include "tests/fit/spectra.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

using namespace viscard;
using namespace viscard::test;

TEST_CASE("the creep of a material gives its relaxation series", "[fit]") {
  const PronySeries truth = s2();
  const RetardationSpectrum spectrum = retardation_from_relaxation(truth);
  CreepData data;
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  for (int i = 0; i <= 300; ++i) {
    const double t = std::pow(10.0, -2.0 + 5.0 * i / 300.0);
    data.time_s.push_back(t);
    data.compliance_1_Pa.push_back(creep_compliance_1_Pa(spectrum, t) *
                                   (1 + 1e-4 * normal(random)));
  }
  const FitResult fit = fit_creep(data);
  REQUIRE(fit.terms.size() == 2);
  CHECK(std::abs(fit.E0_Pa - 1.8) < 4.0 * fit.E0_se_Pa);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(std::abs(fit.terms[i].modulus_Pa - truth.terms[i].modulus_Pa) <
          4.0 * fit.terms[i].modulus_se_Pa);
    CHECK(std::abs(std::log(fit.terms[i].tau_s / truth.terms[i].relaxation_time_s)) <
          4.0 * fit.terms[i].ln_tau_se);
    CHECK(fit.terms[i].ln_tau_se < 0.05);
  }
}

TEST_CASE("the creep of a liquid gives E_inf = 0 and one term more than it has retardations",
          "[fit]") {
  RetardationSpectrum spectrum{1.0, {{0.5, 3.0}}, 0.01};
  CreepData data;
  for (int i = 0; i <= 200; ++i) {
    const double t = std::pow(10.0, -2.0 + 5.0 * i / 200.0);
    data.time_s.push_back(t);
    data.compliance_1_Pa.push_back(creep_compliance_1_Pa(spectrum, t));
  }
  FitOptions options;
  options.is_liquid = true;
  options.n_terms = 1;
  const FitResult fit = fit_creep(data, options);
  const PronySeries truth = relaxation_from_retardation(spectrum);
  CHECK(fit.E_inf_Pa == 0.0);
  REQUIRE(fit.terms.size() == 2);
  CHECK(fit.terms[1].tau_s == Approx(truth.terms[1].relaxation_time_s).epsilon(1e-6));
  CHECK(fit.E0_Pa == Approx(1.0).epsilon(1e-8));
}

TEST_CASE("storage and loss moduli give the series behind them", "[fit]") {
  DmaData data;
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i <= 120; ++i) {
    const double f = std::pow(10.0, -5.0 + 7.0 * i / 120.0);
    const ComplexModulus modulus = complex_modulus_Pa(s6(), 2.0 * std::numbers::pi * f);
    data.frequency_Hz.push_back(f);
    data.storage_Pa.push_back(modulus.storage_Pa * (1 + 2e-3 * normal(random)));
    data.loss_Pa.push_back(modulus.loss_Pa * (1 + 2e-3 * normal(random)));
  }
  const FitResult fit = fit_dma(data);
  REQUIRE(fit.terms.size() == 6);
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK(fit.terms[i].tau_s == Approx(s6().terms[i].relaxation_time_s).epsilon(0.05));
    CHECK(fit.terms[i].modulus_Pa == Approx(s6().terms[i].modulus_Pa).epsilon(0.05));
  }
  CHECK(fit.noise.sigma == Approx(2e-3).epsilon(0.2));
}

TEST_CASE("a spectrum wider than the maximum number of terms uses all of them", "[fit]") {
  // The misfit of three terms must not be mistaken for autocorrelated noise.
  DmaData data;
  for (int i = 0; i <= 120; ++i) {
    const double f = std::pow(10.0, -5.0 + 7.0 * i / 120.0);
    const ComplexModulus modulus = complex_modulus_Pa(s6(), 2.0 * std::numbers::pi * f);
    data.frequency_Hz.push_back(f);
    data.storage_Pa.push_back(modulus.storage_Pa);
    data.loss_Pa.push_back(modulus.loss_Pa);
  }
  FitOptions options;
  options.max_terms = 3;
  CHECK(fit_dma(data, options).terms.size() == 3);
}

namespace {

// Strain under steps of stress (time in s, change in Pa) by superposition, with noise.
CreepData strain_under(const RetardationSpectrum& spectrum,
                       const std::vector<std::pair<double, double>>& steps, double noise,
                       std::uint64_t seed) {
  CreepData data;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  for (int i = 1; i <= 900; ++i) {
    const double t = 0.2 * i;
    double strain = noise * normal(random), stress = 0.0;
    for (const auto& [at_s, change] : steps) {
      if (t < at_s) continue;
      strain += change * creep_compliance_1_Pa(spectrum, t - at_s);
      stress += change;
    }
    data.time_s.push_back(t);
    data.compliance_1_Pa.push_back(strain);
    data.stress_Pa.push_back(stress);
  }
  return data;
}

}  // namespace

TEST_CASE("creep with recovery, pulses and stairs of stress give the material of all their rows",
          "[fit]") {
  const RetardationSpectrum spectrum{0.5, {{0.2, 2.0}, {0.15, 20.0}}, 0.0};
  const PronySeries truth = relaxation_from_retardation(spectrum);
  const std::vector<std::pair<double, double>> recovery{{0.0, 1.0}, {60.1, -1.0}},
      pulses{{0.0, 1.0}, {30.1, -1.0}, {70.1, 2.0}, {120.1, -2.0}},
      stairs{{0.0, 0.5}, {40.1, 0.5}, {80.1, 0.5}};
  for (const auto& steps : {recovery, pulses, stairs}) {
    int n_held = 0, n_rest_held = 0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      const FitResult fit = fit_creep(strain_under(spectrum, steps, 1e-3, seed));
      CHECK(fit.is_trustworthy);
      CHECK(fit.n_samples == 900);
      CHECK(fit.terms.size() == 2);
      CHECK(has_flag(fit, "time-zero-chosen"));
      n_held += holds(fit.E0_interval_95, instantaneous_modulus_Pa(truth)) ? 1 : 0;
      n_rest_held += holds(fit.E_inf_interval_95, truth.equilibrium_modulus_Pa) ? 1 : 0;
    }
    CHECK(n_held >= 5);
    CHECK(n_rest_held >= 4);
  }
}

TEST_CASE("recovery shows the flow of a liquid apart from its delayed strain", "[fit]") {
  const RetardationSpectrum spectrum{0.5, {{0.3, 5.0}}, 0.004};
  const CreepData data = strain_under(spectrum, {{0.0, 1.0}, {80.1, -1.0}}, 1e-4, 4);
  const FitResult fit = fit_creep(data);
  CHECK(has_flag(fit, "liquid"));
  REQUIRE(fit.terms.size() == 2);
  const PronySeries truth = relaxation_from_retardation(spectrum);
  CHECK(fit.terms[1].tau_s == Approx(truth.terms[1].relaxation_time_s).epsilon(0.01));
  FitOptions several;
  several.keep_rows = true;
  CHECK_THROWS_WITH(fit_creep(data, several), Catch::Contains("fit it alone"));
}

TEST_CASE("a storage modulus alone gives the series within its frequencies and says what it hides",
          "[fit]") {
  const PronySeries truth{1.0e6, {{0.6e6, 0.02}, {0.4e6, 0.5}, {0.3e6, 8.0}}};
  DmaData data;
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 50; ++i) {
    const double f_Hz = 0.003 * std::pow(10.0, 5.0 * i / 49.0);
    data.frequency_Hz.push_back(f_Hz);
    data.storage_Pa.push_back(complex_modulus_Pa(truth, 2.0 * std::numbers::pi * f_Hz).storage_Pa *
                              (1.0 + 1e-3 * normal(random)));
  }
  const FitResult fit = fit_dma(data, {});
  REQUIRE(fit.terms.size() == 3);
  CHECK(holds(fit.E0_interval_95, 2.3e6));
  CHECK(holds(fit.E_inf_interval_95, 1.0e6));
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(holds(fit.terms[i].modulus_Pa_95, truth.terms[i].modulus_Pa));
    CHECK(holds(fit.terms[i].tau_s_95, truth.terms[i].relaxation_time_s));
  }
  CHECK(has_flag(fit, "storage-alone"));
  // Relaxation slower than the sweep adds a constant.
  CHECK(fit.E_inf_interval_95.low < 0.9e6);
}

TEST_CASE("losses that are counted negative are refused with the column to flip", "[fit]") {
  DmaData data;
  for (int i = 0; i < 20; ++i) {
    const double w = 0.1 * std::pow(1.5, i), x = 0.3 * w;
    data.frequency_Hz.push_back(w / 6.283185307179586);
    data.storage_Pa.push_back(1e6 + 5e5 * x * x / (1.0 + x * x));
    data.loss_Pa.push_back(-5e5 * x / (1.0 + x * x));
  }
  CHECK_THROWS_WITH(fit_dma(data), Catch::Contains("--column loss_modulus_Pa=-NAME"));
}
