#include "models/array/layer/layer_kernel.h"

#include "models/maths/bessel_orders.h"
#include "models/maths/gauss_legendre.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace viscard {
namespace {

constexpr double kStepsPerThickness = 24.0;  // of the table over the distance
constexpr int kStencil = 6;                  // points of a polynomial between its entries
constexpr int kWaveRule = 8;                 // Gauss points per panel of k
constexpr double kPanelPhase = 6.0;          // largest distance times a panel of k
constexpr double kPanelThickness = 1.0;      // thickness times a panel of k
constexpr double kGaussOffset =
    0.5 / std::numbers::sqrt3;  // of two Gauss points from the middle, in cells

// Integral of ln(1 + b^2/s^2)/2 from 0 to s.
double log_integral_m(double s_m, double b_m) {
  const double s = std::abs(s_m);
  const double sum = s == 0.0 ? 0.0 : 0.5 * s * std::log1p((b_m / s) * (b_m / s));
  return std::copysign(sum + b_m * std::atan2(s, b_m), s_m);
}

// Integral of 1/r over the rectangle from the origin to (x, y): Love, Phil. Trans. R. Soc. A 228 (1929)
// 377.
double corner_integral_m(double x_m, double y_m) {
  if (x_m == 0.0 || y_m == 0.0) return 0.0;
  return x_m * std::asinh(y_m / std::abs(x_m)) + y_m * std::asinh(x_m / std::abs(y_m));
}

// Integral of 1/r over a square cell around (x, y).
double square_integral_m(double x_m, double y_m, double cell_m) {
  const double h = 0.5 * cell_m;
  return corner_integral_m(x_m + h, y_m + h) - corner_integral_m(x_m - h, y_m + h) -
         corner_integral_m(x_m + h, y_m - h) + corner_integral_m(x_m - h, y_m - h);
}

// Mean over a cell of a function that is smooth over it.
template <typename Function>
double cell_mean(bool is_plane, double x_m, double y_m, double cell_m, const Function& f) {
  const double d = kGaussOffset * cell_m;
  if (is_plane) return 0.5 * (f(x_m - d, 0.0) + f(x_m + d, 0.0));
  return 0.25 *
         (f(x_m - d, y_m - d) + f(x_m + d, y_m - d) + f(x_m - d, y_m + d) + f(x_m + d, y_m + d));
}

}  // namespace

double mean_of_wave(bool is_plane, double kR) {
  if (!is_plane) return disc_mean_of_wave(kR);
  return kR < 1e-8 ? 1.0 : std::sin(kR) / kR;
}

LayerKernel::LayerKernel(const LayerWaves& waves, bool is_plane, double reach_m,
                         const std::vector<Reading>& readings)
    : is_plane_(is_plane),
      reach_m_(reach_m),
      thickness_m_(waves.thickness_m()),
      reference_m_Pa_(waves.reference_m_Pa()),
      step_m_(thickness_m_ / kStepsPerThickness) {
  const auto harmonics = static_cast<Eigen::Index>(is_plane ? 1 : 3);
  const auto entries = static_cast<Eigen::Index>(std::ceil(reach_m / step_m_)) + kStencil;
  table_ =
      Eigen::MatrixXd::Zero(entries, 1 + harmonics * static_cast<Eigen::Index>(readings.size()));
  const QuadratureRule rule = gauss_legendre(kWaveRule);
  const double longest_1_m = std::min(kPanelPhase / reach_m, kPanelThickness / thickness_m_);
  const int panels = static_cast<int>(std::ceil(waves.largest_k_1_m() / longest_1_m));
  const double panel_1_m = waves.largest_k_1_m() / panels;
  Eigen::RowVectorXd amplitude(table_.cols());
  for (int panel = 0; panel < panels; ++panel) {
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const double k_1_m = panel_1_m * (panel + rule.points[q]);
      // dk/pi of both signs of k in a plane, k dk/(2 pi) otherwise.
      const double weight =
          rule.weights[q] * panel_1_m / std::numbers::pi * (is_plane ? 1.0 : 0.5 * k_1_m);
      const LayerAnswer answer = waves.at(k_1_m);
      amplitude[0] = weight * answer.sinking_m_Pa;
      for (std::size_t i = 0; i < readings.size(); ++i) {
        const double factor = weight * readings[i](k_1_m);
        const auto first = 1 + harmonics * static_cast<Eigen::Index>(i);
        for (Eigen::Index m = 0; m < harmonics; ++m) {
          const double sign = m == 1 ? -1.0 : 1.0;  // i^(2 m) of the plane wave's harmonics
          amplitude[first + m] = sign * factor * answer.reading_V_Pa[static_cast<std::size_t>(m)];
        }
      }
      for (Eigen::Index at = 0; at < entries; ++at) {
        const double phase = k_1_m * step_m_ * static_cast<double>(at);
        const double even = is_plane ? std::cos(phase) : ::j0(phase);
        table_(at, 0) += even * amplitude[0];
        if (readings.empty()) continue;
        std::array<double, 3> waves_of = {even, 0.0, 0.0};
        if (!is_plane) waves_of = {even, ::jn(2, phase), ::jn(4, phase)};
        for (Eigen::Index column = 1; column < table_.cols(); ++column) {
          table_(at, column) +=
              waves_of[static_cast<std::size_t>((column - 1) % harmonics)] * amplitude[column];
        }
      }
    }
  }
}

