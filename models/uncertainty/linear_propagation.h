#pragma once

#include "models/maths/interval.h"

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

// An answer to first order in the standard deviates.
struct LinearAnswer {
  Eigen::VectorXd value;        // with every input at its value
  Eigen::MatrixXd slope;        // results x deviates, per standard deviation
  Eigen::MatrixXd slope_error;  // estimates
  // Points where each input is at either end of its 95 % interval, and where each linear result has its
  // own ends, with the function's answers there.
  Eigen::MatrixXd ends, at_ends;
  Eigen::VectorXd disagreement;  // largest difference to those answers, for each result
  std::size_t n_answers = 0;     // the work
};

// Derivatives by Ridders' method: central differences with steps of 0.25, 0.125 ... standard deviations,
// extrapolated to 0, until the estimated error of each is below `tolerance` of the result's standard
// uncertainty or rounding stops it. Adv. Eng. Software 4 (1982) 75. Throws std::runtime_error if the
// function has no answer at a point near 0.
LinearAnswer linear_answer(const BatchFunction& function, const std::vector<UncertainInput>& inputs,
                           double tolerance = 1e-6);

// Standard uncertainty of each result, and the share of each input in its variance (results x inputs;
// 0 where there is no variance).
Eigen::VectorXd standard_uncertainty(const LinearAnswer& answer);
Eigen::MatrixXd variance_shares(const LinearAnswer& answer,
                                const std::vector<UncertainInput>& inputs);

// 95 % intervals of the linear answer: from the normal distribution if all inputs are normal, from
// quantiles of a Sobol' sequence of 2^14 points otherwise.
std::vector<Interval> intervals_95(const LinearAnswer& answer,
                                   const std::vector<UncertainInput>& inputs);

}  // namespace viscard
