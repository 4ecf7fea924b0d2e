#pragma once

#include "models/answer/discretisation.h"

#include <optional>

namespace viscard {

// Lengths that agree to nine digits are meant to be equal, and meshes treat them so.
constexpr double kSameLength = 1e-9;

// A film under the pillar, as a disc whose bottom is held. Without a film the base is rigid.
struct FilmGeometry {
  double thickness_m = 0.0;
  double radius_m = 0.0;            // outer edge, free; at least the radius of the pillar
  double electrode_radius_m = 0.0;  // the mesh is graded toward its edge; 0: none
  bool electrode_is_below = false;  // on the bottom of the film
  bool operator==(const FilmGeometry&) const = default;  // all lengths equal to the last bit
};

// One end of a pillar that becomes wider: over `height` toward the end the radius grows by `width`,
// as a parabola tangent to the shaft. Models a fillet at the foot or a mushroom at the tip. A
// negative width makes the end thinner.
struct Flare {
  double width_m = 0.0;
  double height_m = 0.0;
  bool operator==(const Flare&) const = default;  // all lengths equal to the last bit
};

// Lengths of a pillar, with the film under it.
struct PillarGeometry {
  double diameter_m = 40e-6;  // of the shaft
  double length_m = 120e-6;
  std::optional<FilmGeometry> film;
  Flare foot;
  Flare tip;
  bool operator==(const PillarGeometry&) const = default;  // all lengths equal to the last bit
};

}  // namespace viscard