double LayerKernel::radial(double r_m, Eigen::Index column) const {
  const double place = std::abs(r_m) / step_m_;
  // Entries around the place; near 0 the mirror image of an even function stands in for those before it.
  const auto first = static_cast<Eigen::Index>(std::floor(place)) - (kStencil / 2 - 1);
  if (first + kStencil > table_.rows()) return 0.0;
  double sum = 0.0;
  for (int i = 0; i < kStencil; ++i) {
    double weight = 1.0;
    for (int j = 0; j < kStencil; ++j) {
      if (j != i) weight *= (place - static_cast<double>(first + j)) / (i - j);
    }
    sum += weight * table_(std::abs(first + i), column);
  }
  return sum;
}

double LayerKernel::sinking_m_Pa(double x_m, double y_m, double cell_m) const {
  const double smooth = cell_mean(is_plane_, x_m, y_m, cell_m,
                                  [&](double x, double y) { return radial(std::hypot(x, y), 0); });
  if (is_plane_) {
    const double known_m = log_integral_m(x_m + 0.5 * cell_m, thickness_m_) -
                           log_integral_m(x_m - 0.5 * cell_m, thickness_m_);
    return reference_m_Pa_ / std::numbers::pi * known_m + smooth * cell_m;
  }
  const double below = cell_mean(false, x_m, y_m, cell_m, [&](double x, double y) {
    return 1.0 / std::hypot(x, y, thickness_m_);
  });
  const double area_m2 = cell_m * cell_m;
  return reference_m_Pa_ / (2.0 * std::numbers::pi) *
             (square_integral_m(x_m, y_m, cell_m) - below * area_m2) +
         smooth * area_m2;
}

Eigen::MatrixXd LayerKernel::sinking_m_Pa(int count, double cell_m) const {
  Eigen::MatrixXd kernel(count, is_plane_ ? 1 : count);
  for (Eigen::Index j = 0; j < kernel.cols(); ++j) {
    for (Eigen::Index i = j; i < count; ++i) {
      kernel(i, j) =
          sinking_m_Pa(static_cast<double>(i) * cell_m, static_cast<double>(j) * cell_m, cell_m);
      if (i < kernel.cols()) kernel(j, i) = kernel(i, j);  // the same along both axes
    }
  }
  return kernel;
}

double LayerKernel::potential_V_N(double x_m, double y_m, std::size_t reading) const {
  const double r_m = std::hypot(x_m, y_m);
  const Eigen::Index harmonics = is_plane_ ? 1 : 3;
  const Eigen::Index first = 1 + harmonics * static_cast<Eigen::Index>(reading);
  if (is_plane_) return radial(r_m, first);
  const double c = r_m > 0.0 ? (x_m * x_m - y_m * y_m) / (r_m * r_m) : 1.0;  // cos(2 alpha)
  return radial(r_m, first) + c * radial(r_m, first + 1) +
         (2.0 * c * c - 1.0) * radial(r_m, first + 2);
}

}  // namespace viscard
