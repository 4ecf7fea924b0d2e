#include "models/uncertainty/sobol_points.h"

#include "models/maths/require.h"
#include "models/uncertainty/uncertain_number.h"

#include <boost/math/distributions/normal.hpp>
#include <boost/random/sobol.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace viscard {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kHalfCell = 0x1p-33;  // the sequence has 32 bits

}  // namespace

MatrixXd sobol_points(Index n_points, Index n_dimensions) {
  constexpr Index kMost = 3667;  // that Boost has direction numbers for
  require(n_dimensions >= 0 && n_dimensions <= kMost,
          "a Sobol' sequence here has at most 3667 dimensions");
  MatrixXd points(n_points, n_dimensions);
  if (n_dimensions == 0) return points;
  boost::random::sobol_engine<std::uint32_t, 32> engine(static_cast<std::size_t>(n_dimensions));
  for (Index i = 0; i < n_points; ++i) {
    for (Index d = 0; d < n_dimensions; ++d) {
      points(i, d) = static_cast<double>(engine()) * 0x1p-32 + kHalfCell;
    }
  }
  return points;
}

MatrixXd shifted(MatrixXd points, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  for (Index d = 0; d < points.cols(); ++d) {
    const double shift = static_cast<double>(random() >> 11) * 0x1p-53;
    points.col(d) = points.col(d).unaryExpr([shift](double x) {
      const double moved = x + shift;
      return std::clamp(moved < 1.0 ? moved : moved - 1.0, kHalfCell, 1.0 - kHalfCell);
    });
  }
  return points;
}

MatrixXd deviates_from(const MatrixXd& points, const std::vector<UncertainInput>& inputs) {
  const boost::math::normal_distribution<double> normal;
  MatrixXd deviates(points.rows(), points.cols());
  Index column = 0;
  for (const UncertainInput& input : inputs) {
    for (Index k = 0; k < input.n_deviates; ++k, ++column) {
      deviates.col(column) = points.col(column).unaryExpr([&](double u) {
        return input.is_uniform ? kLargestUniformDeviate * (2.0 * u - 1.0)
                                : boost::math::quantile(normal, u);
      });
    }
  }
  return deviates;
}

}  // namespace viscard
