#pragma once

#include "models/pillar/scene/pillar_scene.h"

#include <limits>
#include <optional>
#include <string>

namespace viscard {

// A straight pillar first bears a pressure between its long-term and its instantaneous buckling
// pressure, and then buckles in creep, when its moduli have fallen so far that the buckling
// pressure reaches the load. With the modulus E(t) at time t (quasi-elastic), the pressure that is
// held from 0 to t must stay below
//   p_cr(t) = p_inf + (p_0 - p_inf) (E(t) - E_inf)/(E_0 - E_inf)   (eq. 21b)
// which is exact without film at constant Poisson ratio. Source: Bazant & Cedolin, Stability of
// Structures (1991), ch. 9. p_0 and p_inf are the pillar's own buckling pressures on a coarse mesh
// if Euler's formula comes near the load; for a strip they are Engesser's (eq. E6).

struct CreepBuckling {
  double now_Pa = 0.0, long_term_Pa = 0.0;  // buckling pressures
  double pressure_Pa = 0.0;                 // the load between these two that decides
  double share = 0.0;                       // E(t)/E_0 at which the pillar buckles under it
  double after_s = 0.0;                     // how long the pillar bears it
  // Time of buckling in a history; infinite if the history ends or unloads the pillar before.
  double at_s = std::numeric_limits<double>::infinity();
  // For an oscillating load: below this frequency the load stays above some level for as long as
  // the pillar bears that level. p cos(w t) is above L for the time 2 acos(L/p)/w in each period.
  double below_Hz = 0.0;
};

// Nothing in these cases: no pressure stays, the pressure is below the long-term limit or above the
// instantaneous limit (beyond_buckling()), or the scene holds the pillar straight.
std::optional<CreepBuckling> creep_buckling(const PillarScene& scene);

// A sentence about this for the answer, or for a buckling analysis the pressure that the pillar
// bears for long; "" if neither applies.
std::string creep_buckling_note(const PillarScene& scene);

// Throws SceneMistake if a history of creep, or an oscillating load, holds a pressure until the
// pillar buckles.
void refuse_buckling_in_creep(const PillarScene& scene);

}  // namespace viscard
