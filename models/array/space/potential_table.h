#pragma once

#include "models/array/space/potential_spectrum.h"

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace viscard {

// Potential on the face that is read, V, per value of TopLoad, each 1 Pa.
using PotentialByLoad = Eigen::Matrix<double, kTopLoads, 1>;

// An axisymmetric weighting of the potential around a point, as the Hankel transform of its
// weights: 1 at k = 0. For the potential itself the transform is 1 everywhere.
using AxialReading = std::function<double(double k_1_m)>;
AxialReading point_reading();
AxialReading disc_mean(double radius_m);  // 2 J_1(k a)/(k a)

// The potential of a spectrum over the radius, as tables for each harmonic of the angle. The axes x and
// y are those of the film.
class PotentialTable {
 public:
  // `induced` (potential_spectrum.h) contributes to the readings of all pillars except the loaded
  // one; it is empty without an electrode. The table covers the distances from `from_m` to
  // `reach_m`.
  PotentialTable(const PotentialSpectrum& spectrum, const std::vector<Eigen::MatrixXd>& induced,
                 double reach_m, const std::vector<AxialReading>& readings = {point_reading()},
                 double from_m = 0.0);

  // One of the readings at a point (x, y) from the pillar's axis. Zero beyond the reach.
  PotentialByLoad at(double x_m, double y_m, std::size_t reading = 0) const;
  double reach_m() const { return reach_m_; }

 private:
  void add_wave(const Eigen::MatrixXd& amplitude, double k_1_m, const std::vector<double>& factors);

  double from_m_ = 0.0, reach_m_ = 0.0;
  double panel_m_ = 0.0;
  Eigen::Index harmonics_ = 0;
  // By reading: Chebyshev points of each panel, one below the other; a column per load (slowest) and
  // harmonic.
  std::vector<Eigen::MatrixXd> values_;
  std::vector<double>
      own_V_;  // by reading: the difference on the axis of the pillar under pressure
};

}  // namespace viscard
