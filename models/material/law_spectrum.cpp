#include "models/material/law_spectrum.h"

#include "models/maths/require.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace viscard {
namespace {

using Index = Eigen::Index;
constexpr Index kShared = 8;  // columns that share a node

// Weights of the Lagrange polynomial through eight even nodes at x (in steps from the first).
std::array<double, kShared> lagrange(double x) {
  std::array<double, kShared> weights{};
  for (Index i = 0; i < kShared; ++i) {
    double product = 1.0;
    for (Index k = 0; k < kShared; ++k) {
      if (k == i) continue;
      product *= (x - static_cast<double>(k)) / static_cast<double>(i - k);
    }
    weights[static_cast<std::size_t>(i)] = product;
  }
  return weights;
}

// Collects the nodes of an integral over ln T in the columns of the grid.
class Collector {
 public:
  Collector(const LogGrid& grid, bool is_growth)
      : grid_(grid), is_growth_(is_growth), weights_(Eigen::VectorXd::Zero(grid.count)) {}

  void add(double ln_T, double weight) {
    const double below = grid_.ln_first - ln_T, above = ln_T - grid_.at(grid_.count - 1);
    if (below > 0.0) {  // the same viscosity w T, or the same compliance
      weights_[0] += weight * (is_growth_ ? 1.0 : std::exp(-below));
    } else if (above > 0.0) {  // the same modulus, or the same fluidity w/T
      weights_[grid_.count - 1] += weight * (is_growth_ ? std::exp(-above) : 1.0);
      if (is_growth_) beyond_ += weight * -std::expm1(-above);
    } else {
      const double place = (ln_T - grid_.ln_first) / grid_.step;
      const Index first =
          std::clamp<Index>(static_cast<Index>(place) - kShared / 2 + 1, 0, grid_.count - kShared);
      const auto shares = lagrange(place - static_cast<double>(first));
      for (Index i = 0; i < kShared; ++i) {
        weights_[first + i] += weight * shares[static_cast<std::size_t>(i)];
      }
    }
  }
  const Eigen::VectorXd& weights() const { return weights_; }
  // Weight of the nodes of a growth that is missing in the sum of the weights.
  double beyond() const { return beyond_; }

 private:
  LogGrid grid_;
  bool is_growth_;
  Eigen::VectorXd weights_;
  double beyond_ = 0.0;
};

// Step of a trapezoidal rule for a function that is analytic in a strip of this half-width: error
// exp(-2 pi 3) = 6e-9.
double step_for(double half_width) {
  return std::min(0.15, half_width / 3.0);
}

// Sum of H T^power over the points beyond one end of the grid, from the one next to the end on.
// Those of a power law are a geometric series.
double sum_beyond(const DecaySpectrum& spectrum, double ln_tau, double ln_end, double step,
                  double power) {
  constexpr double kNothing = 1e-18;
  const bool is_up = step > 0.0;
  const auto term_at = [&](int k) {
    const double ln_T = ln_end + step * k;
    return spectrum.density(ln_T - ln_tau) * std::exp(power * ln_T);
  };
  if (spectrum.shape() == DecayShape::kPowerLaw) {
    const double first = term_at(1);
    return std::abs(step) * first / (1.0 - term_at(2) / first);
  }
  double sum = 0.0;
  for (int k = 1; k < 100000; ++k) {
    const double s = ln_end + step * k - ln_tau;
    if (is_up ? s > spectrum.slowest() : s < spectrum.fastest()) break;
    const double term = term_at(k);
    sum += term;
    if (k > 4 && term < kNothing * sum) break;
  }
  return std::abs(step) * sum;
}

}  // namespace

