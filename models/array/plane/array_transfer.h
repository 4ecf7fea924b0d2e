#pragma once

#include "models/array/plane/array_statics.h"
#include "models/material/material.h"
#include "models/pillar/time/load_history.h"
#include "models/pillar/time/readout.h"

#include <complex>
#include <vector>

namespace viscard {

// How many of the shapes with inertia ports (array_pieces.h) are in use: the first ones.
struct ShapesInUse {
  int of_loaded = 1 << 20;  // pillars
  int of_others = 1 << 20;
};

// Response of the tops and of the film's voltages to a load that varies in time, by the modes of
// the row (eq. A5). The static term includes the modes that are left out, so only their inertia is
// missing. Shares of modal energy: Johnson & Kienholz, AIAA J. 20 (1982) 1284; static correction:
// Craig & Bampton, AIAA J. 6 (1968) 1313.
class ArrayTransfer {
 public:
  // The model must have inertia ports. `load` acts with 1 Pa on the given pillars (0-based).
  ArrayTransfer(const ArrayModel& model, ArrayLoad load, const std::vector<int>& loaded,
                const Material& pillar, const ShapesInUse& in_use = {});

  // Lets the film lose: the voltages of open electrodes and of a charge-free face all fall by one factor,
  // because the film is the same everywhere (eq. 37).
  void lose(const FilmPort& film) { film_ = film; }

  int outputs() const { return static_cast<int>(static_pillar_.size()); }  // tops, then voltages
  int voltages() const { return voltages_; }
  // All outputs at s; with `slope`, |y| + |s dy/ds| of the modes too.
  Eigen::VectorXcd at(std::complex<double> s, Eigen::VectorXd* slope = nullptr) const;
  // The response before anything has moved or relaxed: at(s) for s to infinity.
  Eigen::VectorXd at_once() const;
  double film_share() const;                               // of the largest static deflection
  double highest_rad_s() const { return highest_rad_s_; }  // of the modes in use

 private:
  std::complex<double> relative(std::complex<double> s) const;

  Material pillar_;
  int voltages_ = 0;
  Eigen::VectorXd static_pillar_, static_film_;  // per output
  Eigen::MatrixXd out_pillar_, out_film_;        // outputs x modes
  Eigen::VectorXd in_pillar_, in_film_;          // per mode
  Eigen::VectorXd compliance_pillar_, compliance_film_;
  double highest_rad_s_ = 0.0;
  FilmPort film_{1.0, 1.0};
};

// Response of every output to the load times history(t) at outputs + 1 equally spaced times, by the
// numerical Laplace transform: the FFT along a line to the right of all poles, with `oversampling`
// times as many samples. Wilcox, Int. J. Elect. Eng. Educ. 15 (1978) 247.
Eigen::MatrixXd response_in_time(const ArrayTransfer& transfer, const Course& history,
                                 double end_time_s, int outputs, int oversampling);

}  // namespace viscard
