#pragma once

#include "models/array/plane/array_statics.h"
#include "models/material/material.h"
#include "models/pillar/time/load_history.h"

#include <complex>
#include <vector>

namespace viscard {

// How the tops and the film of a row answer a load that varies in time, by its modes (eq. A5):
//   y(s) = [C_p/e + C_f] a - s^2 sum_j (c_p/e + c_f)_j (b_p/e + b_f)_j/(1 + s^2 (d_j/e + f_j)),
// C the static compliance, 1/omega_j^2 = d_j + f_j the shares of pillars (p, d) and film (f) in the
// modal compliance, e(s) the pillars' relative modulus. The static term carries what modes are left
// out, so that they lack their inertia only. Shares of modal energy: Johnson & Kienholz, AIAA J. 20
// (1982) 1284; static correction: Craig & Bampton, AIAA J. 6 (1968) 1313.
class ArrayTransfer {
 public:
  // The model must have inertia ports. `load` acts with 1 Pa on the given pillars (0-based).
  ArrayTransfer(const ArrayModel& model, ArrayLoad load, const std::vector<int>& loaded,
                const Material& pillar);

  int outputs() const { return static_cast<int>(static_pillar_.size()); }  // tops, then voltages
  int voltages() const { return voltages_; }
  // All outputs at s; with `slope`, |y| + |s dy/ds| of the modes too.
  Eigen::VectorXcd at(std::complex<double> s, Eigen::VectorXd* slope = nullptr) const;
  // What answers at once, before anything has moved or relaxed: at(s) for s to infinity.
  Eigen::VectorXd at_once() const;
  double film_share() const;                               // of the largest static deflection
  double highest_rad_s() const { return highest_rad_s_; }  // of the modes taken along

 private:
  std::complex<double> relative(std::complex<double> s) const;

  Material pillar_;
  int voltages_ = 0;
  Eigen::VectorXd static_pillar_, static_film_;  // per output
  Eigen::MatrixXd out_pillar_, out_film_;        // outputs x modes
  Eigen::VectorXd in_pillar_, in_film_;          // per mode
  Eigen::VectorXd compliance_pillar_, compliance_film_;
  double highest_rad_s_ = 0.0;
};

// Response of every output to the load times history(t) at equally spaced times, by the numerical
// Laplace transform: the FFT along a line to the right of all poles. `oversampling` times as many
// samples are computed as told. Wilcox, Int. J. Elect. Eng. Educ. 15 (1978) 247.
Eigen::MatrixXd response_in_time(const ArrayTransfer& transfer,
                                 const std::vector<HistoryPoint>& history, double end_time_s,
                                 int outputs, int oversampling);

}  // namespace viscard
