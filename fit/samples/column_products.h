#pragma once

#include "fit/samples/sample_passes.h"

#include <Eigen/Core>

namespace viscard {

// A^T B and A^T A of tall matrices, computed as long dot products. Faster than general matrix
// products for few columns (up to some hundred) and many rows.
inline Eigen::MatrixXd transposed_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd product(a.cols(), b.cols());
  if (product.size() == 0) return product;
  column_products(a.data(), static_cast<std::size_t>(a.cols()), b.data(),
                  static_cast<std::size_t>(b.cols()), static_cast<std::size_t>(a.rows()),
                  product.data());
  return product;
}

inline Eigen::MatrixXd gram_of(const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd gram(columns.cols(), columns.cols());
  if (gram.size() == 0) return gram;
  column_products(columns.data(), static_cast<std::size_t>(columns.cols()), nullptr, 0,
                  static_cast<std::size_t>(columns.rows()), gram.data());
  gram.triangularView<Eigen::StrictlyUpper>() = gram.transpose();
  return gram;
}

}  // namespace viscard
