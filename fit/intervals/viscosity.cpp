#include "fit/intervals/viscosity.h"

#include <algorithm>
#include <cmath>

namespace viscard {

bool is_liquid(const FitResult& fit) {
  return fit.E_inf_Pa == 0.0 && fit.E_inf_se_Pa == 0.0 && !fit.terms.empty();
}

std::optional<Viscosity> viscosity_of(const FitResult& fit) {
  const auto n_terms = static_cast<Eigen::Index>(fit.terms.size());
  if (!is_liquid(fit) || fit.is_stiffness || fit.covariance.rows() != 1 + 2 * n_terms) return {};
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(1 + 2 * n_terms);  // by E_inf, E_i, ln tau_i
  Viscosity viscosity{fit.dashpot_Pa_s.value_or(0.0), {}};
  for (Eigen::Index i = 0; i < n_terms; ++i) {
    const FittedTerm& term = fit.terms[static_cast<std::size_t>(i)];
    gradient[1 + i] = term.tau_s;
    gradient[1 + n_terms + i] = term.modulus_Pa * term.tau_s;
    viscosity.value_Pa_s += term.modulus_Pa * term.tau_s;
  }
  if (!(viscosity.value_Pa_s > 0.0)) return {};
  const double of_terms = std::sqrt(std::max(0.0, gradient.dot(fit.covariance * gradient)));
  const double ln_se = std::hypot(of_terms, fit.dashpot_se_Pa_s) / viscosity.value_Pa_s;
  viscosity.interval_95 = {viscosity.value_Pa_s * std::exp(-kNormal95 * ln_se),
                           viscosity.value_Pa_s * std::exp(kNormal95 * ln_se)};
  return viscosity;
}

}  // namespace viscard
