#pragma once

#include "models/pillar/body/pillar_model.h"

namespace viscard {

// Number of rigid motions of an unsupported body within one family of motion: along its axis
// (longitudinal), about it (torsion), sideways and rocking (lateral), none (ovalling).
int rigid_motion_count(Motion motion);

// The rigid motions of a model whose bottom is free, as columns of its unknowns: 1 m along z or x,
// and a rotation by 1 rad about the middle of the bottom. Meshes of degree 2 and more contain them
// exactly.
Eigen::MatrixXd rigid_motions(const PillarModel& model);

}  // namespace viscard
