#pragma once

#include "models/pillar/mesh/section.h"

#include <optional>
#include <vector>

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

double radius_at_m(const PillarGeometry& geometry, double z_m);  // z = 0 at the foot
double bond_radius_m(const PillarGeometry& geometry);

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

// Three meshes that end with the given one: elements half as large each time on uniform meshes, a
// degree more each time on graded ones, whose degree must be 3 or more.
std::vector<Discretisation> refinements_to(const Discretisation& finest);

constexpr int kPillarRegion = 0;
constexpr int kFilmRegion = 1;

// The meridian section with z = 0 at the bond. Columns [0, pillar_columns) lie under the pillar;
// rows from bond_row up are the pillar's.
struct PillarMesh {
  Section section;
  int pillar_columns = 0;
  int bond_row = 0;  // number of the break z = 0
  int top_row = 0;   // number of the break z = length
};

// Throws std::invalid_argument naming the length that is not positive and finite, or the film that
// is narrower than the pillar.
void validate(const PillarGeometry& geometry);
PillarMesh pillar_mesh(const PillarGeometry& geometry, const Discretisation& discretisation);

// Nodes on the horizontal line at a break, in the columns given.
std::vector<int> nodes_on_break(const Section& section, int break_row, int first_column,
                                int last_column);

}  // namespace viscard
