#include "fit/curves/creep_rows.h"
#include "fit/curves/dma_model.h"
#include "fit/curves/history_model.h"
#include "fit/curves/joint_model.h"
#include "fit/curves/stage_model.h"
#include "fit/curves/step_model.h"
#include "fit/indentation_from_capture.h"
#include "fit/search/separable.h"
#include "tests/fit/spectra.h"
#include "tests/support/in_memory_run.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace viscard;
using namespace viscard::test;

namespace {

// Largest difference between the hand-written derivative and central differences, relative to the
// largest entry of each column.
double worst_gradient_error(const SpectralModel& model, const SpectralState& state) {
  const Eigen::MatrixXd exact = full_jacobian(model, state);
  const auto value = [&](const SpectralState& s) -> Eigen::VectorXd {
    return model.columns(s.ln_tau, s.nuisance, false).values * s.coefficients;
  };
  double worst = 0.0;
  for (Eigen::Index j = 0; j < exact.cols(); ++j) {
    SpectralState up = state;
    SpectralState down = state;
    const auto move = [&](SpectralState& s, double sign) {
      const Eigen::Index linear = s.coefficients.size();
      double step = 1e-5;
      if (j < linear) {
        step *= std::abs(s.coefficients[j]);
        s.coefficients[j] += sign * step;
      } else if (j < linear + s.n_terms()) {
        s.ln_tau[j - linear] += sign * step;
      } else {
        step *= model.nuisances()[static_cast<std::size_t>(j - linear - s.n_terms())].scale;
        s.nuisance[j - linear - s.n_terms()] += sign * step;
      }
      return step;
    };
    const double step = move(up, 1.0);
    move(down, -1.0);
    const Eigen::VectorXd numeric = (value(up) - value(down)) / (2.0 * step);
    const double size = exact.col(j).cwiseAbs().maxCoeff();
    REQUIRE(size > 0.0);
    worst = std::max(worst, (numeric - exact.col(j)).cwiseAbs().maxCoeff() / size);
  }
  return worst;
}

SpectralState state_of(const SpectralModel& model, std::vector<double> tau_s) {
  SpectralState state;
  state.ln_tau.resize(static_cast<Eigen::Index>(tau_s.size()));
  for (std::size_t i = 0; i < tau_s.size(); ++i) {
    state.ln_tau[static_cast<Eigen::Index>(i)] = std::log(tau_s[i]);
  }
  state.nuisance = model.nuisance_start();
  // Every column gets the same weight, so that none hides the differences of another.
  state.coefficients = Eigen::VectorXd::Ones(model.n_common() + state.n_terms());
  const Eigen::MatrixXd values = model.columns(state.ln_tau, state.nuisance, false).values;
  state.coefficients = values.colwise().norm().cwiseInverse().transpose();
  return state;
}

}  // namespace

// Central differences with a step of 1e-5 are accurate to about 1e-10 of the function and 1e-8 of
// the slope.
constexpr double kDifferences = 1e-7;

TEST_CASE("slopes of the step models equal finite differences", "[fit][gradient]") {
  const bool full = GENERATE(true, false);
  const auto shape = GENERATE(StepShape::kRelaxation, StepShape::kCreep);
  const RelaxationData data = relaxation_of(s2(), 5000, 1000.0, 0.01, 3);
  FitOptions options;
  options.full_data = full;
  const StepModel model(data.time_s, data.value, shape, options);
  CHECK(worst_gradient_error(model, state_of(model, {0.8, 40.0, 900.0})) < kDifferences);
}

TEST_CASE("slopes of the measured history equal finite differences", "[fit][gradient]") {
  const IndentationData data =
      indentation_of(s2(), even_times(60.0, 0.01), ramp_and_hold(1.0), 1e-3, 4);
  HistoryInput input;
  input.time_s = data.time_s;
  input.input = data.depth_m;
  input.output = data.force_N;
  input.contact_input = 3.3e-6;  // between two samples
  input.contact_half_width = 1e-5;
  input.with_offset = true;
  input.with_drift = true;
  const bool is_touched = GENERATE(false, true);
  if (is_touched) {
    input.touch = {{-2.0, 0.0}, {-1.8, 2e-5}, {-1.0, 2e-5}, {-0.9, 1e-6}, {1.0, 5e-7}};
  }
  const HistoryModel model(input, {});
  CHECK(worst_gradient_error(model, state_of(model, {0.05, 0.8, 40.0})) < kDifferences);
}

TEST_CASE("slopes of storage and loss equal finite differences", "[fit][gradient]") {
  DmaData data;
  for (double f = 1e-4; f < 1e4; f *= 3.0) {
    const ComplexModulus modulus = complex_modulus_Pa(s6(), 6.28 * f);
    data.frequency_Hz.push_back(f);
    data.storage_Pa.push_back(modulus.storage_Pa);
    data.loss_Pa.push_back(modulus.loss_Pa);
  }
  const DmaModel model(data.frequency_Hz, data.storage_Pa, data.loss_Pa, {});
  CHECK(worst_gradient_error(model, state_of(model, {1e-3, 0.5, 100.0})) < kDifferences);
}

