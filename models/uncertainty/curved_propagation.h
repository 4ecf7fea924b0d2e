#pragma once

#include "models/maths/interval.h"
#include "models/uncertainty/linear_propagation.h"

#include <Eigen/Core>

#include <vector>

namespace viscard {

// A result, or the logarithm of its magnitude, as a quadratic function of the standard deviates without mixed terms:
//   y(z) = y(0) + sum_d (a_d z_d + b_d z_d^2),
// from the linear answer and from what it found with each input at either end of its interval.
// The logarithm of a product of powers of lognormal inputs is linear. Source of propagation to second order:
// JCGM 100:2008 (GUM), 5.1.2, note.
struct CurvedAnswer {
  std::vector<bool> is_logarithm;      // of each result
  Eigen::VectorXd start;               // y(0)
  Eigen::VectorXd sign;                // of the result whose logarithm is taken
  Eigen::MatrixXd a, b;                // results x deviates
  std::vector<Interval> intervals_95;  // of the results
  Eigen::VectorXd deviation;           // their standard uncertainty
  Eigen::MatrixXd shares;              // of the inputs in the variance of y (results x inputs)
  Eigen::VectorXd
      disagreement;           // with the function at the points below, in the unit of each result
  std::size_t n_answers = 0;  // the work beyond the linear answer
};

// Of the two forms each result gets the one that agrees better with the function: at the ends of the intervals of the
// linear answer, where several inputs change, and at points of another Sobol' sequence that nothing was fitted to.
// Results of which the function lacks an answer there disagree without limit.
CurvedAnswer curved_answer(const BatchFunction& function, const std::vector<UncertainInput>& inputs,
                           const LinearAnswer& linear);

}  // namespace viscard
