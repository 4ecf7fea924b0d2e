#pragma once

#include <Eigen/Core>

#include <functional>
#include <string>
#include <vector>

namespace viscard {

// A cause of uncertainty: one standard deviate, or several that are independent of each other.
struct UncertainInput {
  std::string name;
  Eigen::Index n_deviates = 1;
  bool is_uniform = false;  // otherwise its deviates are normal
};

Eigen::Index count_deviates(const std::vector<UncertainInput>& inputs);
// The first deviate of each input, and one past the last.
std::vector<Eigen::Index> first_deviates(const std::vector<UncertainInput>& inputs);

// Answers at many points at once: each row of the argument holds the standard deviates of one point
// (0: every input at its value), each row of the result the answer there. A point that has no answer
// gives a row with NaN.
using BatchFunction = std::function<Eigen::MatrixXd(const Eigen::MatrixXd& deviates)>;

}  // namespace viscard
