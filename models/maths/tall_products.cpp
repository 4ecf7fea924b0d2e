#include "models/maths/tall_products.h"

#include "models/maths/wide_loops.h"

#include <algorithm>

namespace viscard {

VISCARD_WIDE_LOOP double dot_of_samples(const double* a, const double* b, std::size_t count) {
  Lanes sums[4] = {};
  std::size_t i = 0;
  for (; i + 4 * kLanes <= count; i += 4 * kLanes) {
    for (std::size_t k = 0; k < 4; ++k) {
      sums[k] += lanes_at(a + i + k * kLanes)->lanes * lanes_at(b + i + k * kLanes)->lanes;
    }
  }
  double sum = total(sums[0]) + total(sums[1]) + total(sums[2]) + total(sums[3]);
  for (; i < count; ++i) sum += a[i] * b[i];
  return sum;
}

// Four columns by two at a time, so that each number read from memory enters several products.
VISCARD_WIDE_LOOP void products_of_4_by_2(const double* a, const double* b, std::size_t rows,
                                          std::size_t n_a, double* out) {
  Lanes sums[8] = {};
  std::size_t i = 0;
  for (; i + kLanes <= rows; i += kLanes) {
    const Lanes b0 = lanes_at(b + i)->lanes, b1 = lanes_at(b + rows + i)->lanes;
    for (std::size_t k = 0; k < 4; ++k) {
      const Lanes ak = lanes_at(a + k * rows + i)->lanes;
      sums[k] += ak * b0;
      sums[4 + k] += ak * b1;
    }
  }
  for (std::size_t k = 0; k < 4; ++k) {
    double first = total(sums[k]), second = total(sums[4 + k]);
    for (std::size_t r = i; r < rows; ++r) {
      first += a[k * rows + r] * b[r];
      second += a[k * rows + r] * b[rows + r];
    }
    out[k] = first;
    out[n_a + k] = second;
  }
}

double dot_of(std::span<const double> a, std::span<const double> b) {
  return dot_of_samples(a.data(), b.data(), a.size());
}

namespace {

// Products a_i . b_j of columns of `rows` numbers, stored one column after the other, into out[i +
// j n_a]. With is_gram (b is a): i >= j only.
void column_products(const Eigen::MatrixXd& left, const Eigen::MatrixXd& right, bool is_gram,
                     double* out) {
  const double* a = left.data();
  const double* b = right.data();
  const auto rows = static_cast<std::size_t>(left.rows());
  const auto n_a = static_cast<std::size_t>(left.cols());
  const auto n_b = static_cast<std::size_t>(right.cols());
  for (std::size_t j = 0; j < n_b; j += 2) {
    std::size_t i = is_gram ? j : 0;
    if (j + 1 < n_b) {
      for (; i + 4 <= n_a; i += 4) {
        products_of_4_by_2(a + i * rows, b + j * rows, rows, n_a, out + i + j * n_a);
      }
    }
    for (; i < n_a; ++i) {
      for (std::size_t k = j; k < std::min(j + 2, n_b); ++k) {
        out[i + k * n_a] = dot_of_samples(a + i * rows, b + k * rows, rows);
      }
    }
  }
}

}  // namespace

Eigen::MatrixXd transposed_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  Eigen::MatrixXd product(a.cols(), b.cols());
  column_products(a, b, false, product.data());
  return product;
}

Eigen::MatrixXd gram_of(const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd gram(columns.cols(), columns.cols());
  column_products(columns, columns, true, gram.data());
  gram.triangularView<Eigen::StrictlyUpper>() = gram.transpose();
  return gram;
}

}  // namespace viscard
