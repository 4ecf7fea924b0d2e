#pragma once

#include "models/pillar/mesh/pillar_mesh.h"
#include "models/pillar/scene/pillar_scene.h"
#include "models/scene/common/scene_answer.h"

namespace viscard {

// Rounding in the modes of slender pillars. The entries of the stiffness grow as the elements at the
// rim of the bond become thinner, and the stiffness against bending falls as 1/L^3, so that the
// rounding of the entries acts as a spurious spring against the deflection.

// Relative error of the first bending frequency of a scene on a mesh: eight standard deviations of
// the sum of independent rounding errors of all entries (Higham, Accuracy and Stability of Numerical
// Algorithms (2002), 2.8), for a pillar bent uniformly. 0 if a bound shows that it is negligible.
double bending_rounding(const PillarScene& scene, const Discretisation& mesh);

// Removes layers from the mesh until rounding is well below the tolerance; returns what is left.
// Throws std::runtime_error if it is above the tolerance with one layer.
double avoid_rounding(const PillarScene& scene, Discretisation& mesh);

// Makes rounding part of the errors of the lateral modes; it falls as 1/frequency^2.
void add_rounding(const PillarScene& scene, double rounding, SceneAnswer& answer);

}  // namespace viscard
