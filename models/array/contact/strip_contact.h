#pragma once

#include "models/array/contact/press_array.h"
#include "models/array/contact/shape_press.h"

#include <Eigen/Core>

namespace viscard {

// How the top of one strip in the plane moves under forces at its nodes, per metre across the plane:
// first the nodes' motions along x, then how far they sink; the same of the forces (m2/N).
struct StripCompliance {
  Eigen::VectorXd x_m;       // nodes, from the strip's middle
  Eigen::VectorXd length_m;  // int N_j dx of each; their sum is the width
  Eigen::MatrixXd motion_m2_N;

  Eigen::Index nodes() const { return x_m.size(); }
};

// Forces on the nodes of a top, N/m: along x, and down.
struct StripForces {
  Eigen::VectorXd along, down;
};

// The forces that bring the nodes to a rigid surface (eq. T7). Nodes that are held sink by their overlap
// (negative: the surface stays above the node, -infinity where there is none), and with friction also
// move along x by `along_m`. Tops that are pushed are held only where they push; those that follow are
// held everywhere. Throws std::runtime_error if the set of nodes that touch does not settle.
struct StripPress {
  Eigen::VectorXd overlap_m;
  Eigen::VectorXd along_m;
  Friction friction = Friction::kNone;
  TopBond bond = TopBond::kPushed;
};
StripForces strip_forces(const StripCompliance& strip, const StripPress& press);

}  // namespace viscard
