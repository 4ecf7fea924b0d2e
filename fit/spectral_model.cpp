#include "fit/spectral_model.h"

namespace viscard {

Eigen::VectorXd SpectralModel::nuisance_start() const {
  Eigen::VectorXd start(n_nuisances());
  for (Eigen::Index k = 0; k < n_nuisances(); ++k) {
    start[k] = nuisances_[static_cast<std::size_t>(k)].start;
  }
  return start;
}

}  // namespace viscard
