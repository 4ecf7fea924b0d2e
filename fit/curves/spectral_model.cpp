#include "fit/curves/spectral_model.h"

#include <algorithm>
#include <numeric>

namespace viscard {

SpectralState sorted_by_time(SpectralState state, Eigen::Index n_common) {
  std::vector<Eigen::Index> order(static_cast<std::size_t>(state.n_terms()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::sort(order.begin(), order.end(),
            [&](Eigen::Index a, Eigen::Index b) { return state.ln_tau[a] < state.ln_tau[b]; });
  auto moduli = state.coefficients.segment(n_common, state.n_terms());
  moduli = Eigen::VectorXd(moduli(order));
  state.ln_tau = Eigen::VectorXd(state.ln_tau(order));
  return state;
}

Eigen::VectorXd SpectralModel::of_nuisances(double Nuisance::*member) const {
  Eigen::VectorXd values(n_nuisances());
  std::transform(nuisances_.begin(), nuisances_.end(), values.begin(),
                 [&](const Nuisance& nuisance) { return nuisance.*member; });
  return values;
}

Eigen::VectorXd SpectralModel::prior_weight() const {
  return of_nuisances(&Nuisance::prior_sd).unaryExpr([](double sd) {
    return sd > 0.0 ? 1.0 / sd : 0.0;
  });
}

Eigen::VectorXd SpectralModel::prior_residual(const Eigen::VectorXd& nuisance) const {
  return (nuisance - of_nuisances(&Nuisance::prior)).cwiseProduct(prior_weight());
}

std::vector<std::size_t> SpectralModel::row_begins() const {
  std::vector<std::size_t> begins(static_cast<std::size_t>(n_rows()) + 1);
  std::iota(begins.begin(), begins.end(), std::size_t{0});
  return begins;
}

Eigen::VectorXd SpectralModel::residual_series(const SpectralState& state) const {
  return data_ -
         columns(state.ln_tau, state.nuisance, /*with_slopes=*/false).values * state.coefficients;
}

std::vector<bool> free_columns(const SpectralModel& model, Eigen::Index n_terms) {
  std::vector<bool> is_free;
  for (const CommonColumn& column : model.common()) {
    is_free.push_back(column.is_free || model.may_be_negative());
  }
  is_free.resize(is_free.size() + static_cast<std::size_t>(n_terms), model.may_be_negative());
  return is_free;
}

}  // namespace viscard
