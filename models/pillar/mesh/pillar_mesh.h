#pragma once

#include "models/pillar/mesh/section.h"

#include <optional>
#include <vector>

namespace viscard {

// A film under the pillar, as a disc whose bottom is held. Without a film the base is rigid.
struct FilmGeometry {
  double thickness_m = 0.0;
  double radius_m = 0.0;            // outer edge, free; at least the radius of the pillar
  double electrode_radius_m = 0.0;  // the mesh is graded toward its edge; 0: none
  bool electrode_is_below = false;  // on the bottom of the film
};

// One end of a pillar that becomes wider: over `height` toward the end the radius grows by `width`,
// as a parabola tangent to the shaft. Models a fillet at the foot or a mushroom at the tip. A
// negative width makes the end thinner.
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

double radius_at_m(const PillarGeometry& geometry, double z_m);  // z = 0 at the foot
double bond_radius_m(const PillarGeometry& geometry);

constexpr int kPillarRegion = 0;
constexpr int kFilmRegion = 1;

// The meridian section with z = 0 at the bond. Columns [0, pillar_columns) lie under the pillar;
// rows from bond_row upward belong to the pillar.
struct PillarMesh {
  Section section;
  int pillar_columns = 0;
  int bond_row = 0;  // number of the break z = 0
  int top_row = 0;   // number of the break z = length
};

// Throws std::invalid_argument with the name of the length that is not positive and finite, or if
// the film is narrower than the pillar.
void validate(const PillarGeometry& geometry);
PillarMesh pillar_mesh(const PillarGeometry& geometry, const Discretisation& discretisation);

// Nodes on the horizontal line at a break, within the given columns.
std::vector<int> nodes_on_break(const Section& section, int break_row, int first_column,
                                int last_column);

// Meshes of rising degree p and more layers at the singular rim, with nested polynomial spaces. By
// Galerkin orthogonality, the change of a quantity from one mesh to the next is then its
// dual-weighted residual: that of the coarser solution, weighted by the finer dual solution. This
// holds for quantities that are their own dual (a deflection under its load, a frequency) and
// others (an electrode's voltage, a stress). Source: Becker & Rannacher, Acta Numerica 10 (2001) 1.
std::vector<Discretisation> mesh_sequence(const PillarGeometry& geometry);

// Three meshes that end with the given one. On uniform meshes each halves the elements of the one
// before; on graded ones each has one degree more, and `finest` must have degree 3 or more.
std::vector<Discretisation> refinements_to(const Discretisation& finest);

}  // namespace viscard
