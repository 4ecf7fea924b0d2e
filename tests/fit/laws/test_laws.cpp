#include "fit/fit_creep.h"
#include "fit/fit_dma.h"
#include "fit/fit_relaxation.h"
#include "fit/intervals/flags.h"
#include "fit/laws/law_fit.h"
#include "models/material/retardation_spectrum.h"
#include "models/material/viscoelastic_models.h"
#include "tests/fit/laws/law_records.h"
#include "tests/fit/spectra.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <random>

using namespace viscard;
using namespace viscard::test;

namespace {

const FittedLaw& law(const FitResult& fit, const std::string& name) {
  const auto found = std::find_if(fit.laws.begin(), fit.laws.end(),
                                  [&](const FittedLaw& one) { return one.name == name; });
  REQUIRE(found != fit.laws.end());
  return *found;
}

const LawParameter& parameter(const FittedLaw& fitted, const std::string& name) {
  const auto found = std::find_if(fitted.parameters.begin(), fitted.parameters.end(),
                                  [&](const LawParameter& one) { return one.name == name; });
  CAPTURE(fitted.name, name);
  REQUIRE(found != fitted.parameters.end());
  return *found;
}

FitResult creep_fit(const Curve& curve, double noise = 0.0, unsigned seed = 1) {
  const std::vector<double> time_s = log_times(1e-2, 1e3, 200);
  return fit_creep({time_s, values_of(curve, time_s, noise, seed)}, with_laws());
}

FitResult dma_fit(const std::function<std::complex<double>(double)>& modulus_Pa) {
  const std::vector<double> frequency_Hz = log_times(1e-3, 1e2, 60);
  std::vector<double> storage_Pa, loss_Pa;
  for (const double f_Hz : frequency_Hz) {
    const std::complex<double> value = modulus_Pa(2.0 * M_PI * f_Hz);
    storage_Pa.push_back(value.real());
    loss_Pa.push_back(value.imag());
  }
  return fit_dma({frequency_Hz, storage_Pa, loss_Pa}, with_laws());
}

// A ramp of strain to 0.01 within 1 s, then a hold; `summed` is the integral of E from 0 to t.
FitResult ramp_fit(const Curve& summed) {
  RelaxationData data;
  for (int i = 0; i <= 20; ++i) data.time_s.push_back(0.05 * i);
  for (const double t_s : log_times(1.05, 1e3, 150)) data.time_s.push_back(t_s);
  for (const double t_s : data.time_s) {
    data.strain.push_back(0.01 * std::min(1.0, t_s));
    data.value.push_back(0.01 * (summed(t_s) - (t_s > 1.0 ? summed(t_s - 1.0) : 0.0)));
  }
  return fit_relaxation(data, with_laws());
}

std::complex<double> power(double w, double alpha) {
  return std::polar(std::pow(w, alpha), 0.5 * M_PI * alpha);
}

void check(const FittedLaw& fitted, const char* name, double truth, double relative = 1e-4) {
  CAPTURE(fitted.name, name);
  CHECK(parameter(fitted, name).value == Approx(truth).epsilon(relative));
}

}  // namespace

TEST_CASE("a springpot is found in relaxation, creep, oscillation and behind a ramp", "[fit]") {
  constexpr double c = 3e5, alpha = 0.3;
  for (const FitResult& fit :
       {relaxation_fit([&](double t) { return c * std::pow(t, -alpha) / std::tgamma(1 - alpha); }),
        creep_fit([&](double t) { return std::pow(t, alpha) / (c * std::tgamma(1 + alpha)); }),
        dma_fit([&](double w) { return c * power(w, alpha); }),
        ramp_fit([&](double t) { return c * std::pow(t, 1 - alpha) / std::tgamma(2 - alpha); })}) {
    const FittedLaw& found = law(fit, "springpot");
    check(found, "c_Pa_s_alpha", c);
    check(found, "alpha", alpha);
    CHECK(found.bic_difference < -10.0);
    CHECK_FALSE(found.is_at_bound);
  }
}

