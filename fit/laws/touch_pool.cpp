#include "fit/laws/touch_pool.h"

#include "models/maths/dense.h"
#include "models/maths/golden_section.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace viscard {
namespace {

using Touches = std::vector<const RatioEstimate*>;

std::map<int, Touches> by_specimen(const std::vector<RatioEstimate>& records) {
  std::map<int, Touches> out;
  for (const RatioEstimate& one : records) out[one.specimen].push_back(&one);
  return out;
}

// The generalised mean of the touches on one specimen.
struct TouchMean {
  RatioEstimate specimen;
  double log_likelihood = 0.0;  // of the differences between the touches, but for a constant
};

TouchMean mean_of(const Touches& touches, const Spreads& spreads) {
  const RatioEstimate& first = *touches.front();
  const Eigen::Index size = first.theta.size();
  Eigen::MatrixXd weight = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(size, size);
  double twice = 0.0;
  for (const RatioEstimate* one : touches) {
    Eigen::MatrixXd variance = one->covariance;
    add_spreads(spreads, variance);
    const Cholesky factor(variance);
    // Differences from the first touch, because theta itself is large beside its error.
    const Eigen::VectorXd difference = one->theta - first.theta;
    const Eigen::VectorXd weighted = factor.solve(difference);
    weight += factor.solve(identity);
    right += weighted;
    twice += factor.log_determinant() + difference.dot(weighted);
  }
  const Cholesky pooled(weight);
  const Eigen::VectorXd shift = pooled.solve(right);
  TouchMean out{first, 0.0};
  out.specimen.theta += shift;
  out.specimen.covariance = pooled.solve(identity);
  out.log_likelihood = -0.5 * (twice + pooled.log_determinant() - right.dot(shift));
  return out;
}

}  // namespace

std::size_t kind_of_row(Eigen::Index k, Eigen::Index rows) {
  if (k == 0) return 0;
  return k <= rows / 2 ? 1 : 2;
}

void add_spreads(const Spreads& spreads, Eigen::MatrixXd& covariance) {
  for (Eigen::Index k = 0; k < covariance.rows(); ++k) {
    const double spread = spreads[kind_of_row(k, covariance.rows())];
    covariance(k, k) += spread * spread;
  }
}

Spreads touch_spreads_of(const std::vector<RatioEstimate>& records) {
  Spreads spreads{};
  std::map<int, Touches> repeated = by_specimen(records);
  std::erase_if(repeated, [](const auto& entry) { return entry.second.size() < 2; });
  if (repeated.empty()) return spreads;
  spreads = {0.02, 0.02, 0.02};
  constexpr int kSweeps = 4;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    double change = 0.0;
    for (std::size_t kind = 0; kind < spreads.size(); ++kind) {
      const double before = spreads[kind];
      spreads[kind] = best_spread([&](double spread) {
        Spreads at = spreads;
        at[kind] = spread;
        double sum = 0.0;
        for (const auto& [number, touches] : repeated) sum += mean_of(touches, at).log_likelihood;
        return sum;
      });
      change = std::max(change, std::abs(spreads[kind] - before));
    }
    if (change < 1e-4) break;
  }
  return spreads;
}

std::vector<RatioEstimate> pooled_touches(const std::vector<RatioEstimate>& records,
                                          const Spreads& touch) {
  std::vector<RatioEstimate> out;
  for (const auto& [number, touches] : by_specimen(records)) {
    if (touches.size() > 1) {
      out.push_back(mean_of(touches, touch).specimen);
      continue;
    }
    out.push_back(*touches.front());
    add_spreads(touch, out.back().covariance);
  }
  return out;
}

double best_spread(const std::function<double(double spread)>& f) {
  constexpr double kLow = -9.5, kHigh = 1.5, kStep = 1.0;  // ln of the spread
  double best = f(0.0), best_ln = -std::numeric_limits<double>::infinity();
  for (double ln = kLow; ln <= kHigh; ln += kStep) {
    const double value = f(std::exp(ln));
    if (value > best + 1e-12) {
      best = value;
      best_ln = ln;
    }
  }
  if (!std::isfinite(best_ln)) return 0.0;
  const auto lack = [&f](double ln) { return -f(std::exp(ln)); };
  return std::exp(golden_section(lack, best_ln - kStep, best_ln + kStep, 1e-4).middle());
}

}  // namespace viscard
