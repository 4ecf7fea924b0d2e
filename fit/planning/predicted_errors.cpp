#include "fit/planning/predicted_errors.h"

#include "fit/assembly/bench_doubt.h"
#include "fit/assembly/stage_specimen.h"
#include "fit/curves/stage_model.h"
#include "models/contact/punch_contact.h"
#include "models/material/systematic_parts.h"

#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

using Index = Eigen::Index;

PronySeries scaled(PronySeries series, double factor) {
  series.equilibrium_modulus_Pa *= factor;
  for (MaxwellTerm& term : series.terms) term.modulus_Pa *= factor;
  return series;
}

// Noise of a reading, plus the error from the steps of the stage while it moves.
StageNoise noise_of(const RigPerformance& performance, double stiffness_N_m) {
  if (!(performance.noise_N > 0.0)) {
    throw std::invalid_argument(
        "the noise of the rig is not known. Give noise = \"0.5 mN\" (the standard deviation of one "
        "reading at rest) under [performance] of the rig file; viscard rig check and viscard "
        "capture report it");
  }
  StageNoise noise;
  noise.resting_N = performance.noise_N;
  noise.moving_N =
      std::hypot(noise.resting_N, performance.step_m * stiffness_N_m / std::sqrt(12.0));
  return noise;
}

Eigen::VectorXd nuisances_of(const IndentationData& data) {
  return Eigen::VectorXd::Zero(static_cast<Index>(data.moves.size()) + 2);  // contact lies at zero
}

SpectralState state_of(const StageModel& model, const PronySeries& stage, double gain_drift_1_s) {
  SpectralState state;
  const auto n_terms = static_cast<Index>(stage.terms.size());
  state.nuisance = model.nuisance_start();
  state.ln_tau.resize(n_terms);
  state.coefficients = Eigen::VectorXd::Zero(model.n_common() + n_terms);
  for (Index j = 0; j < model.n_common(); ++j) {
    const std::string& name = model.common()[static_cast<std::size_t>(j)].name;
    if (name == "E_inf") state.coefficients[j] = stage.equilibrium_modulus_Pa;
    // A gain that drifts shows as creep of the force.
    if (name == "creep_N_m_s") {
      state.coefficients[j] = gain_drift_1_s * instantaneous_modulus_Pa(stage);
    }
  }
  for (Index i = 0; i < n_terms; ++i) {
    const MaxwellTerm& term = stage.terms[static_cast<std::size_t>(i)];
    state.coefficients[model.n_common() + i] = term.modulus_Pa;
    state.ln_tau[i] = std::log(term.relaxation_time_s);
  }
  return state;
}

// The number behind "g_" of "g_12"; 0: none.
std::size_t term_number(const std::string& name, const std::string& kind) {
  if (name.rfind(kind, 0) != 0 || name.size() == kind.size()) return 0;
  std::size_t number = 0;
  for (const char c : name.substr(kind.size())) {
    if (c < '0' || c > '9' || number > 1000) return 0;
    number = 10 * number + static_cast<std::size_t>(c - '0');
  }
  return number;
}

// E_inf, E_i, ln tau_i, as the rows of FitResult::covariance.
PronySeries with_parameter(PronySeries series, Index parameter, double relative) {
  const auto n = static_cast<Index>(series.terms.size());
  if (parameter == 0) {
    series.equilibrium_modulus_Pa *= 1.0 + relative;
  } else if (parameter <= n) {
    series.terms[static_cast<std::size_t>(parameter - 1)].modulus_Pa *= 1.0 + relative;
  } else {
    series.terms[static_cast<std::size_t>(parameter - 1 - n)].relaxation_time_s *=
        std::exp(relative);
  }
  return series;
}

double scale_of(const PronySeries& series, Index parameter) {
  const auto n = static_cast<Index>(series.terms.size());
  if (parameter == 0) return series.equilibrium_modulus_Pa;
  return parameter <= n ? series.terms[static_cast<std::size_t>(parameter - 1)].modulus_Pa : 1.0;
}

// Standard error of ln(quantity) from a covariance of the series' parameters.
double relative_error(const WantedQuantity& wanted, const PronySeries& series,
                      const Eigen::MatrixXd& covariance) {
  constexpr double kStep = 1e-5;
  const double value = value_of(wanted, series);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(covariance.rows());
  for (Index j = 0; j < gradient.size(); ++j) {
    const double scale = scale_of(series, j);
    if (!(scale > 0.0)) continue;
    gradient[j] = (value_of(wanted, with_parameter(series, j, kStep)) -
                   value_of(wanted, with_parameter(series, j, -kStep))) /
                  (2.0 * kStep * scale * value);
  }
  return std::sqrt(std::max(0.0, gradient.dot(covariance * gradient)));
}

}  // namespace

