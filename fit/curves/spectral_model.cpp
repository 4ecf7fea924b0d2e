#include "fit/curves/spectral_model.h"

#include <numeric>

namespace viscard {

Eigen::VectorXd SpectralModel::nuisance_start() const {
  Eigen::VectorXd start(n_nuisances());
  for (Eigen::Index k = 0; k < n_nuisances(); ++k) {
    start[k] = nuisances_[static_cast<std::size_t>(k)].start;
  }
  return start;
}

std::vector<std::size_t> SpectralModel::row_begins() const {
  std::vector<std::size_t> begins(static_cast<std::size_t>(n_rows()) + 1);
  std::iota(begins.begin(), begins.end(), std::size_t{0});
  return begins;
}

double SpectralModel::hidden_rss(const Eigen::VectorXd& /*ln_tau*/,
                                 const Eigen::VectorXd& /*nuisance*/,
                                 const Eigen::VectorXd& /*coefficients*/) const {
  return 0.0;
}

SpectralModel::HiddenRows SpectralModel::hidden_rows(const Eigen::VectorXd& /*ln_tau*/) const {
  return {};
}

Eigen::VectorXd SpectralModel::residual_series(const Eigen::VectorXd& ln_tau,
                                               const Eigen::VectorXd& nuisance,
                                               const Eigen::VectorXd& coefficients) const {
  return data_ - columns(ln_tau, nuisance, /*with_slopes=*/false).values * coefficients;
}

}  // namespace viscard
