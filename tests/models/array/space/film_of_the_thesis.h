#pragma once

#include "models/array/film/layered_film.h"

namespace viscard::test {

// PVDF of the thesis (the constants of MATLAB's "Deflection of a Piezoelectric Actuator"): isotropic
// E 2 GPa, nu 0.29, d in C/N, relative permittivity 12.
inline Medium pvdf_of_the_thesis(double d31 = 22e-12, double d32 = 3e-12, double d33 = -30e-12) {
  PiezoMatrix d = PiezoMatrix::Zero();
  d(2, 0) = d31;
  d(2, 1) = d32;
  d(2, 2) = d33;
  return piezo_medium(isotropic_moduli_Pa(2e9, 0.29), d,
                      12.0 * kVacuumPermittivity_F_m * Eigen::Matrix3d::Identity(), 1780.0);
}

inline LayeredFilm film_of_the_thesis(double d31 = 22e-12, double d32 = 3e-12) {
  LayeredFilm film;
  film.layers = {{pvdf_of_the_thesis(d31, d32), 25e-6}};
  return film;
}

}  // namespace viscard::test