double value_of(const WantedQuantity& wanted, const PronySeries& series) {
  if (wanted.value) return wanted.value(series);
  const double E0_Pa = instantaneous_modulus_Pa(series);
  if (wanted.name == "E0") return E0_Pa;
  if (wanted.name == "E_inf") return series.equilibrium_modulus_Pa;
  if (wanted.name == "sum_g") return 1.0 - series.equilibrium_modulus_Pa / E0_Pa;
  for (const char* kind : {"g_", "E_", "tau_"}) {
    const std::size_t number = term_number(wanted.name, kind);
    if (number == 0) continue;
    if (number > series.terms.size()) {
      throw std::invalid_argument("'" + wanted.name +
                                  "' is wanted, but the guess of the material has " +
                                  std::to_string(series.terms.size()) + " terms");
    }
    const MaxwellTerm& term = series.terms[number - 1];
    if (kind[0] == 't') return term.relaxation_time_s;
    return kind[0] == 'g' ? term.modulus_Pa / E0_Pa : term.modulus_Pa;
  }
  throw std::invalid_argument(
      "'" + wanted.name +
      "' cannot be wanted; known are E0, E_inf, sum_g, and E_i, g_i, tau_i of "
      "term i");
}

double ErrorCauses::total() const {
  return std::hypot(std::hypot(noise, gain_drift, frame), calibration, geometry);
}

ErrorCauses ErrorCauses::of_touches(int n) const {
  ErrorCauses mean = *this;
  mean.noise /= std::sqrt(static_cast<double>(n));
  return mean;
}

PredictedFit predicted_fit(const TestPlan& plan, const Bench& bench, const Material& guess) {
  if (!(guess.E0_Pa > 0.0)) {
    throw std::invalid_argument("the guess of the material has no modulus");
  }
  const PlannedRun run = planned_run(plan, bench);
  const double factor_m = force_per_modulus_and_depth_m(bench.specimen.contact);
  const PronySeries stage =
      stage_series(scaled(young_series(guess), factor_m), run.data.frame_stiffness_N_m);
  const StageModel model(run.data, nuisances_of(run.data),
                         noise_of(bench.performance, instantaneous_modulus_Pa(stage)), {});
  SpectralFit fit;
  fit.state = state_of(model, stage, bench.performance.gain_drift_1_s);
  fit.covariance = parameter_covariance(model, fit.state, 1.0);

  PredictedFit predicted;
  predicted.total_s = run.total_s;
  predicted.peak_force_N = run.peak_force_N;
  const SeriesFromState series_from_state = specimen_series_of(model, run.data, false);
  fill_parameters(model, fit.state, fit.covariance, series_from_state, predicted.result);
  predicted.series = series_from_state(fit.state);
  predicted.covariance = predicted.result.covariance;
  predicted.gain_drift = gain_drift_part(model, fit, run.data, predicted.result);
  add_gain_drift(predicted.gain_drift, predicted.result);
  predicted.systematic_parts = systematic_parts_on(bench, run.peak_force_N, predicted.series);
  return predicted;
}

std::vector<SystematicPart> systematic_parts_on(const Bench& bench, double largest_force_N,
                                                const PronySeries& series) {
  return systematic_parts_from(
      scaled(series, force_per_modulus_and_depth_m(bench.specimen.contact)),
      {.frame_stiffness_N_m = bench.rig.frame.stiffness_N_m,
       .frame_relative_u = bench.rig.frame.stiffness_relative_u,
       .force_relative_u = gain_relative_u(bench.rig.calibration, largest_force_N),
       .depth_relative_u = bench.rig.stage.depth_relative_u,
       .geometry_relative_u = relative_uncertainty(bench.specimen.contact)});
}

ErrorCauses errors_of(const WantedQuantity& wanted, const PredictedFit& fit) {
  const double value = value_of(wanted, fit.series);
  const auto change = [&](const PronySeries& other) {
    return std::abs(value_of(wanted, other) / value - 1.0);
  };
  ErrorCauses causes;
  causes.noise = relative_error(wanted, fit.series, fit.covariance);
  constexpr double kSmallShare =
      1e-3;  // of a standard deviation, so that effects are to first order
  const auto effect = [&](const SystematicPart& part) {
    return change(moved(fit.series, direction_of(fit.series, part), kSmallShare)) / kSmallShare;
  };
  causes.gain_drift = effect(fit.gain_drift);
  for (const SystematicPart& part : fit.systematic_parts) {
    double& cause = part.cause == kFrameCause || part.cause == kStageCause ? causes.frame
                    : part.cause == kLoadCellCause                         ? causes.calibration
                                                                           : causes.geometry;
    cause = std::hypot(cause, effect(part));
  }
  return causes;
}

}  // namespace viscard
