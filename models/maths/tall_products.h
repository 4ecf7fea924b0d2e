#pragma once

#include <Eigen/Core>

#include <span>

namespace viscard {

// Products of columns with many rows, as sums in several lanes at memory speed.

double dot_of(std::span<const double> a, std::span<const double> b);  // equal length

// A^T B and A^T A of tall matrices, computed as long dot products. Faster than general matrix
// products for few columns (up to some hundred) and many rows.
Eigen::MatrixXd transposed_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
Eigen::MatrixXd gram_of(const Eigen::MatrixXd& columns);

}  // namespace viscard
