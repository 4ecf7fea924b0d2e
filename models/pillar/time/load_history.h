#pragma once

#include "models/pillar/time/viscoelastic_system.h"

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace viscard {

// Value against time, linear between points; two points of one time are a jump.
struct HistoryPoint {
  double time_s = 0.0;
  double value = 0.0;
};

// Throws SceneMistake with the key of the first point that is wrong, "analysis.history.3": values
// must be finite, and no time may lie before 0 or before the point ahead of it.
void validate(const std::vector<HistoryPoint>& history);

struct HistoryOptions {
  double tolerance = 1e-8;       // relative error aimed at
  double relative_floor = 1e-3;  // errors are relative to max(|value|, floor * largest |value|)
  int order = 4;                 // of the stepper
  int first_steps = 8;           // steps per block on the coarsest level
  int max_levels = 8;            // each halves every step
  std::vector<double> output_times_s;      // further times to hit exactly
  std::vector<Eigen::VectorXd> observers;  // further linear outputs, vectors times u
  std::function<void(double)> progress;    // called with the fraction done; may be empty
};

struct HistoryResult {
  std::vector<double> time_s;                 // a jump gives one time twice
  std::vector<double> force;                  // multiple of the unit load
  std::vector<double> displacement;           // load.u
  std::vector<std::vector<double>> observed;  // [observer][time]
  double error_estimate = 0.0;                // relative, of all of these
  bool converged = false;
  int steps = 0;           // of all levels together
  int factorisations = 0;  // of all levels together
};

// Runs a history from rest through ViscoelasticStepper. After each corner of the history the blocks
// start far below the fastest relaxation time and double, so that the cost grows with the number of
// decades and not with their length. Every block is cut into equal steps, which are halved all
// together until the answer changes by less than the tolerance; the last change is the error
// estimate, which the next halving would undercut by about 2^order. Throws std::invalid_argument
// unless the history starts at time 0, has an end later than that and never goes back in time.
HistoryResult run_history(const ViscoelasticSystem& system, Control control,
                          const std::vector<HistoryPoint>& history, const HistoryOptions& options);

}  // namespace viscard
