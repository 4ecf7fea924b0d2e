#pragma once

#include "models/pillar/body/piezo_static.h"

namespace viscard {

// Results of a pillar on a film with an electrode or a charge-free face under 1 Pa.
struct FilmAnswer {
  PiezoAnswer piezo;      // with an electrode
  double centre_V = 0.0;  // charge-free face: potential at its centre
  double mean_V = 0.0;    //   and its mean under the pillar
  double area_m2 = 0.0;   // of the top
  // What weight and heat do without a load, in the same members.
  PiezoAnswer unloaded;
  double unloaded_centre_V = 0.0, unloaded_mean_V = 0.0;
  int unknowns = 0;
};

// A pillar under an axial load on a film whose constants depend on the direction in its plane, such
// as stretched PVDF with d31 != d32. Along the angle t they are c0 + c2 cos 2t + c4 cos 4t, so that
// an axisymmetric load excites the harmonics 0, 2, 4, ... of displacement and potential,
// which the film couples. Harmonic 0 alone is the film averaged about z.
//
// All harmonics stand side by side as fields of one system (eq. 25d): the block of the form between
// harmonics m and n is int_0^2pi T_m(t) D(t) T_n(t) dt, D(t) the constants in axes turned by t, T_m
// the cosines and sines of Kinematics.
//
// Under 1 Pa, with the harmonics 0, 2, ... up to `highest_harmonic`. The motion in the options must
// be longitudinal, and they must name electrodes. Throws std::invalid_argument otherwise.
FilmAnswer directional_static(const PillarGeometry& geometry, const Discretisation& mesh,
                              const PillarMedia& media, const ModelOptions& options,
                              int highest_harmonic);

}  // namespace viscard
