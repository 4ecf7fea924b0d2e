#include "fit/assembly/kramers_kronig.h"
#include "fit/assembly/stage_specimen.h"
#include "fit/curves/dma_model.h"
#include "fit/curves/stage_model.h"
#include "fit/fit_dma.h"
#include "fit/fit_relaxation.h"
#include "fit/indentation_from_capture.h"
#include "fit/intervals/uncertainty.h"
#include "fit/samples/noise_model.h"
#include "tests/fit/fit_checks.h"
#include "tests/fit/spectra.h"
#include "tests/support/in_memory_run.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

using namespace viscard;
using namespace viscard::test;

namespace {

double width(const Interval& interval) {
  return interval.high - interval.low;
}

}  // namespace

TEST_CASE("with plenty of data, profile likelihoods give the intervals of the covariance",
          "[fit][reduction]") {
  const RelaxationData data = relaxation_of(s2(), 20000, 1000.0, 0.002, 41);
  FitOptions options;
  options.n_terms = 2;
  options.white_noise = true;
  const FitResult plain = fit_relaxation(data, options);
  options.with_profiles = true;
  const FitResult fit = fit_relaxation(data, options);
  REQUIRE(fit.profiles.size() == 3);
  // The likelihood is quadratic to a few per cent: the errors of the times are below 2 %.
  CHECK(width(fit.E_inf_interval_95) == Approx(width(plain.E_inf_interval_95)).epsilon(0.03));
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(width(fit.terms[i].tau_s_95) == Approx(width(plain.terms[i].tau_s_95)).epsilon(0.03));
  }
  for (const ProfileCurve& curve : fit.profiles) {
    CHECK(std::is_sorted(curve.value.begin(), curve.value.end()));
    CHECK(*std::min_element(curve.rise.begin(), curve.rise.end()) >= -1e-6);
    CHECK(curve.rise.front() > 3.8);
    CHECK(curve.rise.back() > 3.8);
  }
}

TEST_CASE("a profile is asymmetric if the record ends before the term has relaxed", "[fit]") {
  const PronySeries truth{1.0, {{0.3, 1.0}, {0.2, 100.0}}};
  const RelaxationData data = relaxation_of(truth, 4000, 100.0, 0.01, 42);
  FitOptions options;
  options.n_terms = 2;
  options.with_profiles = true;
  const FitResult fit = fit_relaxation(data, options);
  REQUIRE(fit.terms.size() == 2);
  const Interval tau = fit.terms[1].tau_s_95;
  const double best = fit.terms[1].tau_s;
  CHECK(std::log(tau.high / best) > std::log(best / tau.low));
  // E_inf is bounded from above much more closely than from below, where only zero is a bound.
  CHECK(fit.E_inf_interval_95.high - fit.E_inf_Pa < fit.E_inf_Pa - fit.E_inf_interval_95.low);
  CHECK(fit.E_inf_interval_95.low >= 0.0);
}

TEST_CASE("the bootstrap agrees with the covariance, with and without autocorrelation of the noise",
          "[fit]") {
  const double rho = GENERATE(0.0, 0.8);
  CAPTURE(rho);
  const RelaxationData data = relaxation_of(s2(), 1500, 1000.0, 0.003, 43, rho);
  FitOptions options;
  options.n_terms = 2;
  const FitResult plain = fit_relaxation(data, options);
  options.n_bootstrap = 200;
  std::vector<double> done;
  options.resampled = [&](double fraction) { done.push_back(fraction); };
  const FitResult fit = fit_relaxation(data, options);
  CHECK(done.size() >= 200);
  for (const double fraction : done) CHECK((fraction >= 0.0 && fraction < 1.0));
  options.resampled = nullptr;
  CHECK(fit.n_bootstrap >= 190);
  // Percentiles of 200 refits are accurate to about 10 %, and blocks lose part of the
  // autocorrelation.
  CHECK(width(fit.E_inf_interval_95) == Approx(width(plain.E_inf_interval_95)).epsilon(0.35));
  CHECK(width(fit.terms[1].tau_s_95) == Approx(width(plain.terms[1].tau_s_95)).epsilon(0.35));
  CHECK(fit_relaxation(data, options).E0_interval_95.low == fit.E0_interval_95.low);  // fixed seed
}

