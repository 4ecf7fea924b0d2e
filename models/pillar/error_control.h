#pragma once

#include "models/pillar/scene.h"

#include <functional>
#include <vector>

namespace viscard {

// Meshes of rising degree p and layers at the singular rim. Their polynomial spaces are nested, so
// that the change of a quantity from one mesh to the next is, by Galerkin orthogonality, the
// residual of the coarser answer weighted by the dual solution of the finer mesh: the dual-weighted
// residual of that very quantity, whether it is its own dual (a deflection under its load, a
// frequency) or not (an electrode's voltage, a stress). Source: Becker & Rannacher, Acta Numerica
// 10 (2001) 1.
std::vector<Discretisation> mesh_sequence(const PillarGeometry& geometry);

// Everything a scene asks for on one mesh, without mesh errors.
using MeshAnswer = std::function<SceneAnswer(const Discretisation&)>;

struct ErrorControl {
  double tolerance = 1e-3;  // relative, of every result, frequency and point of a curve
  std::vector<Discretisation> meshes;
  std::function<void(double)> progress;  // fraction of the meshes done; may be empty
};

// Runs through the meshes until the change from the last one, and at least a tenth of the change
// before (a quarter if the layers stayed the same), so that a chance agreement of two meshes does
// not pass, is within the tolerance; that
// change, plus the answer's own step error, is the error estimate on every number. Throws
// std::runtime_error saying which number stays how far off when the finest mesh is not enough.
SceneAnswer answer_within(const ErrorControl& control, const MeshAnswer& answer_on);

}  // namespace viscard
