#pragma once

#include <Eigen/Core>

#include <vector>

namespace viscard {

// Minimises |A x - y|^2 with x_j >= 0 for every j that is not free, from the normal equations
// gram = A^T A, right = A^T y. Active-set method of Lawson & Hanson, Solving Least Squares Problems
// (1974), ch. 23, in the normal-equation form of Bro & de Jong, J. Chemometrics 11 (1997) 393.
// Accurate to about the square root of the rounding unit: a start, or a choice of active columns,
// for least_squares_with_signs().
Eigen::VectorXd nonnegative_from_normal_equations(const Eigen::MatrixXd& gram,
                                                  const Eigen::VectorXd& right,
                                                  const std::vector<bool>& is_free);

// The same from A itself by QR of scaled columns, to full accuracy. Columns held at zero come back
// as exact zeros.
Eigen::VectorXd least_squares_with_signs(const Eigen::MatrixXd& columns,
                                         const Eigen::VectorXd& data,
                                         const std::vector<bool>& is_free);

}  // namespace viscard