TEST_CASE("storage and loss moduli that contradict each other are flagged", "[fit]") {
  DmaData data;
  for (int i = 0; i < 80; ++i) {
    const double f = std::pow(10.0, -4.0 + 0.1 * i);
    const ComplexModulus modulus = complex_modulus_Pa(s6(), 2.0 * std::numbers::pi * f);
    data.frequency_Hz.push_back(f);
    data.storage_Pa.push_back(modulus.storage_Pa);
    data.loss_Pa.push_back(modulus.loss_Pa);
  }
  CHECK_FALSE(has_flag(fit_dma(data), "storage-loss-contradict"));
  for (double& loss : data.loss_Pa) loss *= 1.5;  // for example friction of the instrument
  CHECK(has_flag(fit_dma(data), "storage-loss-contradict"));
}

TEST_CASE("many rows of single samples are correlated as their pairs are", "[fit]") {
  constexpr Eigen::Index kRows = 10001;  // above the number from which a convolution is used
  const Autoregression noise{{0.98}};
  const PairSums sums(noise);
  REQUIRE(sums.reach() > 256.0);
  Eigen::MatrixXd x(kRows, 2);
  std::vector<std::size_t> begins;
  for (Eigen::Index r = 0; r < kRows; ++r) {
    x(r, 0) = std::sin(0.01 * static_cast<double>(r));
    x(r, 1) = r % 7 == 0 ? 1.0 : -0.3;
    begins.push_back(static_cast<std::size_t>(r));
  }
  begins.push_back(static_cast<std::size_t>(kRows));
  const Eigen::MatrixXd found = correlated_rows(x, begins, noise);
  REQUIRE(found.rows() == kRows);
  for (const Eigen::Index r : {Eigen::Index{0}, Eigen::Index{1}, kRows / 2, kRows - 1}) {
    Eigen::RowVector2d direct = Eigen::RowVector2d::Zero();
    for (Eigen::Index s = 0; s < kRows; ++s) {
      const auto lag = static_cast<double>(s > r ? s - r : r - s);
      if (lag - 1.0 <= sums.reach()) direct += sums.over(1.0, 1.0, lag) * x.row(s);
    }
    CHECK((found.row(r) - direct).norm() < 1e-9 * direct.norm());
  }
}

TEST_CASE("a contradiction is found among more frequencies than ranges are looked at", "[fit]") {
  constexpr int kRows = 9001;
  DmaData data;
  for (int i = 0; i < kRows; ++i) {
    const double f = std::pow(10.0, -4.0 + 8.0 * i / kRows);
    const ComplexModulus modulus = complex_modulus_Pa(s6(), 2.0 * std::numbers::pi * f);
    data.frequency_Hz.push_back(f);
    data.storage_Pa.push_back(modulus.storage_Pa);
    data.loss_Pa.push_back(modulus.loss_Pa * (i > 4000 && i < 6000 ? 1.5 : 1.0));
  }
  const DmaModel model(data.frequency_Hz, data.storage_Pa, data.loss_Pa, {});
  Eigen::VectorXd ln_tau(static_cast<Eigen::Index>(s6().terms.size()));
  for (Eigen::Index i = 0; i < ln_tau.size(); ++i) {
    ln_tau[i] = std::log(s6().terms[static_cast<std::size_t>(i)].relaxation_time_s);
  }
  const auto found = kramers_kronig_break(model, ln_tau);
  REQUIRE(found);
  CHECK(found->is_loss);
  // The spectrum follows a part of the edges.
  CHECK(std::abs(std::log10(found->from_Hz / data.frequency_Hz[4001])) < 0.3);
  CHECK(std::abs(std::log10(found->to_Hz / data.frequency_Hz[5999])) < 0.3);
}

TEST_CASE("a negative modulus, or a frame softer than the whole, is no material and no error",
          "[fit]") {
  const IndentationData data = indentation_from_capture(in_memory_run(demo_truth(10, 1), {}));
  const StageModel model(data, nuisance_start(data), {.resting_N = 5e-4, .moving_N = 7e-4}, {});
  SpectralState state =
      solve_coefficients(model, Eigen::VectorXd::Constant(1, 0.0), model.nuisance_start());
  const SeriesFromState series = specimen_series_of(model, data, /*is_liquid=*/false);
  CHECK(possible_series(model, state, series));
  const double E_inf_N_m = state.coefficients[0];
  state.coefficients[0] = -1e-3 * E_inf_N_m;
  CHECK_FALSE(possible_series(model, state, series));
  state.coefficients[0] = 2.0 * data.frame_stiffness_N_m;
  CHECK_FALSE(possible_series(model, state, series));
}
