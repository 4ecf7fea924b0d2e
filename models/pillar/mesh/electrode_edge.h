#pragma once

#include "models/pillar/mesh/pillar_geometry.h"

#include <vector>

namespace viscard {

// Makes the breaks of a graded mesh shrink toward the edge of the film's electrode, from the left
// and the right (x) and, for one below the film, from above (z; toward an electrode on top they
// shrink already, for the rim of the bond). Where the face beyond an electrode carries no charge
// the potential goes with the square root of the distance from the edge, which a rising degree
// alone follows slowly: at degree 10 the voltage is wrong by 5e-4, with the layers by 1e-6.
// Source: Grisvard, Elliptic Problems in Nonsmooth Domains (1985), 2.3 (conditions that change).
void grade_toward_electrode(const FilmGeometry& film, const Discretisation& discretisation,
                            std::vector<double>& x, std::vector<double>& z);

}  // namespace viscard
