#pragma once

#include "models/pillar/scene/pillar_scene.h"

#include <string>

namespace viscard {

// Pressure at which the pillar buckles, clamped at its foot, by Euler's formula with Engesser's
// correction for shear, P = P_e/(1 + P_e/(kappa G A)) (eq. E6), in Pa. The top is free; a plate on
// the top keeps it upright but lets it slide, which makes the pressure four times as large.
double engesser_pressure_Pa(const PillarScene& scene);

// A pressure well below which no pillar buckles under a free top: half of Euler's, with the turn of
// its foot on the film (eq. E1).
double rough_buckling_pressure_Pa(const PillarScene& scene);

// Pressure at which the pillar buckles under a free top: its own on a coarse mesh (infinite if it is
// so stubby that it buckles only locally), for a strip Engesser's (eq. E6).
double pillar_buckling_pressure_Pa(const PillarScene& scene);

// The same pillar long after loading: with its long-term moduli, after which it relaxes no further.
PillarScene long_term_scene(const PillarScene& scene);

// Largest pressure on the top, Pa; 0 for a history of shortening. A displacement u of the top
// counts as E u/L. An analysis that finds a pressure itself counts with that pressure.
double largest_pressure_Pa(const PillarScene& scene);

// A clause with the load and the buckling pressure that it exceeds; "" if the straight pillar bears
// the load. If Euler's formula comes near the load, the limit is the pillar's own buckling pressure
// on a coarse mesh; for a strip it is Engesser's formula (eq. E6).
std::string beyond_buckling(const PillarScene& scene);

// True if the scene forces geometric_stiffness off, and so declares that its pillar stays straight.
bool holds_straight(const PillarScene& scene);

// Throws SceneMistake if the load lies beyond buckling, where the straight shape is not a valid
// answer, unless the scene holds the pillar straight.
void refuse_beyond_buckling(const PillarScene& scene);

}  // namespace viscard
