#pragma once

#include "models/array/space/foot_forces.h"
#include "models/array/space/layered_film.h"

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace viscard {

// How finely the potential of eq. S4 is integrated and tabled.
struct PotentialAccuracy {
  int film_degree = 8;       // elements across the film
  double largest_kt = 10.0;  // waves up to this over the thickness of all layers: the bottom face
                             // reads a wave as exp(-k t)
  double own_kt = 0.0;       // on the load's own axis: waves up to this; 0: no more than elsewhere
  int harmonics = 2;         // L: the film's answer over the angle has the harmonics 0, 2, ... 2 L
  double reach_m = 0.0;      // farthest point from the pillar's axis that is asked for
};

// Potential on the face that is read, V, per value of TopLoad, each 1 Pa.
using PotentialByLoad = Eigen::Matrix<double, kTopLoads, 1>;

// An axisymmetric way to read the potential around a point, as the Hankel transform of its weights: 1
// at k = 0. The potential itself is read with 1.
using AxialReading = std::function<double(double k_1_m)>;
AxialReading point_reading();
AxialReading disc_mean(double radius_m);  // 2 J_1(k a)/(k a)

// The potential that one loaded pillar leaves on the face of the film that is read, around its axis
// (eq. S4): tables over the radius for each harmonic of the angle. The axes x and y are those of the
// film.
class PotentialTable {
 public:
  PotentialTable(const LayeredFilm& film, const FootForces& foot, const PotentialAccuracy& accuracy,
                 const std::vector<AxialReading>& readings = {point_reading()});

  // One of the readings at a point (x, y) from the pillar's axis. Zero beyond the reach.
  PotentialByLoad at(double x_m, double y_m, std::size_t reading = 0) const;
  double reach_m() const { return reach_m_; }
  int waves() const { return waves_; }  // wave numbers that were solved in each direction

 private:
  void add_own(const LayeredFilm& film, const FootForces& foot, const PotentialAccuracy& accuracy,
               const std::vector<AxialReading>& readings);
  void add_wave(const Eigen::MatrixXd& amplitude, double k_1_m,
                const std::vector<AxialReading>& readings);

  double reach_m_ = 0.0;
  double panel_m_ = 0.0;
  int waves_ = 0;
  Eigen::Index harmonics_ = 0;
  // By reading: Chebyshev points of each panel, one below the other; a column per load (slowest) and
  // harmonic.
  std::vector<Eigen::MatrixXd> values_;
  std::vector<double> own_V_;  // by reading: what shorter waves add under pressure on its own axis
};

}  // namespace viscard
