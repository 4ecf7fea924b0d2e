#pragma once

#include "models/maths/dense.h"

#include <Eigen/Core>

#include <vector>

namespace viscard {

// Minimises |A x - y|^2 with x_j >= 0 for every j that is not free, from the normal equations gram
// = A^T A, right = A^T y. Active-set method of Lawson & Hanson, Solving Least Squares Problems
// (1974), ch. 23, in the normal-equation form of Bro & de Jong, J. Chemometrics 11 (1997) 393. The
// relative accuracy is only about the square root of the rounding unit: good enough as a start, or
// to choose the active columns for least_squares_with_signs().
Eigen::VectorXd nonnegative_from_normal_equations(const Eigen::MatrixXd& gram,
                                                  const Eigen::VectorXd& right,
                                                  const std::vector<bool>& is_free);

// The same from A itself by QR of the columns in use (Lawson & Hanson, Algorithm NNLS 23.10): for columns that are
// nearly dependent, where the normal equations lose the minimum.
Eigen::VectorXd nonnegative_by_qr(const Eigen::MatrixXd& columns, const Eigen::VectorXd& data,
                                  const std::vector<bool>& is_free);

// The same solved from A by QR of scaled columns, to full accuracy. Columns held at zero get zeros.
class SignedLeastSquares {
 public:
  SignedLeastSquares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& data,
                     const std::vector<bool>& is_free);

  const Eigen::VectorXd& x() const { return x_; }

  // Component of other vectors orthogonal to the columns in use, in rotated coordinates (one row
  // for each remaining dimension). Rotation preserves lengths and inner products.
  Eigen::MatrixXd outside(const Eigen::MatrixXd& vectors) const;

 private:
  // Solves with the columns in use; returns true if all signs are allowed.
  bool solve(const Eigen::MatrixXd& columns, const Eigen::VectorXd& data,
             const std::vector<bool>& is_free);

  std::vector<bool> in_use_;
  Eigen::VectorXd x_;
  bool is_empty_ = true;  // no column in use
  PivotedQr qr_;
};

inline Eigen::VectorXd least_squares_with_signs(const Eigen::MatrixXd& columns,
                                                const Eigen::VectorXd& data,
                                                const std::vector<bool>& is_free) {
  return SignedLeastSquares(columns, data, is_free).x();
}

}  // namespace viscard