TEST_CASE("slopes of the stage model equal finite differences in times, starts and contact",
          "[fit][gradient]") {
  const CapturedRun run = in_memory_run(demo_truth(10, 1), {});
  const IndentationData data = indentation_from_capture(run);
  const bool is_touched = GENERATE(false, true);
  Course touch;
  if (is_touched) touch = {{8.0, 0.0}, {8.2, 3e-5}, {9.0, 3e-5}, {9.1, 4e-6}, {12.0, 1e-6}};
  const StageModel model(data, nuisance_start(data), {.resting_N = 5e-4, .moving_N = 7e-4}, {},
                         touch);
  // The model is not differentiable at a sample within one step of a kink; there are none here.
  CHECK(worst_gradient_error(model, state_of(model, {0.02, 0.2, 2.4, 80.0})) < 1e-5);
}

TEST_CASE("creep as a function of the relaxation spectrum", "[fit][gradient]") {
  // Closed form of one term (Tschoegl 1989, ch. 3): J(t) = 1/E_inf - E_1/(E_inf E_0) exp(-t/lambda),
  // lambda = tau E_0/E_inf.
  const auto compliance = [](double E_inf, double E_1, double ln_tau, double t_s) {
    const double E0 = E_inf + E_1, lambda_s = std::exp(ln_tau) * E0 / E_inf;
    return 1.0 / E_inf - E_1 / (E_inf * E0) * std::exp(-t_s / lambda_s);
  };
  const double E_inf = 1.3, E_1 = 2.1, ln_tau = std::log(0.7);
  const bool is_long = GENERATE(false, true);
  std::vector<double> time_s, value;
  for (int i = 0; i < (is_long ? 30000 : 40); ++i) {
    time_s.push_back(is_long ? 1e-3 * (i + 1) : 1e-2 * std::pow(10.0, i / 10.0));
    value.push_back(0.0);
  }
  const CreepRows model(time_s, value, {E_inf, {{E_1, std::exp(ln_tau)}}}, {});
  REQUIRE(model.n_rows() == model.step().n_rows());
  REQUIRE(model.n_rows() < 400);
  SpectralState state;
  state.ln_tau = Eigen::VectorXd::Constant(1, ln_tau);
  state.nuisance.resize(0);
  state.coefficients = Eigen::Vector2d(E_inf, E_1);
  const Eigen::VectorXd fitted = model.fitted(state);
  const Eigen::MatrixXd slopes = full_jacobian(model, state);
  const double h = 1e-5;
  for (Eigen::Index row = 0; row < model.n_rows(); ++row) {
    const LogBin& bin = model.step().bins()[static_cast<std::size_t>(row)];
    const auto mean = [&](double a, double b, double c) {
      double sum = 0.0;
      for (std::size_t i = bin.begin; i < bin.end; ++i) sum += compliance(a, b, c, time_s[i]);
      return sum / std::sqrt(bin.count);
    };
    // At its own reference the linear model gives -J, so that the residual is J_measured - J.
    const double exact = mean(E_inf, E_1, ln_tau);
    CHECK(fitted[row] == Approx(-exact).epsilon(1e-10));
    CHECK(model.data()[row] == Approx(-2.0 * exact).epsilon(1e-9));
    const double size = exact;
    CHECK(std::abs(slopes(row, 0) - (mean(E_inf + h, E_1, ln_tau) - mean(E_inf - h, E_1, ln_tau)) /
                                        (2 * h)) < kDifferences * size);
    CHECK(std::abs(slopes(row, 1) - (mean(E_inf, E_1 + h, ln_tau) - mean(E_inf, E_1 - h, ln_tau)) /
                                        (2 * h)) < kDifferences * size);
    CHECK(std::abs(slopes(row, 2) - (mean(E_inf, E_1, ln_tau + h) - mean(E_inf, E_1, ln_tau - h)) /
                                        (2 * h)) < kDifferences * size);
  }
}

TEST_CASE("slopes of several tests together equal finite differences", "[fit][gradient]") {
  const RelaxationData relaxation = relaxation_of(s2(), 40, 100.0, 0.01, 5);
  const std::vector<double> frequency_Hz{0.01, 0.1, 1.0, 10.0}, storage{1.6, 1.7, 1.8, 1.8},
      loss{0.02, 0.05, 0.02, 0.01};
  FitOptions with_drift;
  with_drift.drift = TableDrift::kFitted;
  std::vector<JointMember> members(3);
  members[0].model = std::make_unique<StepModel>(relaxation.time_s, relaxation.value,
                                                 StepShape::kRelaxation, with_drift);
  members[0].has_scale = true;
  members[0].scale_start = 2.0;
  auto creep = std::make_unique<CreepRows>(relaxation.time_s, relaxation.value, s2(), FitOptions{});
  members[1].creep = creep.get();
  members[1].model = std::move(creep);
  members[1].weight = 3.0;
  members[2].model = std::make_unique<DmaModel>(frequency_Hz, storage, loss, FitOptions{}, true);
  const JointModel model(std::move(members), /*is_liquid=*/false);
  REQUIRE(model.n_common() == 3);  // E_inf, drift, dashpot
  CHECK(worst_gradient_error(model, state_of(model, {0.5, 8.0})) < kDifferences);
}
