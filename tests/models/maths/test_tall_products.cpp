#include "models/maths/tall_products.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstddef>

using namespace viscard;

namespace {

// Columns of different sizes and signs without a pattern that divides the lanes.
Eigen::MatrixXd columns_of(Eigen::Index rows, Eigen::Index columns, double phase) {
  Eigen::MatrixXd matrix(rows, columns);
  for (Eigen::Index j = 0; j < columns; ++j) {
    for (Eigen::Index i = 0; i < rows; ++i) {
      const auto at = static_cast<double>(i + 1) * static_cast<double>(j + 1);
      matrix(i, j) = std::sin(0.7 * at + phase) * std::pow(10.0, static_cast<double>(j % 3));
    }
  }
  return matrix;
}

}  // namespace

TEST_CASE("products of tall matrices equal Eigen's for any number of rows and columns",
          "[models]") {
  for (const Eigen::Index rows : {0, 1, 3, 4, 5, 16, 33, 1001}) {
    for (const Eigen::Index columns : {1, 2, 3, 4, 7, 10}) {
      const Eigen::MatrixXd a = columns_of(rows, columns, 0.0);
      const Eigen::MatrixXd b = columns_of(rows, 5, 1.0);
      const double size = 1.0 + a.norm() * (a.norm() + b.norm());
      CHECK((transposed_product(a, b) - a.transpose() * b).norm() < 1e-14 * size);
      CHECK((gram_of(a) - a.transpose() * a).norm() < 1e-14 * size);
      CHECK(gram_of(a) == gram_of(a).transpose());
      const std::span<const double> first{a.data(), static_cast<std::size_t>(rows)};
      CHECK(std::abs(dot_of(first, first) - a.col(0).squaredNorm()) < 1e-14 * size);
    }
  }
}
