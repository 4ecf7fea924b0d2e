#pragma once

#include "models/pillar/mesh/pillar_mesh.h"

#include <vector>

namespace viscard {

// Meshes of rising degree p and layers at the singular rim. Their polynomial spaces are nested, so
// that the change of a quantity from one mesh to the next is, by Galerkin orthogonality, the
// residual of the coarser answer weighted by the dual solution of the finer mesh: the dual-weighted
// residual of that very quantity, whether it is its own dual (a deflection under its load, a
// frequency) or not (an electrode's voltage, a stress). Source: Becker & Rannacher, Acta Numerica
// 10 (2001) 1.
std::vector<Discretisation> mesh_sequence(const PillarGeometry& geometry);

}  // namespace viscard
