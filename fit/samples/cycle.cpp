#include "fit/samples/cycle.h"

#include "fit/samples/sample_passes.h"
#include "models/maths/dense.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace viscard {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr std::size_t kMostMeans = 4096;

// The record, or means of so many consecutive samples that few remain.
struct EvenSeries {
  VectorXd time_s, value;
  double length_s = 0.0;
};

EvenSeries series_of(std::span<const double> time_s, std::span<const double> values) {
  const std::size_t size = 1 + (values.size() - 1) / kMostMeans;
  const auto n = static_cast<Index>(values.size() / size);
  EvenSeries series{VectorXd(n), VectorXd(n), time_s.back() - time_s.front()};
  for (Index k = 0; k < n; ++k) {
    const std::size_t begin = static_cast<std::size_t>(k) * size;
    series.time_s[k] = sum_of(time_s.subspan(begin, size)) / static_cast<double>(size);
    series.value[k] = sum_of(values.subspan(begin, size)) / static_cast<double>(size);
  }
  return series;
}

// Orthonormal columns that follow any smooth curve in log time.
Eigen::MatrixXd smooth_basis(const VectorXd& time_s) {
  constexpr double kPerDecade = 1.5, kLongest = 10.0;
  const double first_s = time_s[0], length_s = time_s[time_s.size() - 1] - first_s;
  const double step_s = length_s / static_cast<double>(time_s.size() - 1);
  std::vector<VectorXd> columns{VectorXd::Ones(time_s.size()),
                                (time_s.array() - first_s).matrix() / length_s};
  for (double tau_s = step_s; tau_s < kLongest * length_s;
       tau_s *= std::pow(10.0, 1.0 / kPerDecade)) {
    columns.emplace_back((-(time_s.array() - first_s) / tau_s).exp().matrix());
  }
  Eigen::MatrixXd matrix(time_s.size(), static_cast<Index>(columns.size()));
  for (std::size_t j = 0; j < columns.size(); ++j) {
    matrix.col(static_cast<Index>(j)) = columns[j].normalized();
  }
  return PivotedQr(matrix).basis();
}

// What a cosine and a sine of one frequency, beside the smooth columns, take from the residual.
class Spectrum {
 public:
  Spectrum(const EvenSeries& series, const Eigen::MatrixXd& basis)
      : series_(series), basis_(basis) {}

  Cycle best_at(double frequency_Hz, const VectorXd& residual, double* gain) const {
    const double w = 2.0 * std::numbers::pi * frequency_Hz;
    Eigen::MatrixXd pair(series_.time_s.size(), 2);
    pair.col(0) = (w * series_.time_s.array()).cos().matrix();
    pair.col(1) = (w * series_.time_s.array()).sin().matrix();
    const Eigen::MatrixXd seen = basis_.transpose() * pair;
    const Eigen::Matrix2d normal = pair.transpose() * pair - seen.transpose() * seen;
    const Eigen::Vector2d right = pair.transpose() * residual;
    const double determinant = normal(0, 0) * normal(1, 1) - normal(0, 1) * normal(1, 0);
    constexpr double kSeen = 1e-3;  // a cycle that the smooth curve follows is none
    const auto n = static_cast<double>(series_.time_s.size());
    *gain = 0.0;
    if (!(determinant > kSeen * n * n)) return {};
    const double a = (normal(1, 1) * right[0] - normal(0, 1) * right[1]) / determinant;
    const double b = (normal(0, 0) * right[1] - normal(0, 1) * right[0]) / determinant;
    *gain = a * right[0] + b * right[1];
    return {frequency_Hz, a, b};
  }

