#pragma once

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

// Graded (the default): elements shrink by `ratio` toward the rim of the bond, where the stress is
// singular (clamped-free corner), in `layers` layers in each direction.
struct Discretisation {
  int degree = 4;
  int layers = 2;
  double ratio = 0.15;
  int shaft_elements = 2;   // along the pillar above the graded foot
  int film_elements = 1;    // across the film outside the graded part
  bool grades_top = false;  // toward the top as well, whose rim is singular under a dead pressure
  // Largest element size of the pillar in both directions, about one wavelength; 0: no limit.
  double longest_m = 0.0;
  // For waves that decay: longest_m applies only within this distance of the pillar's side and its
  // top (or foot). Deeper elements may be longer by their extra distance. 0 applies it everywhere.
  double skin_m = 0.0;
  bool skin_at_foot = false;
  // Uniform mesh instead of a graded one: elements of about this size in both directions.
  double uniform_m = 0.0;
};

}  // namespace viscard
