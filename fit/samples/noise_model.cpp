#include "fit/samples/noise_model.h"

#include "fit/samples/median.h"
#include "models/maths/dense.h"
#include "models/maths/tall_products.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {

namespace {

std::vector<double> autocovariances(const Eigen::VectorXd& series, std::size_t max_lag) {
  const Eigen::VectorXd centred = series.array() - series.mean();
  std::vector<double> covariances;
  for (std::size_t lag = 0; lag <= max_lag; ++lag) {
    const std::size_t count = static_cast<std::size_t>(series.size()) - lag;
    const double sum = dot_of({centred.data(), count}, {centred.data() + lag, count});
    covariances.push_back(sum / static_cast<double>(series.size()));
  }
  return covariances;
}

// phi of order p + 1 from those of order p and the next reflection coefficient.
void add_order(std::vector<double>& phi, double reflection) {
  const std::vector<double> old = phi;
  for (std::size_t k = 0; k < phi.size(); ++k) phi[k] -= reflection * old[old.size() - 1 - k];
  phi.push_back(reflection);
}

// Orders up to 12 from the autocovariances by Levinson's recursion, selected by BIC: quick, and
// white noise gets order 0.
Autoregression short_memory(const Eigen::VectorXd& series) {
  constexpr std::size_t kMaxOrder = 12;
  const auto count = static_cast<double>(series.size());
  const auto max_order = std::min(kMaxOrder, static_cast<std::size_t>(count / 10.0));
  Autoregression best;
  if (max_order < 1) return best;
  const std::vector<double> gamma = autocovariances(series, max_order);
  if (!(gamma[0] > 0.0)) return best;
  double best_score = 0.0;  // BIC relative to white noise
  std::vector<double> phi;
  double error = gamma[0];
  for (std::size_t order = 1; order <= max_order; ++order) {
    double reflection = gamma[order];
    for (std::size_t k = 1; k < order; ++k) reflection -= phi[k - 1] * gamma[order - k];
    reflection /= error;
    add_order(phi, reflection);
    error *= 1.0 - reflection * reflection;
    if (!(error > 0.0)) break;
    const double score =
        count * std::log(error / gamma[0]) + static_cast<double>(order) * std::log(count);
    if (score < best_score) {
      best_score = score;
      best.phi = phi;
    }
  }
  return best;
}

// Orders up to 80 by Burg's recursion, selected by AICc. BIC prefers few orders and thereby loses
// the many small coefficients of a long memory, which add up.
Autoregression long_memory(const Eigen::VectorXd& series) {
  constexpr Eigen::Index kMaxOrder = 80;
  constexpr std::size_t kInVain = 40;  // orders without a better score
  const auto count = static_cast<double>(series.size());
  const Eigen::Index max_order = std::min(kMaxOrder, series.size() / 10);
  Eigen::VectorXd forward = series.array() - series.mean();
  Eigen::VectorXd backward = forward;
  Autoregression best;
  std::vector<double> phi;
  double log_error = 0.0, best_score = 0.0;
  for (Eigen::Index order = 1; order <= max_order; ++order) {
    const Eigen::Index left = series.size() - order;
    double* ahead = forward.data() + order;  // ahead[i] and behind[i] are `order` samples apart
    double* behind = backward.data();
    const auto n_left = static_cast<std::size_t>(left);
    const double square =
        dot_of({ahead, n_left}, {ahead, n_left}) + dot_of({behind, n_left}, {behind, n_left});
    if (!(square > 0.0)) break;
    const double reflection = 2.0 * dot_of({ahead, n_left}, {behind, n_left}) / square;
    if (!(std::abs(reflection) < 1.0)) break;
    add_order(phi, reflection);
    for (Eigen::Index i = 0; i < left; ++i) {
      const double before = ahead[i];
      ahead[i] -= reflection * behind[i];
      behind[i] -= reflection * before;
    }
    log_error += std::log1p(-reflection * reflection);
    const auto p = static_cast<double>(order);
    const double score = count * log_error + 2.0 * p * count / (count - p - 2.0);
    if (score < best_score) {
      best_score = score;
      best.phi = phi;
    }
    if (phi.size() > best.phi.size() + kInVain) break;
  }
  return best;
}

// True if means of many samples scatter more than those of white noise.
bool has_slow_part(const Eigen::VectorXd& series) {
  constexpr Eigen::Index kFewest = 16, kMeans = 64;
  const Eigen::Index length = std::max(kFewest, series.size() / kMeans);
  const Eigen::Index n_means = series.size() / length;
  if (n_means < 8) return false;
  const double mean = series.mean();
  const double variance = (series.array() - mean).square().mean();
  double square = 0.0;
  for (Eigen::Index i = 0; i < n_means; ++i) {
    square +=
        std::pow(series.segment(i * length, length).sum() - static_cast<double>(length) * mean, 2);
  }
  const auto freedom = static_cast<double>(n_means - 1);
  constexpr double kDeviations = 3.0;
  return square > static_cast<double>(length) * variance *
                      (freedom + kDeviations * std::sqrt(2.0 * freedom));
}

// Means of 2, 4, 8 ... samples.
Eigen::VectorXd means_of(const Eigen::VectorXd& series, Eigen::Index length) {
  const Eigen::Index count = series.size() / length;
  return series.head(count * length).reshaped(length, count).colwise().mean().transpose();
}

// Slow noise needs many small coefficients, which no criterion finds, but its means of some samples
// need few. The largest estimate from such means replaces that from the samples.
void add_slow_part(const Eigen::VectorXd& series, Autoregression& noise) {
  constexpr Eigen::Index kFewestMeans = 100;
  const Eigen::VectorXd centred = series.array() - series.mean();
  const double variance = centred.squaredNorm() / static_cast<double>(series.size());
  const double of_samples = noise.inflation();
  for (Eigen::Index length = 2; series.size() / length >= kFewestMeans; length *= 2) {
    const Eigen::VectorXd means = means_of(centred, length);
    const Autoregression coarse = long_memory(means);
    const auto size = static_cast<double>(length);
    const double share = size * means.squaredNorm() / static_cast<double>(means.size()) / variance;
    noise.slow_factor = std::max(noise.slow_factor, share * coarse.inflation() / of_samples);
    if (coarse.phi.empty()) break;
    noise.slow_memory = std::max(noise.slow_memory, size * coarse.memory());
  }
}

}  // namespace

