#include "fit/curves/bin_arrays.h"
#include "fit/curves/step_model.h"
#include "fit/fit_relaxation.h"
#include "fit/samples/log_bins.h"
#include "fit/search/order_choice.h"
#include "tests/fit/fit_checks.h"
#include "tests/fit/spectra.h"

#include <Eigen/QR>
#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace viscard;
using namespace viscard::test;

TEST_CASE("S2 gives two terms that lie in their intervals", "[fit]") {
  const FitResult fit = fit_relaxation(relaxation_of(s2(), 10000, 1000.0, 0.01, 1));
  REQUIRE(fit.terms.size() == 2);
  // Four standard errors; the seed is fixed, so this fails only if the fit changes.
  CHECK(std::abs(fit.terms[0].modulus_Pa - 0.12) < 4.0 * fit.terms[0].modulus_se_Pa);
  CHECK(std::abs(std::log(fit.terms[1].tau_s / 40.0)) < 4.0 * fit.terms[1].ln_tau_se);
  CHECK(fit.E_inf_Pa == Approx(1.6).epsilon(2e-3));
  CHECK(fit.noise.sigma == Approx(0.018).epsilon(0.03));
  CHECK(fit.noise.inflation == 1.0);
}

TEST_CASE("rounding of noise-free data does not give a term", "[fit]") {
  RelaxationData data;
  for (int k = -8; k < 17; ++k) {
    const double t = std::pow(10.0, k / 8.0);
    for (int again = 0; again < 3; ++again) {
      data.time_s.push_back(t);
      data.value.push_back(1e6 + 5e5 * std::exp(-t / 3.0));
    }
  }
  const FitResult fit = fit_relaxation(data);
  REQUIRE(fit.terms.size() == 1);
  CHECK(fit.terms[0].tau_s == Approx(3.0).epsilon(1e-12));  // a few rounding errors of the data
}

TEST_CASE("two terms of opposite sign that nearly cancel do not make E0 certain",
          "[fit][stability]") {
  // Regression: nine samples, terms of 174 and -174 times E0. The covariance has entries of 1e16,
  // and rounding once made their sum negative, which was reported as a zero error.
  FitOptions options;
  options.n_terms = 3;
  options.allow_negative = true;
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0.0, 2e4);
  for (int draw = 0; draw < 20; ++draw) {
    RelaxationData data;
    for (int i = 0; i < 9; ++i) {
      const double t = 0.1 * std::pow(10.0, i * 4.0 / 9.0);
      data.time_s.push_back(t);
      data.value.push_back(1e6 + 5e5 * std::exp(-t / 3.0) + noise(random));
    }
    const FitResult fit = fit_relaxation(data, options);
    CAPTURE(draw, fit.terms.size());
    CHECK(fit.E0_se_Pa > 1e2);  // the noise is 2e4 Pa
    CHECK(fit.E_inf_se_Pa > 1e2);
  }
}

TEST_CASE("S6 sampled too coarsely for its two fastest terms gives four terms and a flag",
          "[fit]") {
  const FitResult fit = fit_relaxation(relaxation_of(s6(), 10000, 1e4, 0.01, 2));
  CHECK(fit.terms.size() == 4);
  CHECK(has_flag(fit, "tau-below-sampling"));
}

TEST_CASE("S6 at a million samples gives all six terms", "[fit][slow]") {
  const FitResult fit = fit_relaxation(relaxation_of(s6(), 1000000, 1e4, 0.01, 2));
  REQUIRE(fit.terms.size() == 6);
  CHECK(fit.E_inf_Pa == Approx(1.0).epsilon(1e-3));
}

TEST_CASE("S2 at a million samples gives two terms", "[fit][slow]") {
  CHECK(fit_relaxation(relaxation_of(s2(), 1000000, 1000.0, 0.01, 1)).terms.size() == 2);
}

TEST_CASE("terms whose times differ by 1.3 are merged", "[fit]") {
  const PronySeries truth{1.0, {{0.1, 10.0}, {0.1, 13.0}}};
  const FitResult fit = fit_relaxation(relaxation_of(truth, 5000, 200.0, 0.005, 5));
  REQUIRE(fit.terms.size() == 1);
  CHECK(fit.terms[0].tau_s > 10.0);
  CHECK(fit.terms[0].tau_s < 13.0);
}

TEST_CASE("a time ten times the record is flagged", "[fit]") {
  const PronySeries truth{1.0, {{0.3, 1.0}, {0.5, 1000.0}}};
  const FitResult fit = fit_relaxation(relaxation_of(truth, 5000, 100.0, 0.002, 6));
  const bool flagged = has_flag(fit, "tau-beyond-window") || has_flag(fit, "slower-relaxation");
  CHECK(flagged);
}

TEST_CASE("a constant modulus gives no term", "[fit]") {
  const auto seed = GENERATE(1U, 2U, 3U, 4U, 5U, 6U);
  const FitResult fit = fit_relaxation(relaxation_of({1.0, {}}, 3000, 100.0, 0.01, seed));
  CHECK(fit.terms.empty());
  CHECK(fit.E0_Pa == Approx(1.0).epsilon(1e-3));
  CHECK(fit.sum_g == Approx(0.0).margin(1e-12));
}

