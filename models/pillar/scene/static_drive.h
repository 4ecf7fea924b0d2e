#pragma once

#include "models/pillar/scene/load_place.h"

#include <optional>

namespace viscard {

// A load at rest on the top, and a voltage on the electrode.
struct StaticDrive {
  LoadDirection direction = LoadDirection::kAxial;
  double pressure_Pa = 0.0;              // lateral: shear
  std::optional<double> displacement_m;  // of the top along +z (lateral: +x), instead of a pressure
  double drive_V = 0.0;                  // on the electrode (actuator)
};

}  // namespace viscard
