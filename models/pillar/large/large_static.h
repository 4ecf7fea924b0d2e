#pragma once

#include "models/pillar/large/large_body.h"

#include <optional>
#include <vector>

namespace viscard {

// What presses the top of a pillar at large strain.
struct LargeLoad {
  double pressure_Pa = 0.0;              // force over the area at rest, along -z (a dead load)
  std::optional<double> displacement_m;  // of the top along +z, instead; its mean
  // A pressure of a fluid: normal to the deformed top, on its deformed area. Only with a pressure.
  bool follows_surface = false;
};

// A state of equilibrium.
struct LargeState {
  Eigen::VectorXd u;
  double pressure_Pa = 0.0;         // on the top: force over area at rest (or of the fluid)
  double force_N = 0.0;             // along +z on the top
  double top_displacement_m = 0.0;  // mean along +z
  double rest = 0.0;                // relative size of the last correction: what Newton leaves
  int load_steps = 0;               // that were needed
  // Directions in which the energy falls, mostly creases at the singular rim of the bond; 0: stable.
  int falling_directions = 0;
  std::vector<double> corrections;  // relative sizes of those of the last load step
};

// Newton's method with a line search, in as few load steps as converge. A step along the
// correction is halved until the next correction, with the same matrix, is smaller (the natural
// monotonicity test: Deuflhard, Newton Methods for Nonlinear Problems (2004), ch. 3). The tangent of
// a pressure that follows the surface leaves its load stiffness out, so that such a correction leaves
// about p/E of the last one. Throws std::runtime_error with the load reached if no equilibrium
// is found beyond it, or if the top yields against the load there.
LargeState solve_large(LargeBody& body, const LargeLoad& load);

}  // namespace viscard
