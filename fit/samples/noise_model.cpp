#include "fit/samples/noise_model.h"

#include "fit/samples/median.h"
#include "fit/samples/sample_passes.h"
#include "models/maths/dense.h"

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

}  // namespace

Autoregression autoregression(const Eigen::VectorXd& series) {
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
    const std::vector<double> old = phi;
    for (std::size_t k = 1; k < order; ++k) phi[k - 1] -= reflection * old[order - k - 1];
    phi.push_back(reflection);
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
  if (phi.empty()) return 1.0;
  const std::vector<double> rho = autocorrelation();
  double explained = 0.0;
  double sum = 0.0;
  for (std::size_t k = 0; k < phi.size(); ++k) {
    explained += phi[k] * rho[k + 1];
    sum += phi[k];
  }
  return std::max(1.0, (1.0 - explained) / ((1.0 - sum) * (1.0 - sum)));
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
