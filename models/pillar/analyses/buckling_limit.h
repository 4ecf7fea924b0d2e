#pragma once

#include "models/pillar/scene/pillar_scene.h"

#include <string>

namespace viscard {

// How the top is held of a pillar that is clamped at its foot. A column buckles in half waves that are twice as long
// as the pillar, as long, and half as long. Source: Timoshenko & Gere, Theory of Elastic Stability (1961), 2.1 and 2.2.
enum class TopEnd {
  kFree,
  kSlides,  // a plate keeps it level and lets it move sideways
  kSticks   // a plate holds it
};
TopEnd top_end(const PillarScene& scene);

// Pressures, Pa, at which the pillar buckles: by Euler's formula, 1 to 4 to 16 for the three ends, and with Engesser's
// correction for shear, P = P_e/(1 + P_e/(kappa G A)) (eq. E6), which takes more where the half wave is shorter. The
// only place of both formulas.
double euler_pressure_Pa(const PillarScene& scene, TopEnd end);
double engesser_pressure_Pa(const PillarScene& scene, TopEnd end);
double engesser_pressure_Pa(const PillarScene& scene);  // with its own end

// A pressure well below which no pillar buckles under a free top: half of Euler's, with the turn of
// its foot on the film (eq. E1).
double rough_buckling_pressure_Pa(const PillarScene& scene);

// Pressure at which the pillar buckles under a top that is held like this: its own on a coarse mesh (infinite if it is
// so stubby that it buckles only locally); for a strip, and for a top that sticks, Engesser's (eq. E6).
double pillar_buckling_pressure_Pa(const PillarScene& scene, TopEnd end = TopEnd::kFree);

// The same pillar long after loading: with its long-term moduli, after which it relaxes no further.
PillarScene long_term_scene(const PillarScene& scene);

// What the pillar's weight is worth as a pressure on the top, Pa, negative for one that hangs: it buckles under rho g L =
// 7.837 E I/(A L^2), under a load at 2.467. Source: Timoshenko & Gere, Theory of Elastic Stability (1961), 2.12.
double weight_on_top_Pa(const PillarScene& scene);

// Largest pressure on the top, Pa; 0 for a history of shortening. A displacement u of the top
// counts as E u/L. An analysis that finds a pressure itself counts with that pressure.
double largest_pressure_Pa(const PillarScene& scene);

// The load over that at which the straight pillar buckles, 0 far below it; from 1 on with a clause that names both. If
// Euler's formula comes near the load, the limit is the pillar's own buckling pressure on a coarse mesh; for a strip,
// and for a long pillar whose foot does not turn, it is Engesser's formula (eq. E6).
struct BucklingShare {
  double of_limit = 0.0;
  std::string beyond;
};
BucklingShare buckling_share(const PillarScene& scene);

// True if the scene forces geometric_stiffness off, and so declares that its pillar stays straight.
bool holds_straight(const PillarScene& scene);

// Throws SceneMistake if the load lies beyond buckling, where the straight shape is not a valid
// answer, unless the scene holds the pillar straight. Returns the share of the load, 0 if it is held.
double refuse_beyond_buckling(const PillarScene& scene);

}  // namespace viscard
