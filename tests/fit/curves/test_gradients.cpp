#include "fit/curves/dma_model.h"
#include "fit/curves/history_model.h"
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
  const StageModel model(data, nuisance_start(data), {.resting_N = 5e-4, .moving_N = 7e-4}, {});
  // The model is not differentiable at a sample within one step of a kink; there are none here.
  CHECK(worst_gradient_error(model, state_of(model, {0.02, 0.2, 2.4, 80.0})) < 1e-5);
}
