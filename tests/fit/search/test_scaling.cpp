#include "fit/curves/history_model.h"
#include "fit/curves/step_model.h"
#include "fit/fit_relaxation.h"
#include "fit/search/projection.h"
#include "tests/fit/spectra.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>

using namespace viscard;
using namespace viscard::test;

TEST_CASE("the units of modulus and time change only the unit of the result", "[fit][stability]") {
  const double modulus_scale = GENERATE(1e-3, 1e6, 1e12);
  const double time_scale = GENERATE(1e-9, 1.0, 1e9);
  const RelaxationData data = relaxation_of(s2(), 3000, 1000.0, 0.01, 11);
  RelaxationData scaled = data;
  for (double& t : scaled.time_s) t *= time_scale;
  for (double& value : scaled.value) value *= modulus_scale;
  const FitResult a = fit_relaxation(data);
  const FitResult b = fit_relaxation(scaled);
  REQUIRE(a.terms.size() == 2);
  REQUIRE(b.terms.size() == 2);
  // Powers of ten round the data by 1e-16, and the condition number of the problem is about 100
  // (measured: 8e-15). Standard errors use differences of logarithms for the slopes (4e-11).
  CHECK(b.E_inf_Pa == Approx(a.E_inf_Pa * modulus_scale).epsilon(1e-13));
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(b.terms[i].tau_s == Approx(a.terms[i].tau_s * time_scale).epsilon(1e-13));
    CHECK(b.terms[i].modulus_Pa == Approx(a.terms[i].modulus_Pa * modulus_scale).epsilon(1e-13));
    CHECK(b.terms[i].ln_tau_se == Approx(a.terms[i].ln_tau_se).epsilon(1e-9));
  }
}

TEST_CASE("samples out of order or repeated give the same fit as sorted ones", "[fit][stability]") {
  const RelaxationData data = relaxation_of(s2(), 500, 1000.0, 0.005, 12);
  std::vector<std::size_t> order(500);
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), std::mt19937_64(3));
  RelaxationData shuffled;
  for (const std::size_t i : order) {
    shuffled.time_s.push_back(data.time_s[i]);
    shuffled.value.push_back(data.value[i]);
  }
  CHECK(fit_relaxation(shuffled).E0_Pa == fit_relaxation(data).E0_Pa);
  RelaxationData twice = data;
  twice.time_s.insert(twice.time_s.end(), data.time_s.begin(), data.time_s.end());
  twice.value.insert(twice.value.end(), data.value.begin(), data.value.end());
  const FitResult repeated = fit_relaxation(twice);
  CHECK(std::isfinite(repeated.E0_Pa));
  CHECK(repeated.E_inf_Pa == Approx(fit_relaxation(data).E_inf_Pa).epsilon(1e-2));
}

TEST_CASE("thirty terms over twenty decades stay finite and fit", "[fit][stability]") {
  PronySeries truth{1.0, {}};
  for (int i = 0; i < 30; ++i)
    truth.terms.push_back({0.1, std::pow(10.0, -10.0 + 20.0 * i / 29.0)});
  RelaxationData data;
  for (int i = 0; i <= 400; ++i) {
    const double t = std::pow(10.0, -11.0 + 22.0 * i / 400.0);
    data.time_s.push_back(t);
    data.value.push_back(relaxation_modulus_Pa(truth, t));
  }
  const FitResult fit = fit_relaxation(data);
  CHECK(fit.terms.size() >= 20);
  CHECK(std::sqrt(fit.rss / 401.0) < 1e-3);
  for (const FittedTerm& term : fit.terms) {
    CHECK(std::isfinite(term.modulus_Pa));
    CHECK(std::isfinite(term.tau_s));
    CHECK(std::isfinite(term.modulus_se_Pa));
  }
}

TEST_CASE("times from 1e-12 to 1e12 sampling intervals give finite sums and gradients",
          "[fit][stability]") {
  const RelaxationData data = relaxation_of(s2(), 3000, 1000.0, 0.01, 13);
  const StepModel step(data.time_s, data.value, StepShape::kRelaxation, {});
  const IndentationData pressed =
      indentation_of(s2(), even_times(60.0, 0.02), ramp_and_hold(1.0), 1e-3, 14);
  HistoryInput input;
  input.time_s = pressed.time_s;
  input.input = pressed.depth_m;
  input.output = pressed.force_N;
  const HistoryModel history(input, {});
  for (const SpectralModel* model :
       {static_cast<const SpectralModel*>(&step), static_cast<const SpectralModel*>(&history)}) {
    for (int decade = -12; decade <= 12; decade += 2) {
      CAPTURE(decade);
      const Eigen::VectorXd ln_tau =
          Eigen::Vector2d(std::log(0.02) + decade * std::log(10.0), std::log(5.0));
      const Projection at = project(*model, ln_tau);
      CHECK(std::isfinite(at.rss));
      CHECK(at.coefficients.allFinite());
      CHECK(at.gradient.allFinite());
      CHECK(at.normal.allFinite());
    }
  }
}

TEST_CASE("records of a nanosecond and of thirty years are fitted alike", "[fit][stability]") {
  const double window_s = GENERATE(1e-9, 1e9);
  const double unit = GENERATE(1e-3, 1e12);
  RelaxationData data = relaxation_of(s2(), 2500, 1000.0, 0.005, 15);
  for (double& t : data.time_s) t *= window_s / 1000.0;
  for (double& value : data.value) value *= unit;
  const FitResult fit = fit_relaxation(data);
  REQUIRE(fit.terms.size() == 2);
  CHECK(fit.terms[1].tau_s == Approx(0.04 * window_s).epsilon(0.1));
  CHECK(fit.E_inf_Pa == Approx(1.6 * unit).epsilon(2e-3));
}
