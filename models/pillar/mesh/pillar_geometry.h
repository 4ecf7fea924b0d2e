#pragma once

#include <optional>

namespace viscard {

// A cylindrical pillar standing on a rigid base or on a film whose bottom is held.
struct FilmGeometry {
  double thickness_m = 0.0;
  double radius_m = 0.0;            // outer edge, free; at least the pillar's radius
  double electrode_radius_m = 0.0;  // the mesh shrinks toward its edge; 0: none
  bool electrode_is_below = false;  // on the bottom of the film
};

// One end of a pillar that widens: over `height` toward the end the radius grows by `width`, as a
// parabola tangent to the shaft. A fillet at the foot, a mushroom at the tip; a negative width
// makes the end thinner.
struct Flare {
  double width_m = 0.0;
  double height_m = 0.0;
};

struct PillarGeometry {
  double diameter_m = 40e-6;  // of the shaft
  double length_m = 120e-6;
  std::optional<FilmGeometry> film;
  Flare foot;
  Flare tip;
};

// Graded (the default): elements shrink by `ratio` toward the rim of the bond, where stress is
// singular (clamped-free corner): `layers` of them in each direction.
struct Discretisation {
  int degree = 4;
  int layers = 2;
  double ratio = 0.15;
  int shaft_elements = 2;  // along the pillar above the graded foot
  int film_elements = 1;   // across the film outside the graded part
  // No element of the pillar longer than this either way, for waves of about that length; 0: none.
  double longest_m = 0.0;
  // For waves that die out: longest_m holds only this far from the pillar's side and its top (or
  // its foot), and deeper in elements may be longer by what lies between. 0: everywhere.
  double skin_m = 0.0;
  bool skin_at_foot = false;
  // Uniform instead, as ordinary meshes are: elements of about this size in both directions.
  double uniform_m = 0.0;
};

}  // namespace viscard
