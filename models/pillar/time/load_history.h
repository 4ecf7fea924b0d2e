#pragma once

#include "models/maths/course.h"
#include "models/pillar/time/viscoelastic_system.h"

#include <Eigen/Core>

#include <functional>
#include <optional>
#include <vector>

namespace viscard {

// Throws SceneMistake with the key of the first wrong point, such as "analysis.history.3". Values
// must be finite, and no time may be negative or earlier than that of the point before it.
void validate_history(const Course& history);

// Accuracy and outputs of a run through a history.
struct HistoryOptions {
  double tolerance = 1e-8;       // target for the relative error
  double relative_floor = 1e-3;  // errors are relative to max(|value|, floor * largest |value|)
  int order = 4;                 // of the stepper
  int first_steps = 8;           // steps per block on the coarsest level
  int max_levels = 8;            // each halves all steps
  std::vector<double> output_times_s;      // additional times that steps must hit exactly
  std::vector<Eigen::VectorXd> observers;  // additional linear outputs, vectors times u
  std::optional<int> only_level;           // this one alone, without an estimate of its error
  std::function<void(double)> progress;    // callback with the completed fraction; may be empty
};

// Results of a run through a history.
struct HistoryResult {
  std::vector<double> time_s;                 // a jump has the same time twice
  std::vector<double> force;                  // multiple of the unit load
  std::vector<double> displacement;           // load.u
  std::vector<std::vector<double>> observed;  // [observer][time]
  double error_estimate = 0.0;                // relative, of all outputs above
  bool converged = false;
  int steps = 0;           // of all levels together
  int factorisations = 0;  // of all levels together
  int level = 0;           // of the values; each halves all steps
};

// Runs a history from rest through ViscoelasticStepper. After each corner of the history the blocks
// start far shorter than the fastest relaxation time and double in length, so that the cost grows
// with the number of decades and not with the duration. Every block is divided into equal steps.
// All steps are halved together until the answer changes by less than the tolerance. The last
// change is the error estimate; the next halving would reduce it by about 2^order. Throws
// std::invalid_argument unless the history starts at time 0, ends later and never goes back.
HistoryResult run_history(const ViscoelasticSystem& system, Control control, const Course& history,
                          const HistoryOptions& options);

}  // namespace viscard
