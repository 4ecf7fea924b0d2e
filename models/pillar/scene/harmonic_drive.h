#pragma once

#include "models/pillar/scene/load_place.h"

#include <vector>

namespace viscard {

// A steady oscillation: pressure (axial) or shear (lateral) on the top, or the base shaken.
struct HarmonicDrive {
  LoadPlace load_place = LoadPlace::kTop;
  LoadDirection direction = LoadDirection::kAxial;
  double pressure_Pa = 0.0;             // amplitude on the top
  double base_acceleration_m_s2 = 0.0;  // amplitude of the base
  std::vector<double> frequencies_Hz;   // ascending
};

}  // namespace viscard