TEST_CASE("fractional Kelvin-Voigt and Maxwell elements are one law in all tests", "[fit]") {
  constexpr double E = 2e5, c = 3e5, alpha = 0.4;
  const double lambda = std::pow(c / E, 1.0 / alpha);  // also the time of the Maxwell element
  const FractionalZenerModel decay{0.0, 1.0, lambda, alpha};
  const auto relaxed = [&](double t) { return relaxation_modulus_Pa(decay, t); };
  for (const FitResult& fit :
       {relaxation_fit(
            [&](double t) { return E + c * std::pow(t, -alpha) / std::tgamma(1 - alpha); }),
        creep_fit([&](double t) { return (1.0 - relaxed(t)) / E; }),
        dma_fit([&](double w) { return E + c * power(w, alpha); }), ramp_fit([&](double t) {
          return E * t + c * std::pow(t, 1 - alpha) / std::tgamma(2 - alpha);
        })}) {
    const FittedLaw& found = law(fit, "fractional-kelvin-voigt");
    check(found, "E_inf_Pa", E);
    check(found, "c_Pa_s_alpha", c);
    check(found, "alpha", alpha);
  }
  for (const FitResult& fit :
       {relaxation_fit([&](double t) { return E * relaxed(t); }), creep_fit([&](double t) {
          return 1.0 / E + std::pow(t, alpha) / (c * std::tgamma(1 + alpha));
        }),
        dma_fit([&](double w) { return 1.0 / (1.0 / E + 1.0 / (c * power(w, alpha))); })}) {
    const FittedLaw& found = law(fit, "fractional-maxwell");
    check(found, "E_1_Pa", E);
    check(found, "tau_s", lambda, 1e-3);
    check(found, "alpha", alpha);
  }
}

TEST_CASE("a fractional Zener solid is one law in relaxation, creep and oscillation", "[fit]") {
  const FractionalZenerModel truth{1e6, 2e6, 3.0, 0.6};
  for (const FitResult& fit :
       {relaxation_fit([&](double t) { return relaxation_modulus_Pa(truth, t); }),
        creep_fit([&](double t) { return creep_compliance_1_Pa(truth, t); }),
        dma_fit([&](double w) { return complex_modulus_Pa(truth, w); })}) {
    const FittedLaw& found = law(fit, "fractional-zener");
    check(found, "E_inf_Pa", 1e6);
    check(found, "E_1_Pa", 2e6);
    check(found, "tau_s", 3.0, 1e-3);
    check(found, "alpha", 0.6);
    CHECK(found.bic_difference < -10.0);
    for (const FittedLaw& other : fit.laws) CHECK(other.bic >= found.bic);
  }
}

TEST_CASE("a stretched exponential is found in relaxation and in compliance", "[fit]") {
  const FitResult fit =
      relaxation_fit([](double t) { return 1e6 + 2e6 * std::exp(-std::pow(t / 3.0, 0.45)); });
  const FittedLaw& found = law(fit, "kww");
  check(found, "E_inf_Pa", 1e6);
  check(found, "E_1_Pa", 2e6);
  check(found, "tau_s", 3.0, 1e-3);
  check(found, "beta", 0.45);
  const FitResult creep =
      creep_fit([](double t) { return 1e-7 + 2e-7 * -std::expm1(-std::pow(t / 30.0, 0.45)); });
  check(law(creep, "kww"), "J_g_1_Pa", 1e-7, 1e-3);
  check(law(creep, "kww"), "lambda_s", 30.0, 1e-3);
  check(law(creep, "kww"), "beta", 0.45);
}

TEST_CASE("intervals of laws cover the truth", "[fit]") {
  int n_inside = 0, n_all = 0;
  const auto count = [&](const LawParameter& one, double truth) {
    n_inside += one.interval_95.low <= truth && truth <= one.interval_95.high ? 1 : 0;
    ++n_all;
  };
  for (unsigned seed = 1; seed <= 25; ++seed) {
    const FitResult relaxation = relaxation_fit(
        [](double t) { return 1e6 + 2e6 * std::exp(-std::pow(t / 3.0, 0.5)); }, 0.01, seed);
    count(parameter(law(relaxation, "kww"), "beta"), 0.5);
    count(parameter(law(relaxation, "kww"), "tau_s"), 3.0);
    count(parameter(law(relaxation, "kww"), "E_inf_Pa"), 1e6);
    const FitResult creep =
        creep_fit([](double t) { return std::pow(t, 0.3) / (3e5 * std::tgamma(1.3)); }, 0.01, seed);
    // Its noise is relative and the fit assumes an even one: only the exponent's scatter is near.
    count(parameter(law(creep, "springpot"), "c_Pa_s_alpha"), 3e5);
  }
  CAPTURE(n_inside, n_all);
  CHECK(n_inside >= 0.85 * n_all);
}