Autoregression autoregression(const Eigen::VectorXd& series) {
  Autoregression quick = short_memory(series);
  if (quick.phi.empty() && !has_slow_part(series)) return quick;
  Autoregression noise = long_memory(series);
  if (noise.phi.empty()) noise = quick;
  add_slow_part(series, noise);
  return noise;
}

std::vector<double> Autoregression::autocorrelation() const {
  const std::size_t order = phi.size();
  if (order == 0) return {1.0};
  // rho_1 ... rho_p from the Yule-Walker equations, later lags from the recursion itself.
  const auto size = static_cast<Eigen::Index>(order);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(size, size);
  Eigen::VectorXd right(size);
  for (Eigen::Index lag = 1; lag <= size; ++lag) {
    right[lag - 1] = phi[static_cast<std::size_t>(lag - 1)];
    for (Eigen::Index k = 1; k <= size; ++k) {
      const Eigen::Index other = std::abs(lag - k);
      if (other > 0) matrix(lag - 1, other - 1) -= phi[static_cast<std::size_t>(k - 1)];
    }
  }
  const Eigen::VectorXd first = LuFactor(matrix).solve(right);
  std::vector<double> rho{1.0};
  rho.insert(rho.end(), first.begin(), first.end());
  constexpr double kDiedAway = 1e-4;
  constexpr std::size_t kLongest = 100000;
  std::size_t quiet = 0;
  while (quiet < order + 1 && rho.size() < kLongest) {
    double next = 0.0;
    for (std::size_t k = 1; k <= order; ++k) next += phi[k - 1] * rho[rho.size() - k];
    rho.push_back(next);
    quiet = std::abs(next) < kDiedAway ? quiet + 1 : 0;
  }
  return rho;
}

double Autoregression::inflation() const {
  if (phi.empty()) return slow_factor;
  const std::vector<double> rho = autocorrelation();
  double explained = 0.0;
  double sum = 0.0;
  for (std::size_t k = 0; k < phi.size(); ++k) {
    explained += phi[k] * rho[k + 1];
    sum += phi[k];
  }
  return std::max(1.0, slow_factor * (1.0 - explained) / ((1.0 - sum) * (1.0 - sum)));
}

double Autoregression::memory() const {
  constexpr double kForgotten = 0.05;
  const std::vector<double> rho = autocorrelation();
  std::size_t lag = rho.size();
  while (lag > 1 && std::abs(rho[lag - 1]) < kForgotten) --lag;
  return std::max(slow_memory, static_cast<double>(lag));
}

PairSums::PairSums(const Autoregression& noise) : twice_summed_{0.0, 0.5} {
  const std::vector<double> rho = noise.autocorrelation();
  for (std::size_t m = 1; m < rho.size(); ++m) {
    twice_summed_.push_back(2.0 * twice_summed_[m] - twice_summed_[m - 1] + rho[m]);
  }
}

double PairSums::at(double lag) const {
  const double distance = std::abs(lag);
  const auto last = static_cast<double>(twice_summed_.size() - 1);
  if (distance <= last) return twice_summed_[static_cast<std::size_t>(distance)];
  const double slope = twice_summed_.back() - twice_summed_[twice_summed_.size() - 2];
  return twice_summed_.back() + (distance - last) * slope;
}

double PairSums::over(double p, double q, double distance) const {
  return at(distance + q) - at(distance + q - p) - at(distance) + at(distance - p);
}

double sigma_from_differences(const std::vector<double>& values) {
  if (values.size() < 5) return 0.0;
  std::vector<double> differences;
  for (std::size_t i = 3; i < values.size(); ++i) {
    differences.push_back(
        std::abs(values[i] - 3.0 * values[i - 1] + 3.0 * values[i - 2] - values[i - 3]));
  }
  // The third difference of white noise has 1 + 9 + 9 + 1 = 20 times its variance.
  return median(std::move(differences)) / (kMedianOfNormal * std::sqrt(20.0));
}

}  // namespace viscard
