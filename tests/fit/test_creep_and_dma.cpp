#include "fit/fit_creep.h"
#include "fit/fit_dma.h"
#include "models/material/retardation_spectrum.h"
#include "tests/fit/spectra.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <random>

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
