#pragma once

#include "models/maths/interval.h"
#include "models/uncertainty/uncertain_input.h"

#include <Eigen/Core>

#include <vector>

namespace viscard {

// An answer to first order in the standard deviates.
struct LinearAnswer {
  Eigen::VectorXd value;        // with every input at its value
  Eigen::MatrixXd slope;        // results x deviates, per standard deviation
  Eigen::MatrixXd slope_error;  // estimates
  // Points where each input is at either end of its 95 % interval, and where each linear result has its
  // own ends, with the function's answers there.
  Eigen::MatrixXd ends, at_ends;
  Eigen::VectorXd disagreement;   // largest difference to those answers, for each result
  std::size_t n_answers = 0;      // the work
  std::size_t n_first_order = 0;  // of them to first order alone
  std::vector<bool> by_solver;    // of each deviate: its derivatives come from first-order answers
};

// Derivatives by Ridders' method: central differences with steps of 0.25, 0.125 ... standard deviations,
// extrapolated to 0, until the estimated error of each is below `tolerance` of the result's standard
// uncertainty or rounding stops it. Adv. Eng. Software 4 (1982) 75. Throws std::runtime_error if the
// function has no answer at a point near 0.
// `first_order` has the function's value and derivatives at 0 at a lower cost (a solver that reuses its
// solution), or is empty. Derivatives are its own, except by deviates where it has no answers or where
// its derivatives do not settle. It is not used if a value of it differs from the function's by more than a
// millionth of it and more than `value_errors`, which is empty or has the error of each value that both
// may have.
LinearAnswer linear_answer(const BatchFunction& function, const std::vector<UncertainInput>& inputs,
                           double tolerance = 1e-6, const BatchFunction& first_order = {},
                           const Eigen::VectorXd& value_errors = {});

// The same without the points `ends` and the answers there: value and derivatives alone.
LinearAnswer linear_slopes(const BatchFunction& function, const std::vector<UncertainInput>& inputs,
                           double tolerance = 1e-6, const BatchFunction& first_order = {},
                           const Eigen::VectorXd& value_errors = {});

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