  // The frequency that takes most, near a tenth of a line's width.
  Cycle best(const VectorXd& residual, double* gain) const {
    constexpr double kFewestPeriods = 2.5, kPerLine = 0.5, kSlow = 12.0;
    constexpr int kSteps = 30;
    const double line_Hz = 1.0 / series_.length_s;
    const auto n = series_.time_s.size();
    const double last_Hz = 0.5 * static_cast<double>(n - 1) * line_Hz;
    Cycle found;
    *gain = 0.0;
    for (double f_Hz = kFewestPeriods * line_Hz; f_Hz < last_Hz; f_Hz += kPerLine * line_Hz) {
      // The smooth columns matter for slow cycles only.
      double one = 0.0;
      if (f_Hz < kSlow * line_Hz) {
        best_at(f_Hz, residual, &one);
      } else {
        one = plain_gain(f_Hz, residual);
      }
      if (one <= *gain) continue;
      *gain = one;
      found.frequency_Hz = f_Hz;
    }
    if (!(*gain > 0.0)) return {};
    double low_Hz = found.frequency_Hz - kPerLine * line_Hz;
    double high_Hz = found.frequency_Hz + kPerLine * line_Hz;
    for (int step = 0; step < kSteps; ++step) {  // ternary search
      const double a_Hz = low_Hz + (high_Hz - low_Hz) / 3.0,
                   b_Hz = high_Hz - (high_Hz - low_Hz) / 3.0;
      double at_a = 0.0, at_b = 0.0;
      best_at(a_Hz, residual, &at_a);
      best_at(b_Hz, residual, &at_b);
      (at_a < at_b ? low_Hz : high_Hz) = at_a < at_b ? a_Hz : b_Hz;
    }
    return best_at(0.5 * (low_Hz + high_Hz), residual, gain);
  }

  VectorXd without(const Cycle& cycle, const VectorXd& residual) const {
    VectorXd left = residual;
    for (Index i = 0; i < left.size(); ++i) left[i] -= cycle.at(series_.time_s[i]);
    return left - basis_ * (basis_.transpose() * left);
  }

 private:
  // By a rotating pointer, for even times.
  double plain_gain(double frequency_Hz, const VectorXd& residual) const {
    const auto n = residual.size();
    const double step_s = (series_.time_s[n - 1] - series_.time_s[0]) / static_cast<double>(n - 1);
    const double w = 2.0 * std::numbers::pi * frequency_Hz * step_s;
    const double turn_c = std::cos(w), turn_s = std::sin(w);
    double c = 1.0, s = 0.0, sum_c = 0.0, sum_s = 0.0;
    for (Index i = 0; i < n; ++i) {
      sum_c += c * residual[i];
      sum_s += s * residual[i];
      const double next = c * turn_c - s * turn_s;
      s = c * turn_s + s * turn_c;
      c = next;
    }
    return 2.0 * (sum_c * sum_c + sum_s * sum_s) / static_cast<double>(n);
  }

  const EvenSeries& series_;
  const Eigen::MatrixXd& basis_;
};

}  // namespace

double Cycle::amplitude() const {
  return std::hypot(cosine, sine);
}

double Cycle::at(double time_s) const {
  const double phase = 2.0 * std::numbers::pi * frequency_Hz * time_s;
  return cosine * std::cos(phase) + sine * std::sin(phase);
}

std::optional<Cycle> find_cycle(std::span<const double> time_s, std::span<const double> values) {
  constexpr std::size_t kFewest = 100;
  constexpr double kLeastShare = 0.1, kTimesNext = 10.0, kUneven = 3.0;
  if (time_s.size() < kFewest) return std::nullopt;
  const StepRange steps = step_range(time_s);
  const double usual_s = (time_s.back() - time_s.front()) / static_cast<double>(time_s.size() - 1);
  // A few rows may be missing.
  if (!(steps.shortest > 0.3 * usual_s) || steps.longest > 100.0 * usual_s ||
      usual_s > kUneven * steps.shortest) {
    return std::nullopt;
  }
  const EvenSeries series = series_of(time_s, values);
  const Eigen::MatrixXd basis = smooth_basis(series.time_s);
  const VectorXd residual = series.value - basis * (basis.transpose() * series.value);
  const Spectrum spectrum(series, basis);
  double gain = 0.0, next = 0.0;
  const Cycle cycle = spectrum.best(residual, &gain);
  if (!(gain > kLeastShare * residual.squaredNorm())) return std::nullopt;
  spectrum.best(spectrum.without(cycle, residual), &next);
  if (!(gain > kTimesNext * next)) return std::nullopt;
  return cycle;
}

}  // namespace viscard