DecaySpectrum::DecaySpectrum(DecayShape shape, double exponent, bool is_growth)
    : shape_(shape), exponent_(exponent), is_growth_(is_growth) {
  require_value(exponent >= kLeastExponent && exponent <= kMostExponent, "the exponent of a law",
                exponent, "", "between 0.02 and 0.99");
  if (shape == DecayShape::kPowerLaw) return;
  if (shape == DecayShape::kStretched) set_nodes();
  constexpr double kFarthest = -120.0;  // e^120 faster than tau: nothing is left of w T
  const double end = std::max(fastest(), kFarthest), width = step();
  for (double s = slowest(); s >= end; s -= width) samples_.push_back(density(s));
}

// ln A(phi) at phi = pi sigma(w), and d(phi)/pi. Both phi and pi - phi keep their digits. A is
// constant for w below kFlat, so that part is one node.
void DecaySpectrum::set_nodes() {
  const double b = exponent_ / (1.0 - exponent_);
  const double step = std::min(0.25, 0.5 * std::numbers::pi * (1.0 - exponent_) / 3.0);
  constexpr double kFlat = -18.0, kReach = 40.0;
  ln_A_.push_back(std::log(1.0 - exponent_) + b * std::log(exponent_));
  weight_.push_back(step * std::exp(kFlat) / std::expm1(step));  // of w below kFlat
  for (double w = kFlat; w <= kReach; w += step) {
    const double from_0 = 1.0 / (1.0 + std::exp(-w)), from_pi = 1.0 / (1.0 + std::exp(w));
    const double phi = std::numbers::pi * from_0;
    const double ln_sine = std::log(std::sin(std::numbers::pi * std::min(from_0, from_pi)));
    ln_A_.push_back(b * std::log(std::sin(exponent_ * phi)) +
                    std::log(std::sin((1.0 - exponent_) * phi)) - (b + 1.0) * ln_sine);
    weight_.push_back(step * from_0 * from_pi);
  }
}

// Mittag-Leffler: sin(alpha pi)/(2 pi (cosh(alpha s) + cos(alpha pi))). Gorenflo & Mainardi in
// Fractals and Fractional Calculus in Continuum Mechanics (1997), p. 223.
// Stretched: b <y exp(-y)>, y = A(phi) exp(b s), b = beta/(1 - beta), mean over phi in (0, pi): the
// density of the one-sided stable law of index beta. Zolotarev, One-dimensional Stable
// Distributions (1986), sect. 2.5; Kanter, Ann. Probab. 3 (1975) 697. All terms are positive.
double DecaySpectrum::density(double s) const {
  const double sine = std::sin(exponent_ * std::numbers::pi);
  if (shape_ == DecayShape::kPowerLaw) {
    return sine / std::numbers::pi * std::exp((is_growth_ ? exponent_ : -exponent_) * s);
  }
  if (shape_ == DecayShape::kMittagLeffler) {  // without cancellation near alpha = 1
    const double least = std::sin(0.5 * std::numbers::pi * (1.0 - exponent_));
    const double height = std::pow(std::sinh(0.5 * exponent_ * s), 2) + least * least;
    return sine / (4.0 * std::numbers::pi * height);
  }
  const double b = exponent_ / (1.0 - exponent_);
  // y exp(-y) vanishes outside -45 < ln y < 4.
  const auto first = std::lower_bound(ln_A_.begin(), ln_A_.end(), -45.0 - b * s);
  const auto last = std::lower_bound(first, ln_A_.end(), 4.0 - b * s);
  auto weight = weight_.begin() + (first - ln_A_.begin());
  double sum = 0.0;
  for (auto ln_A = first; ln_A != last; ++ln_A, ++weight) {
    const double y = std::exp(*ln_A + b * s);
    sum += *weight * y * std::exp(-y);
  }
  return b * sum;
}

