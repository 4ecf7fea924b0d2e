#include "fit/samples/median.h"
#include "fit/samples/noise_model.h"
#include "models/maths/course.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace viscard {
namespace {

using Index = Eigen::Index;

// The fitted force in contact.
Course force_in_contact(const StageResidual& left) {
  Course force_N;
  for (std::size_t i = 0; i < left.time_s.size(); ++i) {
    if (left.is_out_of_contact[i]) continue;
    force_N.push_back({left.time_s[i], left.fitted_N[static_cast<Index>(i)]});
  }
  return force_N;
}

// Mean square of F(t + d) - F(t) for normal d, by three-point Gauss-Hermite quadrature.
Eigen::VectorXd squares_of_stamps(const StageResidual& left, const Course& curve, double stamp_s) {
  const double reach_s = std::sqrt(3.0) * stamp_s;
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(left.fitted_N.size());
  for (std::size_t i = 0; i < left.time_s.size(); ++i) {
    if (left.is_out_of_contact[i]) continue;
    const double here_N = left.fitted_N[static_cast<Index>(i)];
    const double later_N = value_at(curve, left.time_s[i] + reach_s) - here_N;
    const double earlier_N =
        value_at(curve, std::max(left.time_s[i] - reach_s, curve.front().time_s)) - here_N;
    squares[static_cast<Index>(i)] = (later_N * later_N + earlier_N * earlier_N) / 6.0;
  }
  return squares;
}

// Root mean square residuals at rest and in motion, without scatter of the stamps.
StageNoise plain_noise(const StageResidual& left) {
  double sums[2] = {0.0, 0.0};
  double counts[2] = {0.0, 0.0};
  for (Index i = 0; i < left.residual_N.size(); ++i) {
    const std::size_t kind = left.is_moving[static_cast<std::size_t>(i)] ? 1 : 0;
    sums[kind] += left.residual_N[i] * left.residual_N[i];
    counts[kind] += 1.0;
  }
  StageNoise noise;
  noise.resting_N = std::sqrt(sums[0] / std::max(1.0, counts[0]));
  // A few samples in motion give no reliable estimate.
  noise.moving_N = counts[1] > 10.0 ? std::sqrt(sums[1] / counts[1]) : noise.resting_N;
  noise.moving_N = std::max(noise.moving_N, noise.resting_N);
  return noise;
}

// RMS residual of the readings that even the largest scatter of the stamps would not change.
double quiet_N(const StageResidual& left, const Eigen::VectorXd& largest_squares, double usual_N) {
  constexpr double kNothing = 1e-2;  // share of the variance
  double sum = 0.0, count = 0.0;
  for (Index i = 0; i < left.residual_N.size(); ++i) {
    if (left.is_moving[static_cast<std::size_t>(i)]) continue;
    if (largest_squares[i] > kNothing * usual_N * usual_N) continue;
    sum += left.residual_N[i] * left.residual_N[i];
    count += 1.0;
  }
  return count > 10.0 ? std::sqrt(sum / count) : usual_N;
}

// Standard deviation from the median, which a few outliers do not change.
double usual_size(const Eigen::VectorXd& residual) {
  std::vector<double> sizes;
  for (const double one : residual) sizes.push_back(std::abs(one));
  return median(std::move(sizes)) / kMedianOfNormal;
}

// Log likelihood up to a constant, at the best of a series of shaking amplitudes (which it sets).
double log_likelihood(const StageResidual& left, const Eigen::VectorXd& squares,
                      StageNoise& noise) {
  constexpr int kSizes = 16;
  constexpr double kRatio = 1.3;
  double best = -std::numeric_limits<double>::infinity();
  double shaking_N = noise.resting_N;
  for (int k = 0; k < kSizes; ++k, shaking_N *= kRatio) {
    double sum = 0.0;
    for (Index i = 0; i < squares.size(); ++i) {
      const double own_N =
          left.is_moving[static_cast<std::size_t>(i)] ? shaking_N : noise.resting_N;
      const double variance = own_N * own_N + squares[i];
      sum -= 0.5 * (std::log(variance) + left.residual_N[i] * left.residual_N[i] / variance);
    }
    if (sum <= best) continue;
    best = sum;
    noise.moving_N = shaking_N;
  }
  return best;
}

}  // namespace

StageNoise stage_noise(const StageResidual& left) {
  StageNoise plain = plain_noise(left);
  const Course curve = force_in_contact(left);
  const double usual_N = usual_size(left.residual_N);
  if (curve.empty() || !(usual_N > 0.0)) return plain;
  constexpr double kShortest_s = 1e-4, kRatio = 1.25, kEnough = 6.0;
  constexpr int kScatters = 29;  // up to 52 ms
  const double longest_s = kShortest_s * std::pow(kRatio, kScatters - 1);
  StageNoise noise;
  noise.resting_N = quiet_N(left, squares_of_stamps(left, curve, longest_s), usual_N);
  const auto likelihood_at = [&](double stamp_s) {
    return log_likelihood(left, squares_of_stamps(left, curve, stamp_s), noise);
  };
  const double without = likelihood_at(0.0);
  double best = without;
  for (int k = 0; k < kScatters; ++k) {
    const double stamp_s = kShortest_s * std::pow(kRatio, k);
    const double value = likelihood_at(stamp_s);
    if (value <= best) continue;
    best = value;
    noise.stamp_s = stamp_s;
  }
  if (best < without + kEnough) return plain;
  const Eigen::VectorXd squares = squares_of_stamps(left, curve, noise.stamp_s);
  log_likelihood(left, squares, noise);  // sets the shaking that belongs to this scatter
  noise.of_stamps_N = squares.cwiseSqrt();
  return noise;
}

}  // namespace viscard
