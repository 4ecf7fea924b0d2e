#pragma once

#include "models/pillar/scene/pillar_scene.h"

namespace viscard {

// The traction at the bond is not uniform, so that the film yields a little more than under a
// uniform one; the largest such factor seen over random scenes is 1.3 (tests/models/scene).
inline constexpr double kUnevenTraction = 1.5;

struct FilmElasticity {
  double young_Pa = 0.0, shear_Pa = 0.0, nu = 0.0;  // of the most compliant direction
};
FilmElasticity elasticity_of(const Medium& film);

// Share of the deflection under each kind of load that the film adds to the pillar's own (eq. E1).
struct FilmShares {
  double axial = 0.0, bending = 0.0, shear = 0.0, torsion = 0.0;
  double lateral() const { return 2.0 * bending + shear; }
};
FilmShares film_shares(const PillarScene& scene);

}  // namespace viscard
