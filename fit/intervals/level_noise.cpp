#include "fit/intervals/level_noise.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace viscard {
namespace {

using Index = Eigen::Index;

// Koenker's statistic of squared residuals against the squares of the values: n R^2, of a growing
// variance only.
double growth_statistic(const Eigen::VectorXd& of_value, const Eigen::VectorXd& of_residual) {
  const Eigen::VectorXd x = of_value.array() - of_value.mean();
  const Eigen::VectorXd y = of_residual.array() - of_residual.mean();
  const double together = x.dot(y), sizes = x.squaredNorm() * y.squaredNorm();
  if (together <= 0.0 || sizes <= 0.0) return 0.0;
  return static_cast<double>(of_value.size()) * together * together / sizes;
}

// a + b x, which describes the squared residuals; neither a nor b is negative. A square of normal noise
// scatters as its variance, so that each counts by 1/variance^2.
Eigen::VectorXd variance_by_level(const Eigen::VectorXd& x, const Eigen::VectorXd& square) {
  constexpr int kRounds = 20;
  constexpr double kLeast = 1e-6;  // of the mean: a value of zero may have no noise at all
  Eigen::VectorXd variance = Eigen::VectorXd::Constant(x.size(), square.mean());
  const double floor = kLeast * square.mean();
  for (int round = 0; round < kRounds; ++round) {
    const Eigen::VectorXd weight = variance.array().square().inverse();
    const double w = weight.sum(), wx = weight.dot(x), wy = weight.dot(square);
    const double wxx = weight.dot(x.cwiseAbs2()), wxy = weight.dot(x.cwiseProduct(square));
    const double spread = w * wxx - wx * wx;
    double a = spread > 0.0 ? (wxx * wy - wx * wxy) / spread : 0.0;
    double b = spread > 0.0 ? (w * wxy - wx * wy) / spread : wxy / wxx;
    if (a < 0.0) {
      a = 0.0;
      b = wxy / wxx;
    } else if (b < 0.0) {
      a = wy / w;
      b = 0.0;
    }
    variance = (a + (b * x).array()).cwiseMax(floor);
  }
  return variance;
}

}  // namespace

LevelNoise level_noise(const SpectralModel& model, const SpectralState& state, double inflation) {
  constexpr double kChance = 10.827566170662733;  // chi-square with one degree of freedom, p = 1e-3
  constexpr Index kFewestRows = 20;
  const Index n = model.n_rows();
  if (n < kFewestRows) return {};
  const std::vector<std::size_t> begins = model.row_begins();
  const Eigen::VectorXd fitted = model.fitted(state);
  Eigen::VectorXd count(n);  // samples of each row, which is sqrt(count) times their mean
  for (Index i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    count[i] = static_cast<double>(begins[at + 1] - begins[at]);
  }
  const Eigen::VectorXd square = (model.data() - fitted).cwiseAbs2();
  Eigen::VectorXd x = fitted.cwiseAbs2().cwiseQuotient(count);
  if (!(x.maxCoeff() > 0.0)) return {};
  x /= x.maxCoeff();
  if (growth_statistic(x, square) < kChance * std::max(1.0, inflation)) return {};
  const Eigen::VectorXd variance = variance_by_level(x, square);
  const double of_all = variance.dot(count) / count.sum();
  if (!(of_all > 0.0)) return {};
  LevelNoise level;
  level.row_scale = (variance / of_all).cwiseSqrt();
  level.note = "the noise grows with the value, from " + text_of(level.row_scale.minCoeff(), 2) +
               " to " + text_of(level.row_scale.maxCoeff(), 2) +
               " times its root mean square. The intervals include that; the fit still weighs all "
               "samples alike";
  return level;
}

}  // namespace viscard
