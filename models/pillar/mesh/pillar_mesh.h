#pragma once

#include "models/pillar/mesh/pillar_geometry.h"
#include "models/pillar/mesh/section.h"

#include <vector>

namespace viscard {

double radius_at_m(const PillarGeometry& geometry, double z_m);  // z = 0 at the foot
// Radius of the foot.
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
// For answers that weight gradients by a stress (eq. 21). A layer leaves four times as much of
// their error, so each mesh has one layer more than the last. A mesh of degree 3 with one layer may
// be wrong by a fifth at nu = 0.5 and gives no information about the next mesh.
std::vector<Discretisation> stressed_mesh_sequence(const PillarGeometry& geometry);

// For answers at large strain. Elements that shrink further toward the rim would be turned inside
// out by its singular strain long before the pillar as a whole is strained.
std::vector<Discretisation> large_mesh_sequence(const PillarGeometry& geometry);

// A mesh that measures the error of one that is named, and that one: with two degrees and a layer more; of equal elements,
// a graded one.
std::vector<Discretisation> finer_and(const Discretisation& named, const PillarGeometry& geometry);

}  // namespace viscard
