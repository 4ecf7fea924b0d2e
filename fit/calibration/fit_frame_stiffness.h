#pragma once

#include "models/experiment/captured_run.h"

#include <vector>

namespace viscard {

// Stage position against force on a rigid block, in contact. All compliance is then that of the
// frame, mostly of the load cell.
struct BlockPoints {
  std::vector<double> position_m, force_N;  // force from an arbitrary zero
  std::vector<double> force_se_N;           // standard error of each; empty: unknown
};

struct FrameStiffnessFit {
  double stiffness_N_m = 0.0;
  double relative_u = 0.0;  // standard uncertainty: regression and gain of the load cell
  double low_N_m = 0.0, high_N_m = 0.0;  // k = 2
  double curvature_m = 0.0;              // largest deviation of the position from the line
  int n_points = 0;
};

// Fits position = p0 + F/k by least squares. The standard error of 1/k comes from the regression;
// the relative standard uncertainty of the gain is added in quadrature. Throws
// std::invalid_argument unless there are three points and the position increases with the force.
FrameStiffnessFit fit_frame_stiffness(const BlockPoints& points, double gain_relative_u);

// The holds of a run with protocol "compliance" (models/experiment/test_plan.h): stage position and
// mean force of each. Throws std::runtime_error if there are none.
BlockPoints block_points_from_capture(const CapturedRun& run);

}  // namespace viscard
