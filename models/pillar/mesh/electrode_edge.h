#pragma once

#include "models/pillar/mesh/pillar_geometry.h"

#include <vector>

namespace viscard {

// Grades the mesh toward the edge of the film's electrode: from the left and the right (x) and, for
// an electrode below the film, from above (z). Toward an electrode on top the mesh already shrinks
// in z, because of the rim of the bond. Where the face beyond an electrode carries no charge, the
// potential varies with the square root of the distance from the edge. A rising degree alone
// converges slowly there: at degree 10 the voltage is wrong by 5e-4, with graded layers by 1e-6.
// Source: Grisvard, Elliptic Problems in Nonsmooth Domains (1985), 2.3 (mixed boundary conditions).
void grade_toward_electrode(const FilmGeometry& film, const Discretisation& discretisation,
                            std::vector<double>& x, std::vector<double>& z);

}  // namespace viscard
