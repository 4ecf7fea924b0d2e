#pragma once

#include "models/material/material.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace viscard {

// A direction in which the parameters of E(t) scatter with standard deviation 1: changes of E_inf, of
// the E_i and of the ln tau_i.
struct SeriesDirection {
  double equilibrium_Pa = 0.0;
  std::vector<double> modulus_Pa, ln_tau;
};

// Independent directions of a covariance, along the eigenvectors of its correlation matrix. Names are
// those of MaterialUncertainty; other parameters are ignored.
std::vector<SeriesDirection> directions_of(const std::vector<std::string>& names,
                                           const Eigen::MatrixXd& covariance, std::size_t n_terms);

// All moduli scaled together by this relative amount.
SeriesDirection common_scale(const PronySeries& series, double relative);

// The series `step` standard deviations along a direction. Moduli that would become negative stay at
// zero.
PronySeries moved(const PronySeries& series, const SeriesDirection& direction, double step);

}  // namespace viscard