TEST_CASE("two separate terms are no law, and a law in their place is a misfit", "[fit]") {
  FitResult fit = fit_relaxation(relaxation_of(s2(), 4000, 1000.0, 0.002, 5), with_laws());
  for (const FittedLaw& one : fit.laws) {
    CAPTURE(one.name);
    CHECK(one.bic_difference > 10.0);
  }
  take_law("kww", fit);
  judge(fit);
  CHECK_FALSE(fit.is_trustworthy);
  const auto has = [&](const char* name) {
    return std::any_of(fit.flags.begin(), fit.flags.end(),
                       [&](const MaterialFlag& flag) { return flag.name == name; });
  };
  CHECK(has("misfit"));
  CHECK(has("law-as-series"));
}

TEST_CASE("the series of a law keeps its stated error over its window", "[fit]") {
  const FractionalZenerModel truth{1e6, 2e6, 3.0, 0.6};
  SECTION("relaxation") {
    FitResult fit = relaxation_fit([&](double t) { return relaxation_modulus_Pa(truth, t); });
    take_law("fractional-zener", fit);
    const FittedLaw& found = law(fit, "fractional-zener");
    CHECK(found.series_error < 1e-3);
    const PronySeries series = young_series(material_from_fit(fit, 0.495, 0.0));
    for (const double t : log_times(found.t_min_s, found.t_max_s, 301)) {
      CHECK(relaxation_modulus_Pa(series, t) ==
            Approx(relaxation_modulus_Pa(truth, t)).epsilon(1.05 * found.series_error + 1e-4));
    }
    CHECK(found.t_min_s == Approx(1e-2));
    CHECK(found.t_max_s == Approx(1e3));
    CHECK(fit.covariance.rows() == static_cast<Eigen::Index>(1 + 2 * fit.terms.size()));
    CHECK_NOTHROW(validate(material_from_fit(fit, 0.495, 0.0)));
  }
  SECTION("creep") {
    FitResult fit = creep_fit([&](double t) { return creep_compliance_1_Pa(truth, t); });
    for (const char* name : {"fractional-zener", "springpot", "fractional-maxwell", "kww"}) {
      FitResult one = fit;
      take_law(name, one);
      CHECK_NOTHROW(validate(material_from_fit(one, 0.495, 0.0)));
    }
    take_law("fractional-zener", fit);
    const FittedLaw& found = law(fit, "fractional-zener");
    CHECK(found.series_error < 1e-3);
    const RetardationSpectrum spectrum =
        retardation_from_relaxation(young_series(material_from_fit(fit, 0.495, 0.0)));
    for (const double t : log_times(found.t_min_s, found.t_max_s, 301)) {
      CHECK(creep_compliance_1_Pa(spectrum, t) ==
            Approx(creep_compliance_1_Pa(truth, t)).epsilon(1.05 * found.series_error + 1e-4));
    }
  }
}

TEST_CASE("the intervals of a law's series are those of the law", "[fit]") {
  // E at 1 s from the covariance of the series and from that of E_inf, E_1, tau and beta.
  FitResult fit = relaxation_fit(
      [](double t) { return 1e6 + 2e6 * std::exp(-std::pow(t / 3.0, 0.5)); }, 0.01, 4);
  const double E_inf_se = parameter(law(fit, "kww"), "E_inf_Pa").se;
  take_law("kww", fit);
  CHECK(fit.E_inf_se_Pa == Approx(E_inf_se).epsilon(0.05));  // all of E_1 has relaxed at 2.5e5 s
  CHECK(fit.E0_interval_95.low < fit.E0_Pa);
  CHECK(fit.E0_interval_95.high - fit.E0_interval_95.low < 0.5 * fit.E0_Pa);
}
