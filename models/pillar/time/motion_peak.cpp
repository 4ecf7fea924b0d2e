#include "models/pillar/time/motion_peak.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

// The cubic with given values and rates at the ends of [0, h].
struct HermiteCubic {
  double h, y0, slope, second, third;  // coefficients of powers of x/h

  HermiteCubic(double length, double from, double to, double rate_from, double rate_to)
      : h(length),
        y0(from),
        slope(h * rate_from),
        second(3.0 * (to - from) - h * (2.0 * rate_from + rate_to)),
        third(h * (rate_from + rate_to) - 2.0 * (to - from)) {}
  double at(double x) const { return y0 + x * (slope + x * (second + x * third)); }
};

struct CubicExtreme {
  double value = 0.0, time_s = 0.0;
};

// Of a stretch between two known times.
struct CubicStretch {
  CubicExtreme low, high;
  double error = 0.0;
};

class SampledMotion {
 public:
  SampledMotion(const std::vector<double>& time_s, const Eigen::VectorXd& values,
                const Eigen::VectorXd& rates)
      : t_(time_s), y_(values), rate_(rates) {}

  std::vector<CubicStretch> stretches() const {
    std::vector<CubicStretch> all;
    for (std::size_t i = 0; i + 1 < t_.size(); ++i) {
      if (!(t_[i + 1] > t_[i])) continue;
      all.push_back(extremes(i));
      all.back().error = std::max(error_over(i, i), error_over(i, i + 1));
    }
    return all;
  }

 private:
  HermiteCubic cubic(std::size_t from, std::size_t to) const {
    const auto a = static_cast<Eigen::Index>(from);
    const auto b = static_cast<Eigen::Index>(to);
    return {t_[to] - t_[from], y_[a], y_[b], rate_[a], rate_[b]};
  }
  CubicStretch extremes(std::size_t i) const {
    const HermiteCubic c = cubic(i, i + 1);
    const CubicExtreme first{c.y0, t_[i]};
    CubicStretch s{first, first};
    const auto take = [&](double x) {
      const CubicExtreme one{c.at(x), t_[i] + x * c.h};
      if (one.value < s.low.value) s.low = one;
      if (one.value > s.high.value) s.high = one;
    };
    take(1.0);
    const double root = c.second * c.second - 3.0 * c.third * c.slope;
    if (root < 0.0) return s;
    // Roots of slope + 2 second x + 3 third x^2 without cancellation.
    const double q = -(c.second + std::copysign(std::sqrt(root), c.second));
    for (const double x : {q / (3.0 * c.third), c.slope / q}) {
      if (x > 0.0 && x < 1.0) take(x);
    }
    return s;
  }
  // Error of the interpolation between i and i + 1, estimated at the point `end`: the cubic over
  // both its neighbours deviates there by a^2 b^2 y''''/24. Four times the resulting error is used,
  // because y'''' varies.
  double error_over(std::size_t i, std::size_t end) const {
    if (end == 0 || end + 1 == t_.size()) return 0.0;
    const HermiteCubic over = cubic(end - 1, end + 1);
    const double a = t_[end] - t_[end - 1];
    const double b = t_[end + 1] - t_[end];
    const double h = t_[i + 1] - t_[i];
    if (!(a > 0.0 && b > 0.0)) return 0.0;
    const double missed = std::abs(over.at(a / (a + b)) - y_[static_cast<Eigen::Index>(end)]);
    return std::min(1.0, 4.0 * std::pow(h * h / (4.0 * a * b), 2)) * missed;
  }

  const std::vector<double>& t_;
  const Eigen::VectorXd& y_;
  const Eigen::VectorXd& rate_;
};

}  // namespace

MotionPeak peak_of_motion(const std::vector<double>& time_s, const Eigen::VectorXd& values,
                          const Eigen::VectorXd& rates) {
  constexpr double kEqual = 0.02;
  const std::vector<CubicStretch> all = SampledMotion(time_s, values, rates).stretches();
  const auto size_of = [](const CubicStretch& s) { return std::max(-s.low.value, s.high.value); };
  double size = 0.0;
  for (const CubicStretch& s : all) size = std::max(size, size_of(s));
  const auto first = std::find_if(all.begin(), all.end(), [&](const CubicStretch& s) {
    return size_of(s) >= (1.0 - kEqual) * size;
  });
  if (size == 0.0 || first == all.end()) return {};
  const double sign = -first->low.value > first->high.value ? -1.0 : 1.0;
  MotionPeak peak;
  double possible = 0.0;
  for (const CubicStretch& s : all) {
    const CubicExtreme& own = sign < 0.0 ? s.low : s.high;
    if (sign * own.value > sign * peak.value) peak = {own.value, own.time_s};
    possible = std::max(possible, sign * own.value + s.error);
  }
  peak.error = possible - sign * peak.value;
  return peak;
}

}  // namespace viscard
