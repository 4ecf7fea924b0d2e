#pragma once

#include "models/pillar/body/pillar_model.h"
#include "models/pillar/mesh/pillar_mesh.h"

#include <vector>

namespace viscard {

// How the film ends beyond the outer pillars.
enum class FilmEnds {
  kFree,   // cut off, free
  kMirror  // half a spacing further begins the mirror image: an endless row
};

// A row of identical pillars, strips in the plane, on one film whose bottom is held. Pillars are
// numbered from the left; lengths in m.
struct ArrayGeometry {
  int count = 8;
  double diameter_m = 40e-6;
  double length_m = 120e-6;
  double spacing_m = 60e-6;  // from edge to edge of neighbours
  double film_thickness_m = 25e-6;
  FilmEnds ends = FilmEnds::kFree;
  double film_edge_m = 100e-6;  // film beyond the outer pillars' faces, for free ends
};

// One electrode under each pillar on the face that is not grounded.
struct ArrayElectrodes {
  FilmFace grounded = FilmFace::kTop;
  double half_width_m = 0.0;      // 0: as wide as the pillar
  bool is_equipotential = false;  // false: the face carries no charge, and its potential is read
};

// Throws SceneMistake naming the wrong length, or electrodes that overlap or leave the film.
void validate(const ArrayGeometry& geometry, const ArrayElectrodes& electrodes);

// Half the width of an electrode, for the default that of the pillar.
double electrode_half_width_m(const ArrayGeometry& geometry, const ArrayElectrodes& electrodes);
// The same pillar alone, on a film so wide that its ends have no effect.
ArrayGeometry lone(ArrayGeometry geometry);

// A break of the mesh, and whether stress or field is singular there, so that elements shrink.
struct MeshMark {
  double x = 0.0;
  bool is_singular = false;
  int fewer_layers = 0;  // fewer layers than elsewhere, because this place has little effect
};
// Breaks from the first mark to the last one. Toward each singular mark `layers` elements shrink by
// `ratio` over `reach_m`, if two or more layers remain; all other elements are no longer than
// `largest_m`. Marks ascend.
std::vector<double> breaks_between(const std::vector<MeshMark>& marks, double reach_m,
                                   double largest_m, int layers, double ratio);

// The film under a pillar and a little beside it, x = 0 under the pillar's middle.
struct CellMesh {
  std::vector<double> x;
  int first_pillar_column = 0;  // the pillar stands on columns [first, last)
  int last_pillar_column = 0;
};

// The row as a chain of pieces that repeat: [edge] cell [gap cell]... [edge]. Gap and edge start at
// x = 0, and the left edge is the mirror image of the right one. An empty gap or edge does not
// exist. An electrode lies inside its cell, because its one voltage cannot be an unknown of both
// ends; only where the film ends with it does it reach the cell's end.
struct ArrayMesh {
  CellMesh cell;
  CellMesh first_cell, last_cell;  // differ from the others if the film ends a little beside them
  bool ends_differ = false;        // they do
  std::vector<double> gap_x, edge_x;
  std::vector<double> film_z;    // from -thickness to 0
  std::vector<double> pillar_z;  // from 0 to length
};
// Elements of the shaft are no longer than two diameters over `shaft_elements`.
ArrayMesh array_mesh(const ArrayGeometry& geometry, const ArrayElectrodes& electrodes,
                     const Discretisation& discretisation);

}  // namespace viscard
