#include "fit/assembly/spectral_fit.h"

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

void add_common_uncertainty(double relative_u, FitResult& result) {
  if (!(relative_u > 0.0)) return;
  const auto widen = [&](Interval& interval, double value) {
    interval = combined_95(interval, value, relative_u);
  };
  widen(result.E0_interval_95, result.E0_Pa);
  widen(result.E_inf_interval_95, result.E_inf_Pa);
  result.E0_se_Pa = std::hypot(result.E0_se_Pa, relative_u * result.E0_Pa);
  result.E_inf_se_Pa = std::hypot(result.E_inf_se_Pa, relative_u * result.E_inf_Pa);
  const auto n_terms = static_cast<Eigen::Index>(result.terms.size());
  Eigen::VectorXd scale = Eigen::VectorXd::Zero(result.covariance.rows());
  if (scale.size() > 0) scale[0] = relative_u * result.E_inf_Pa;
  for (Eigen::Index i = 0; i < n_terms; ++i) {
    FittedTerm& term = result.terms[static_cast<std::size_t>(i)];
    const double part = relative_u * term.modulus_Pa;
    widen(term.modulus_Pa_95, term.modulus_Pa);
    term.modulus_se_Pa = std::hypot(term.modulus_se_Pa, part);
    if (1 + i < scale.size()) scale[1 + i] = part;
  }
  result.covariance += scale * scale.transpose();
}

}  // namespace viscard
