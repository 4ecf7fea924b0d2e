#pragma once

#include "models/uncertainty/uncertain_input.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace viscard {

// One polynomial of degree 1 or 2 in the deviates: of one (second = -1), its square (second = first), or
// the product of two. Each has mean 0 and variance 1, and all are uncorrelated.
struct PolynomialTerm {
  Eigen::Index first = 0, second = -1;            // deviates
  std::size_t first_input = 0, second_input = 0;  // that they belong to
};

// A polynomial chaos expansion: the variance of a sum of terms is the sum of the squares of their
// coefficients. Xiu & Karniadakis, SIAM J. Sci. Comput. 24 (2002) 619.
struct SamplePolynomial {
  std::vector<PolynomialTerm> terms;
  Eigen::MatrixXd coefficients;   // terms x results
  Eigen::VectorXd mean;           // of each result
  std::vector<bool> are_uniform;  // the deviates
};

// Least squares over the points that have an answer. Terms of degree 2 are left out, products first, if
// there are fewer than four points for each term.
SamplePolynomial fitted_polynomial(const Eigen::MatrixXd& points, const Eigen::MatrixXd& answers,
                                   const std::vector<UncertainInput>& inputs);

// Values about the mean: points x results.
Eigen::MatrixXd values_of(const SamplePolynomial& polynomial, const Eigen::MatrixXd& points);

}  // namespace viscard
