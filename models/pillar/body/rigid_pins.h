#pragma once

#include "models/pillar/system/kinematics.h"

#include <vector>

namespace viscard {

// One held unknown per rigid motion (a field at the middle or at the rim of the bottom), so that
// the statics of a free body under loads that balance themselves have a unique solution.
struct RigidPin {
  int field = 0;
  bool at_rim = false;
};
std::vector<RigidPin> rigid_pins(Motion motion);

}  // namespace viscard
