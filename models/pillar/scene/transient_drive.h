#pragma once

#include "models/pillar/scene/load_place.h"
#include "models/pillar/time/load_history.h"

#include <vector>

namespace viscard {

// A load in time with inertia: pressure (axial) or shear (lateral) on the top, or the base shaken.
struct TransientDrive {
  LoadPlace load_place = LoadPlace::kTop;
  LoadDirection direction = LoadDirection::kAxial;
  std::vector<HistoryPoint> history;  // Pa on the top, m/s^2 of the base
  double end_time_s = 0.0;
  int outputs = 1000;  // equal intervals
};

}  // namespace viscard
