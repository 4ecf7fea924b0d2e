#pragma once

#include "models/array/space/layered_film.h"
#include "models/array/space/potential_table.h"

#include <vector>

namespace viscard {

// The charge of an equipotential disc on the face of the film that is read, alone (eq. S5).
class DiscCharge {
 public:
  // `modes` of the charge over the radius (6 give the capacitance to 1e-6). The film's potential per
  // charge is averaged over the directions.
  DiscCharge(const LayeredFilm& film, double radius_m, int modes, int film_degree);

  double capacitance_F() const { return capacitance_F_; }
  // Transform of the charge over its sum: how the open electrode weighs the potential under it.
  AxialReading reading() const;

 private:
  double radius_m_;
  std::vector<double> amplitude_;
  double capacitance_F_ = 0.0;
};

// Spherical Bessel functions j_0, j_2, ... j_(2 count - 2) at x >= 0.
std::vector<double> even_spherical_bessel(int count, double x);

}  // namespace viscard
