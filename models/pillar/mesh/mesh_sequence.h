#pragma once

#include "models/pillar/mesh/pillar_mesh.h"

#include <vector>

namespace viscard {

// Meshes of rising degree p and with more layers at the singular rim. Their polynomial spaces are
// nested. By Galerkin orthogonality, the change of a quantity from one mesh to the next is then the
// residual of the coarser solution weighted by the dual solution of the finer mesh, which is the
// dual-weighted residual of that quantity. This holds for quantities that are their own dual (a
// deflection under its load, a frequency) and for others (the voltage of an electrode, a stress).
// Source: Becker & Rannacher, Acta Numerica 10 (2001) 1.
std::vector<Discretisation> mesh_sequence(const PillarGeometry& geometry);

}  // namespace viscard
