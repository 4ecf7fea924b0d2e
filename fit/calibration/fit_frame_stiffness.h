#pragma once

#include "models/experiment/captured_run.h"

#include <vector>

namespace viscard {

// Stage position against force on a rigid block, in contact. Everything that gives way then is the
// frame, the load cell most of all.
struct BlockPoints {
  std::vector<double> position_m, force_N;  // force from any zero
  std::vector<double> force_se_N;           // standard error of each; empty: not known
};

struct FrameStiffnessFit {
  double stiffness_N_m = 0.0;
  double relative_u = 0.0;  // standard uncertainty: regression and the load cell's gain
  double low_N_m = 0.0, high_N_m = 0.0;  // k = 2
  double curvature_m = 0.0;              // largest departure of the position from the line
  int n_points = 0;
};

// Position = p0 + F/k by least squares; standard error of 1/k by regression, the gain's relative
// standard uncertainty added in quadrature. Throws std::invalid_argument unless there are three
// points and the position grows with the force.
FrameStiffnessFit fit_frame_stiffness(const BlockPoints& points, double gain_relative_u);

// The holds of a run with protocol "compliance" (models/test_plan.h): where the stage stood and the
// mean force of each. Throws std::runtime_error if there are none.
BlockPoints block_points_from_capture(const CapturedRun& run);

}  // namespace viscard
