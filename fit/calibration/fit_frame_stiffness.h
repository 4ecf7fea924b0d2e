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
  double relative_u = 0.0;  // standard uncertainty: regression, seating, gain of the load cell
  double low_N_m = 0.0, high_N_m = 0.0;  // k = 2
  double curvature_m = 0.0;              // largest deviation of the position from a line
  double seating_m = 0.0;  // by which the block settled under the first forces; 0: not seen
  int n_points = 0;
};

// Fits position = p0 + F/k + s (1 - exp(-F/F_s)) by least squares, s >= 0: a block that settles
// under the first forces bends the line there. The interval of 1/k holds every s and F_s (up to
// half of the largest force) that describe the points as well as the best ones do; its middle is
// the result. Fewer than five points allow a straight line only. The relative standard uncertainty
// of the gain is added in quadrature. Throws std::invalid_argument unless there are three points
// and the position increases with the force, and std::runtime_error if seating or scatter leaves
// 1/k unknown by more than 20 %, and if the points leave a line by more than 10 %, or settle by
// more than 10 % of the whole motion or 10 um, or if the contact stiffens by more than 3 % over the
// upper half of the forces.
FrameStiffnessFit fit_frame_stiffness(const BlockPoints& points, double gain_relative_u);

// The holds of a run with protocol "compliance" (models/experiment/test_plan.h): stage position and
// mean force of each. Throws std::runtime_error if there are none, and for
// another protocol.
BlockPoints block_points_from_capture(const CapturedRun& run);

}  // namespace viscard
