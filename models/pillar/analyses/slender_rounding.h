#pragma once

#include "models/answer/scene_answer.h"
#include "models/pillar/mesh/pillar_mesh.h"
#include "models/pillar/scene/pillar_scene.h"

namespace viscard {

// Rounding in the modes of slender pillars. The entries of the stiffness grow as the elements at the
// rim of the bond become thinner, and the stiffness against bending falls as 1/L^3, so that the
// rounding of the entries acts as a spurious spring against the deflection.

// Relative error of the first bending frequency of a scene on a mesh: eight standard deviations of
// the sum of independent rounding errors of all entries (Higham, Accuracy and Stability of Numerical
// Algorithms (2002), 2.8), for a pillar bent uniformly. 0 if a bound shows that it is negligible.
double bending_rounding(const PillarScene& scene, const Discretisation& mesh);

// What the rim of the bond adds to the first lateral and longitudinal frequency if the mesh has no more
// layers than these, relative. Each layer leaves ratio^(2 lambda), with lambda = 0.6 for the corner of a
// nearly incompressible pillar. A pillar of 5.25 diameters at nu = 0.4994 has 0.04 R/L (3e-4, 3.9e-5
// and 3.8e-6 with 1, 2 and 3 layers) on a rigid base and 0.06 R/L on a soft film; 0.08 is taken.
double rim_share(const PillarScene& scene, const Discretisation& mesh, int layers);

// Removes layers from the mesh until rounding is well below the tolerance, or until the rim would lose
// more than rounding gains, unless rounding alone takes half of the tolerance; returns what is left.
// Throws std::runtime_error if it is above the tolerance with one layer.
double avoid_rounding(const PillarScene& scene, Discretisation& mesh);

// Makes the rim of the bond, if layers were removed, part of the errors of the modes that strain it; a
// mode with 2 n - 1 quarter waves strains it so many times as much.
void add_missing_layers(double rim, SceneAnswer& answer);

// Makes rounding part of the errors of the lateral modes; it falls as 1/frequency^2.
void add_rounding(const PillarScene& scene, double rounding, SceneAnswer& answer);

}  // namespace viscard
