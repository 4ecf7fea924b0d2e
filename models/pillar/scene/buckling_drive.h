#pragma once

namespace viscard {

// The pressure at which the straight pillar gives way sideways.
struct BucklingDrive {
  bool plate_on_top = false;  // pressed by a rigid frictionless plate that stays level
};

}  // namespace viscard
