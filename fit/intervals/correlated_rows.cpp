#include "fit/intervals/uncertainty.h"
#include "models/maths/grid_convolution.h"

#include <Eigen/Core>

#include <bit>
#include <cmath>
#include <cstddef>
#include <vector>

namespace viscard {
namespace {

using Index = Eigen::Index;

bool are_single_samples(const std::vector<std::size_t>& begins, Index n_rows) {
  return begins[static_cast<std::size_t>(n_rows)] - begins[0] == static_cast<std::size_t>(n_rows);
}

// C x where each row is one sample: the correlation of two rows depends on their distance alone, so that the sums over
// all pairs are a convolution, in a time of rows times the logarithm of rows whatever the memory of the noise.
Eigen::MatrixXd correlated_samples(const Eigen::MatrixXd& x, const PairSums& sums) {
  const auto size = static_cast<Index>(std::bit_ceil(static_cast<std::size_t>(x.rows())));
  Eigen::VectorXd kernel = Eigen::VectorXd::Zero(size);
  for (Index lag = 0; lag < x.rows(); ++lag) {
    const auto distance = static_cast<double>(lag);
    if (distance - 1.0 > sums.reach()) break;
    kernel[lag] = sums.over(1.0, 1.0, distance);
  }
  const GridConvolution correlation(kernel);
  Eigen::MatrixXd out(x.rows(), x.cols());
  Eigen::VectorXd column = Eigen::VectorXd::Zero(size);
  for (Index j = 0; j < x.cols(); ++j) {
    column.head(x.rows()) = x.col(j);
    out.col(j) = correlation.apply(column).col(0).head(x.rows());
  }
  return out;
}

Eigen::MatrixXd correlated_pairs(const Eigen::MatrixXd& x, const std::vector<std::size_t>& begins,
                                 const PairSums& sums) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(x.rows(), x.cols());
  for (Index r = 0; r < x.rows(); ++r) {
    const auto begin = static_cast<double>(begins[static_cast<std::size_t>(r)]);
    const auto end = static_cast<double>(begins[static_cast<std::size_t>(r) + 1]);
    for (Index s = r; s < x.rows(); ++s) {
      const auto other = static_cast<double>(begins[static_cast<std::size_t>(s)]);
      if (other - end > sums.reach()) break;
      const double count = static_cast<double>(begins[static_cast<std::size_t>(s) + 1]) - other;
      const double correlation =
          sums.over(end - begin, count, other - begin) / std::sqrt((end - begin) * count);
      out.row(r) += correlation * x.row(s);
      if (s > r) out.row(s) += correlation * x.row(r);
    }
  }
  return out;
}

}  // namespace

Eigen::MatrixXd correlated_rows(const Eigen::MatrixXd& x, const std::vector<std::size_t>& begins,
                                const Autoregression& noise) {
  // Fewer rows, or a short memory, keep the sums over pairs, whose last digits earlier results have.
  constexpr Index kMany = 8192;
  constexpr double kLongMemory = 256.0;
  const PairSums sums(noise);
  const bool is_long = x.rows() > kMany && sums.reach() > kLongMemory;
  return is_long && are_single_samples(begins, x.rows()) ? correlated_samples(x, sums)
                                                         : correlated_pairs(x, begins, sums);
}

}  // namespace viscard
