#pragma once

#include "fit/curves/spectral_model.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace viscard {

// How the shifts ln a of all segments of a master curve follow from a few parameters.
//   kFixed:     the start values, without parameters
//   kFree:      one value for each segment but the reference
//   kArrhenius: ln a = p 1000 (1/T - 1/T_ref), T in K; p = E_a/(1000 R) in K
//   kWlf:       ln a = -p_1 dT/(1 + p_2 dT), dT = T - T_ref; C1 = p_1/(p_2 ln 10), C2 = 1/p_2
//   kSmooth:    as free, in other coordinates: the mean slope over 1/T and the second differences
//               d_k, scaled so that sum d_k^2 is the integral of the squared second derivative of
//               ln a over x = (1/T)/(range of 1/T). The d_k have a normal prior, 0 +- curvature_sd.
enum class ShiftFormKind { kFixed, kFree, kArrhenius, kWlf, kSmooth };

class ShiftForm {
 public:
  ShiftForm(ShiftFormKind kind, std::vector<double> temperature_C, std::size_t reference,
            double curvature_sd = 0.0);

  Eigen::Index n_parameters() const { return n_parameters_; }
  // Of all segments; the reference has 0. Not for kFixed.
  Eigen::VectorXd ln_a(const Eigen::VectorXd& parameters) const;
  Eigen::MatrixXd slopes(const Eigen::VectorXd& parameters) const;  // segments x parameters
  // The parameters that come nearest to these shifts, by least squares.
  Eigen::VectorXd nearest(const Eigen::VectorXd& ln_a) const;
  // The parameters as nuisances of a model, starting at the nearest to these shifts.
  std::vector<Nuisance> nuisances(const Eigen::VectorXd& start_ln_a) const;

 private:
  Eigen::VectorXd wlf_column(double inverse_C2_1_K) const;
  double largest_inverse_C2_1_K() const;

  ShiftFormKind kind_;
  double curvature_sd_;
  Eigen::Index n_parameters_ = 0;
  Eigen::VectorXd warmer_K_;   // T - T_ref of each segment
  Eigen::MatrixXd map_;        // ln a = map p, for all but kWlf
  Eigen::MatrixXd from_ln_a_;  // p from ln a; for kFree and kSmooth exact
};

}  // namespace viscard
