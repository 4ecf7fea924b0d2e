#pragma once

#include <Eigen/Core>

#include <vector>

namespace viscard {

// A load factor against time, linear between points; two points at the same time are a jump.
struct TransientRequest {
  Eigen::VectorXd load;               // of the small body; multiplied by the factor
  std::vector<double> corner_time_s;  // of the load factor, ascending
  std::vector<double> corner_value;
  double end_s = 0.0;
  int outputs = 1000;         // equal intervals between outputs
  double first_step_s = 0.0;  // longest step of the coarsest level
  double tolerance = 1e-4;    // relative to the largest value of each output
  int most_steps = 4000000;
};

struct TransientResult {
  std::vector<double> time_s;   // outputs + 1 equal steps from 0
  Eigen::MatrixXd values;       // observers x times
  double error_estimate = 0.0;  // relative to the largest value of each output
  bool converged = false;
  int steps = 0;  // all levels together
};

}  // namespace viscard