TEST_CASE("averages in log time give the same fit as all samples", "[fit]") {
  const RelaxationData data = relaxation_of(s2(), 20000, 1000.0, 0.01, 8);
  FitOptions all;
  all.full_data = true;
  all.n_terms = 2;
  FitOptions averaged = all;
  averaged.full_data = false;
  const FitResult a = fit_relaxation(data, all);
  const FitResult b = fit_relaxation(data, averaged);
  // Averaging loses little of the information within a bin: a few hundredths of a standard error.
  CHECK(std::abs(a.E0_Pa - b.E0_Pa) < 0.1 * a.E0_se_Pa);
  CHECK(b.E0_se_Pa == Approx(a.E0_se_Pa).epsilon(0.02));
  // The reported residual sum is that of the samples.
  double rss = 0.0;
  for (std::size_t i = 0; i < data.time_s.size(); ++i) {
    double value = b.E_inf_Pa;
    for (const FittedTerm& term : b.terms) {
      value += term.modulus_Pa * std::exp(-data.time_s[i] / term.tau_s);
    }
    rss += std::pow(data.value[i] - value, 2);
  }
  CHECK(b.rss == Approx(rss).epsilon(1e-7));
}

TEST_CASE("the average of an exponential over a bin equals that of its samples", "[fit]") {
  const std::vector<double> times = even_times(100.0, 0.01);
  const std::vector<LogBin> bins = log_bins(times, times, 60.0);
  const BinArrays arrays(bins);
  const double tau_s = GENERATE(0.004, 0.3, 7.0, 300.0);
  std::vector<double> value(bins.size()), slopes(bins.size());
  decay_column(arrays.places(true), 1.0 / tau_s, value.data(), slopes.data());
  for (std::size_t b = 0; b < bins.size(); ++b) {
    const LogBin& bin = bins[b];
    const double root = std::sqrt(bin.count);
    double sum = 0.0;
    double slope = 0.0;
    for (std::size_t i = bin.begin; i < bin.end; ++i) {
      sum += std::exp(-times[i] / tau_s);
      slope += times[i] / tau_s * std::exp(-times[i] / tau_s);
    }
    CHECK(value[b] / root == Approx(sum / bin.count).epsilon(0).margin(3e-10));
    CHECK(slopes[b] / root == Approx(slope / bin.count).epsilon(0).margin(3e-9));
  }
}

TEST_CASE("prediction errors of left-out blocks of a linear model equal those of separate fits",
          "[fit]") {
  const RelaxationData data = relaxation_of(s2(), 60, 1000.0, 0.01, 9);
  const StepModel model(data.time_s, data.value, StepShape::kRelaxation, {});
  const SpectralState state = solve_coefficients(model, Eigen::VectorXd(0), {});
  std::vector<int> blocks;
  for (int i = 0; i < 60; ++i) blocks.push_back(i / 6);
  const std::vector<LeftOut> errors = left_out_errors(model, state, blocks);
  REQUIRE(errors.size() == 10);
  for (int b = 0; b < 10; ++b) {
    double mean = 0.0;
    for (int i = 0; i < 60; ++i)
      mean += blocks[static_cast<std::size_t>(i)] == b
                  ? 0.0
                  : data.value[static_cast<std::size_t>(i)] / 54.0;
    double error = 0.0;
    for (int i = 6 * b; i < 6 * b + 6; ++i) {
      error += std::pow(data.value[static_cast<std::size_t>(i)] - mean, 2);
    }
    CHECK(errors[static_cast<std::size_t>(b)].squared_error == Approx(error).epsilon(1e-10));
  }
}

TEST_CASE("a term that is slower than the record needs strong evidence", "[fit]") {
  // A term of 0.8 s and, in a record of 30 s, one of 20 s with a modulus from zero to clearly
  // visible.
  int withstood = 0, found = 0;
  for (int step = 1; step <= 24; ++step) {
    const double modulus = 4e-4 * step;
    const PronySeries truth{1.6, {{0.12, 0.8}, {modulus, 20.0}}};
    FitOptions options;
    options.with_curves = false;
    const FitResult fit = fit_relaxation(relaxation_of(truth, 1500, 30.0, 0.003, 41), options);
    if (fit.orders.size() < 3) continue;
    const double gain = fit.orders[1].bic - fit.orders[2].bic;
    CAPTURE(modulus, gain, fit.terms.size());
    if (fit.terms.size() == 1 && gain > 0.0) ++withstood;
    if (fit.terms.size() == 2) ++found;
    if (fit.terms.size() == 2 && fit.terms[1].tau_s > 10.0) CHECK(gain >= 6.0);
    if (gain > 20.0) CHECK(fit.terms.size() >= 2);
  }
  CHECK(withstood > 0);  // BIC alone would have chosen the term
  CHECK(found > 0);
}
