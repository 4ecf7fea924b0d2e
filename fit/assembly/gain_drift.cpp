#include "fit/assembly/spectral_fit.h"
#include "models/material/systematic_parts.h"

#include <cmath>

namespace viscard {

double gain_drift_relative_u(const SpectralModel& model, const SpectralFit& fit,
                             const IndentationData& data) {
  const double before_s = data.contact_from_s - data.first_reading_s;
  double stiffness_N_m = fit.state.coefficients.tail(fit.state.n_terms()).sum();
  double rate_square = -1.0;  // of rate times stiffness, plus its variance; -1: no creep
  for (Eigen::Index j = 0; j < model.n_common(); ++j) {
    const std::string& name = model.common()[static_cast<std::size_t>(j)].name;
    if (name == "E_inf") stiffness_N_m += fit.state.coefficients[j];
    if (name != "creep_N_m_s") continue;
    const double variance = fit.covariance(j, j);
    rate_square = std::pow(fit.state.coefficients[j], 2) + (std::isfinite(variance) ? variance : 0);
  }
  if (!(rate_square > 0.0 && stiffness_N_m > 0.0 && before_s > 0.0)) return 0.0;
  return std::sqrt(rate_square) / stiffness_N_m * before_s;
}

void add_gain_drift(const SystematicPart& part, FitResult& result) {
  const SeriesDirection direction = direction_of(fitted_series(result), part);
  const double of_E_inf = result.E_inf_Pa > 0.0 ? direction.equilibrium_Pa / result.E_inf_Pa : 0.0;
  result.gain_drift_relative = part.E0;
  const auto widen = [](Interval& interval, double value, double relative_u) {
    if (relative_u != 0.0) interval = combined_95(interval, value, std::abs(relative_u));
  };
  widen(result.E0_interval_95, result.E0_Pa, part.E0);
  widen(result.E_inf_interval_95, result.E_inf_Pa, of_E_inf);
  result.E0_se_Pa = std::hypot(result.E0_se_Pa, part.E0 * result.E0_Pa);
  result.E_inf_se_Pa = std::hypot(result.E_inf_se_Pa, direction.equilibrium_Pa);
  const std::size_t n_terms = result.terms.size();
  Eigen::VectorXd change = Eigen::VectorXd::Zero(result.covariance.rows());
  const auto set = [&](std::size_t row, double value) {
    if (static_cast<Eigen::Index>(row) < change.size())
      change[static_cast<Eigen::Index>(row)] = value;
  };
  set(0, direction.equilibrium_Pa);
  for (std::size_t i = 0; i < n_terms; ++i) {
    FittedTerm& term = result.terms[i];
    widen(term.modulus_Pa_95, term.modulus_Pa, direction.modulus_Pa[i] / term.modulus_Pa);
    widen(term.g_95, term.g, i < part.g.size() ? part.g[i] : 0.0);
    widen(term.tau_s_95, term.tau_s, direction.ln_tau[i]);
    term.modulus_se_Pa = std::hypot(term.modulus_se_Pa, direction.modulus_Pa[i]);
    term.ln_tau_se = std::hypot(term.ln_tau_se, direction.ln_tau[i]);
    set(1 + i, direction.modulus_Pa[i]);
    set(1 + n_terms + i, direction.ln_tau[i]);
  }
  result.covariance += change * change.transpose();
}

}  // namespace viscard
