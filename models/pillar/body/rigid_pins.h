#pragma once

#include "models/pillar/system/kinematics.h"

#include <vector>

namespace viscard {

// One held unknown per rigid motion, so that the statics of a free body under loads that balance
// themselves have one answer: a field at the middle of the bottom, or at its rim.
struct RigidPin {
  int field = 0;
  bool at_rim = false;
};
std::vector<RigidPin> rigid_pins(Motion motion);

}  // namespace viscard
