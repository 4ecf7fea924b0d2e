#pragma once

#include "models/pillar/body/pillar_model.h"

namespace viscard {

// How a body that nothing holds moves as a whole, within one family of motion: along its axis
// (longitudinal), about it (torsion), sideways and rocking (lateral), not at all (ovalling).
int rigid_motion_count(Motion motion);

// The rigid motions of a model whose bottom is free, as columns of its unknowns: 1 m along z or x,
// a turn by 1 rad about the bottom's middle. They lie in every mesh of degree 2 and more.
Eigen::MatrixXd rigid_motions(const PillarModel& model);

}  // namespace viscard
