#pragma once

#include "models/array/film/film_table.h"
#include "models/array/space/potential_table.h"

#include <Eigen/Core>

#include <functional>
#include <utility>
#include <vector>

namespace viscard {

// Reading of a wave on the film along each direction, per unit (tau_x, tau_y, t_z).
using DirectionReading = std::function<std::vector<Eigen::Vector4d>(double k_1_m)>;
DirectionReading potential_reading(const FilmTable& film);

// The spectrum (eq. S4) of graded waves up to `largest`, with panels no longer than `longest`. With
// `fades`, the waves in the upper half of the k fade out, so that the truncation is not felt at a
// distance.
PotentialSpectrum graded_spectrum(const FilmTable& film, const DirectionReading& reading,
                                  const FootForces& foot, double largest_1_m, double longest_1_m,
                                  bool fades);

// A potential around a loaded pillar at all distances: one table for near places, and one for each
// doubling of the distance beyond, where only the longer waves matter (eq. S10).
class WideTable {
 public:
  explicit WideTable(PotentialTable near) : near_(std::move(near)) {}
  WideTable(PotentialTable near, const FilmTable& film, const DirectionReading& reading,
            const FootForces& foot, const std::vector<AxialReading>& readings = {point_reading()});

  // V per Pa of each load at this offset from the axis.
  PotentialByLoad at(double x_m, double y_m, std::size_t reading = 0) const;

 private:
  PotentialTable near_;
  std::vector<PotentialTable> far_;  // each reaches twice as far as the one before
};

}  // namespace viscard
