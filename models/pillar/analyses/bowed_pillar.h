#pragma once

#include "models/pillar/analyses/buckling_limit.h"

namespace viscard {

// The pressure at which a pillar that is not straight collapses: at which a strain at its foot reaches a limit.
//
// A bow a_0 (offset of the top of the unloaded pillar from the axis of its foot, in the shape in which it buckles)
// grows to a under the pressure p as that of an inextensible clamped elastica does, scaled to the buckling pressure
// p_cr of the pillar on its base, and bends the foot with the arm a (h = 1), or half of it under a plate (h = 1/2):
//   theta'' = theta_0'' - (pi/2)^2 p/p_cr sin theta,  strain = p/E (1 + 4 h a/R)   (eq. 21d)
// Sources: Ayrton & Perry, The Engineer 62 (1886) 464; Timoshenko & Gere, Theory of Elastic Stability (1961), 1.12, 2.7.
struct Collapse {
  double pressure_Pa = 0.0;
  double offset_m = 0.0;  // a at it
  // Of the pressure, relative: beyond buckling the load rises by pi^2/32 (a/L)^2 if the pillar bends, and by half as
  // much if its foot turns, to the extent that the base lowers the buckling pressure.
  double left_out = 0.0;
};

// Throws std::invalid_argument unless bow and strain are positive and the bow is shorter than half the pillar.
void check_bow(const PillarScene& scene, double bow_m, double strain);
// The same, and SceneMistake for a strain that the foot never reaches.
Collapse collapse(const PillarScene& scene, double buckling_Pa, double bow_m, double strain);

// A clamped elastica of length 1 that is bowed by `bow` at its top, and whose foot a load bends further by a curvature.
struct BentElastica {
  double load_share = 0.0;  // of the load at which the straight one buckles
  double offset = 0.0;      // of its top
};
BentElastica bent_elastica(double curvature, double bow);

}  // namespace viscard
