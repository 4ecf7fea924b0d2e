#pragma once

#include "io/basics/printed_value.h"
#include "models/scene/scene.h"

#include <string>
#include <vector>

namespace viscard {

// Values that a sweep over rows of pillars combines; an empty list stands for the scene's own
// value.
struct ArraySweep {
  std::vector<double> diameter_m, spacing_m, thickness_m;
  double length_over_diameter = 0.0;  // 0: the scene's length at every diameter
  double limit_percent =
      0.0;  // report the first spacing whose deviation lies below this; 0: do not
  bool is_empty() const { return diameter_m.empty() && spacing_m.empty() && thickness_m.empty(); }
};

// What stands in a scene file.
struct SceneFile {
  Scene scene;
  ArraySweep sweep;                   // of rows of pillars; otherwise empty
  std::vector<PrintedValue> printed;  // [[printed]]
};

// One combination; `label` names what varies: "diameter 40 um, spacing 60 um".
struct SweepPoint {
  ArrayScene scene;
  std::string label;
};

// Every combination of the sweep, diameters slowest, spacings fastest.
std::vector<SweepPoint> points_of(const ArrayScene& scene, const ArraySweep& sweep);

}  // namespace viscard
