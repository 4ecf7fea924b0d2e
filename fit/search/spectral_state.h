#pragma once

#include "fit/curves/spectral_model.h"

#include <Eigen/Core>

#include <vector>

namespace viscard {

// A point of a SpectralModel: what all its parameters are.
struct SpectralState {
  Eigen::VectorXd ln_tau;  // ln s, ascending after refine()
  Eigen::VectorXd nuisance;
  Eigen::VectorXd coefficients;  // common columns, then the terms' moduli
  double rss = 0.0;              // weighted
  bool is_converged = true;

  Eigen::Index n_terms() const { return ln_tau.size(); }
};

// The same state with its terms in ascending order of time.
SpectralState sorted_by_time(SpectralState state, Eigen::Index n_common);

// Which columns may have either sign: free common ones, and terms if the model allows it.
std::vector<bool> free_columns(const SpectralModel& model, Eigen::Index n_terms);

}  // namespace viscard