double DecaySpectrum::step() const {
  constexpr double kHalfPi = 0.5 * std::numbers::pi;
  switch (shape_) {
    case DecayShape::kStretched:
      return step_for(kHalfPi / std::max(1.0, exponent_ / (1.0 - exponent_)));
    case DecayShape::kMittagLeffler:  // the nearest poles are at +-i pi (1 - alpha)/alpha
      return step_for(std::min(kHalfPi, 2.0 * kHalfPi * (1.0 - exponent_) / exponent_));
    case DecayShape::kPowerLaw:
      break;
  }
  return step_for(kHalfPi);
}

double DecaySpectrum::slowest() const {
  if (shape_ == DecayShape::kPowerLaw) return std::numeric_limits<double>::infinity();
  if (shape_ == DecayShape::kMittagLeffler) return 36.0 / exponent_;
  const double b = exponent_ / (1.0 - exponent_);
  const double ln_A_least = std::log(1.0 - exponent_) + b * std::log(exponent_);
  return (std::log(40.0) - ln_A_least) / b;
}

double DecaySpectrum::fastest() const {
  return shape_ == DecayShape::kPowerLaw ? -std::numeric_limits<double>::infinity()
                                         : -36.0 / exponent_;
}

LogGrid grid_for_times(double ln_t_min, double ln_t_max) {
  constexpr double kMargin = 16.0;
  LogGrid grid{ln_t_min - kMargin};
  grid.count = static_cast<Index>((ln_t_max - ln_t_min + 2.0 * kMargin) / grid.step) + 2;
  return grid;
}

Eigen::VectorXd weights_on_grid(const DecaySpectrum& spectrum, double ln_tau, const LogGrid& grid) {
  require(grid.count >= kShared, "the grid of a law needs at least eight columns");
  if (spectrum.shape() == DecayShape::kPowerLaw) {
    Eigen::VectorXd weights(grid.count);
    for (Index j = 0; j < grid.count; ++j) {
      weights[j] = grid.step * spectrum.density(grid.at(j) - ln_tau);
    }
    const double ln_first = grid.at(0), ln_last = grid.at(grid.count - 1);
    const double fast = spectrum.is_growth() ? 0.0 : 1.0, slow = spectrum.is_growth() ? -1.0 : 0.0;
    weights[0] +=
        sum_beyond(spectrum, ln_tau, ln_first, -grid.step, fast) * std::exp(-fast * ln_first);
    weights[grid.count - 1] +=
        sum_beyond(spectrum, ln_tau, ln_last, grid.step, slow) * std::exp(-slow * ln_last);
    return weights;
  }
  Collector collector(grid, spectrum.is_growth());
  const double step = spectrum.step();
  double ln_T = ln_tau + spectrum.slowest();
  for (const double density : spectrum.samples()) {
    collector.add(ln_T, step * density);
    ln_T -= step;
  }
  Eigen::VectorXd weights = collector.weights();
  // The rest of the compliance belongs to times faster than all samples.
  if (spectrum.is_growth()) weights[0] += 1.0 - (weights.sum() + collector.beyond());
  return weights;
}

CoarseSpectrum coarse_spectrum(const DecaySpectrum& spectrum, double ln_tau, const LogGrid& grid) {
  CoarseSpectrum out;
  out.weights.resize(grid.count);
  for (Index j = 0; j < grid.count; ++j) {
    out.weights[j] = grid.step * spectrum.density(grid.at(j) - ln_tau);
  }
  const double ln_last = grid.at(grid.count - 1);
  out.faster_T = sum_beyond(spectrum, ln_tau, grid.ln_first, -grid.step, 1.0);
  out.faster_T2 = sum_beyond(spectrum, ln_tau, grid.ln_first, -grid.step, 2.0);
  if (spectrum.is_growth()) {
    out.faster = sum_beyond(spectrum, ln_tau, grid.ln_first, -grid.step, 0.0);
    out.slower_per_T = sum_beyond(spectrum, ln_tau, ln_last, grid.step, -1.0);
  } else {
    out.slower = sum_beyond(spectrum, ln_tau, ln_last, grid.step, 0.0);
  }
  return out;
}

}  // namespace viscard
