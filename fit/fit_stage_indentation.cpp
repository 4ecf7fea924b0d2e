#include "fit/fit_stage_indentation.h"

#include <cmath>
#include <stdexcept>

#include "fit/assemble_result.h"
#include "fit/stage_model.h"
#include "models/retardation_spectrum.h"

namespace viscard {
namespace {

using Index = Eigen::Index;

// Standard deviations of the residual while the stage rests and while it moves (its steps shake it).
struct TwoSigmas {
  double resting_N = 1.0;
  double moving_N = 1.0;
};

TwoSigmas scatter(const StageModel& model, const Eigen::VectorXd& weighted_residual) {
  double sums[2] = {0.0, 0.0};
  double counts[2] = {0.0, 0.0};
  for (Index i = 0; i < weighted_residual.size(); ++i) {
    const std::size_t kind = model.is_moving()[static_cast<std::size_t>(i)] ? 1 : 0;
    sums[kind] += std::pow(weighted_residual[i] * model.sigma_N()[i], 2);
    counts[kind] += 1.0;
  }
  const double resting_N = std::sqrt(sums[0] / std::max(1.0, counts[0]));
  // Too few samples in motion say nothing of their own.
  const double moving_N = counts[1] > 10.0 ? std::sqrt(sums[1] / counts[1]) : resting_N;
  return {resting_N, std::max(moving_N, resting_N)};
}

}  // namespace

PronySeries specimen_series(const PronySeries& stage_series_N_m, double frame_stiffness_N_m) {
  if (!(frame_stiffness_N_m > 0.0)) return stage_series_N_m;
  RetardationSpectrum compliance = retardation_from_relaxation(stage_series_N_m);
  compliance.instantaneous_compliance_1_Pa -= 1.0 / frame_stiffness_N_m;
  if (!(compliance.instantaneous_compliance_1_Pa > 0.0)) {
    throw std::runtime_error(
        "the frame stiffness of " + std::to_string(frame_stiffness_N_m) +
        " N/m is below the stiffness seen (" +
        std::to_string(instantaneous_modulus_Pa(stage_series_N_m)) +
        " N/m): nothing is left for the specimen. Measure it again: viscard calibrate --compliance");
  }
  return relaxation_from_retardation(compliance);
}

FitResult fit_stage_indentation(const IndentationData& data, const FitOptions& options) {
  const double factor_m = data.contact ? force_per_modulus_and_depth_m(*data.contact) : 1.0;
  Eigen::VectorXd start = nuisance_start(data);
  TwoSigmas sigmas;
  {
    // First pass, equal weights: what the noise is like.
    const StageModel model(data, start, 1.0, 1.0, options);
    OrderPathOptions path_options;
    path_options.max_terms = 4;
    const SpectralState state = order_path(model, path_options).back();
    start = state.nuisance;
    sigmas = scatter(model, model.data() - model.columns(state.ln_tau, state.nuisance, false).values *
                                               state.coefficients);
  }
  const StageModel model(data, start, sigmas.resting_N, sigmas.moving_N, options);
  const SpectralFit fit =
      fit_spectrum(model, log_time_blocks(data.time_s, data.contact_from_s, 4), options);

  FitResult result;
  result.kind = FitKind::kIndentation;
  result.is_stiffness = !data.contact;
  const auto series_from_state = [&](const SpectralState& state) {
    PronySeries stage{options.is_liquid ? 0.0 : state.coefficients[0], {}};
    for (Index i = 0; i < state.n_terms(); ++i) {
      stage.terms.push_back(
          {state.coefficients[model.n_common() + i], std::exp(state.ln_tau[i])});
    }
    PronySeries series = specimen_series(stage, data.frame_stiffness_N_m);
    series.equilibrium_modulus_Pa /= factor_m;
    for (MaxwellTerm& term : series.terms) term.modulus_Pa /= factor_m;
    return series;
  };
  fill_result(model, fit, series_from_state, result);
  result.noise.sigma = sigmas.resting_N;
  result.contact_position_m = fit.state.nuisance[model.n_nuisances() - 1];
  const Eigen::VectorXd residual =
      model.residual_series(fit.state.ln_tau, fit.state.nuisance, fit.state.coefficients);
  result.rss = residual.cwiseProduct(model.sigma_N()).squaredNorm();
  return result;
}

}  // namespace viscard
