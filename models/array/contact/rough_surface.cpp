#include "models/array/contact/rough_surface.h"

#include "models/maths/require.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace viscard {
namespace {

// Weights reach so many correlation lengths: exp(-2 x^2) is 1.5e-8 there.
constexpr int kReach = 3;

// The finaliser of SplitMix64: Steele, Lea & Flood, OOPSLA 2014, 453. A counter-based generator: each
// place has its own number, whichever part of the surface is asked for.
std::uint64_t mixed(std::uint64_t state) {
  state += 0x9e3779b97f4a7c15ULL;
  state = (state ^ (state >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  state = (state ^ (state >> 27U)) * 0x94d049bb133111ebULL;
  return state ^ (state >> 31U);
}

// A number in (0, 1).
double uniform(std::uint64_t bits) {
  return (static_cast<double>(bits >> 11U) + 0.5) * 0x1p-53;
}

// A standard normal number of a place: Box & Muller, Ann. Math. Stat. 29 (1958) 610.
double normal_at(std::uint64_t seed, std::int64_t i, std::int64_t j) {
  std::uint64_t bits = mixed(seed);
  bits = mixed(bits ^ static_cast<std::uint64_t>(i));
  bits = mixed(bits ^ static_cast<std::uint64_t>(j));
  const double radius = std::sqrt(-2.0 * std::log(uniform(bits)));
  return radius * std::cos(2.0 * std::numbers::pi * uniform(mixed(bits)));
}

struct LineRange {
  std::int64_t first = 0, last = 0;
  std::size_t count() const { return static_cast<std::size_t>(last - first + 1); }
};

LineRange lines_of(double low_m, double high_m, double step_m) {
  const auto first = static_cast<std::int64_t>(std::floor(low_m / step_m));
  const auto last = static_cast<std::int64_t>(std::ceil(high_m / step_m));
  return {first, std::max(last, first + 1)};
}

double step_of(const RoughSurface& surface) {
  return surface.correlation_length_m / kLinesPerCorrelation;
}

// Weights exp(-2 x^2/c^2) whose squares sum to 1: white noise that they smooth has unit variance and the
// correlation exp(-x^2/c^2).
std::vector<double> smoothing_weights() {
  constexpr int kHalf = kReach * kLinesPerCorrelation;
  std::vector<double> weights;
  double squares = 0.0;
  for (int i = -kHalf; i <= kHalf; ++i) {
    const double x = static_cast<double>(i) / kLinesPerCorrelation;
    weights.push_back(std::exp(-2.0 * x * x));
    squares += weights.back() * weights.back();
  }
  for (double& weight : weights) weight /= std::sqrt(squares);
  return weights;
}

}  // namespace

double rough_places(const RoughSurface& surface, const RoughExtent& extent) {
  const double step_m = step_of(surface);
  return (1.0 + (extent.high_x_m - extent.low_x_m) / step_m) *
         (1.0 + (extent.high_y_m - extent.low_y_m) / step_m);
}

HeightTable rough_heights(const RoughSurface& surface, const RoughExtent& extent) {
  require_positive("rms of a rough surface", surface.rms_m, "m");
  require_positive("correlation length of a rough surface", surface.correlation_length_m, "m");
  require(rough_places(surface, extent) <= kMostRoughPlaces,
          "the correlation length is too small for the surface, which would need more than four "
          "million places");
  const double step_m = step_of(surface);
  const LineRange x = lines_of(extent.low_x_m, extent.high_x_m, step_m);
  const LineRange y = lines_of(extent.low_y_m, extent.high_y_m, step_m);
  const std::vector<double> weights = smoothing_weights();
  const auto half = static_cast<std::int64_t>(weights.size() / 2);
  HeightTable table;
  for (std::int64_t i = x.first; i <= x.last; ++i) {
    table.x_m.push_back(static_cast<double>(i) * step_m);
  }
  for (std::int64_t j = y.first; j <= y.last; ++j) {
    table.y_m.push_back(static_cast<double>(j) * step_m);
  }
  table.height_m.assign(x.count() * y.count(), 0.0);
  table.is_random = true;
  std::vector<double> noise(x.count() + 2 * static_cast<std::size_t>(half));
  std::vector<double> smooth(x.count());
  // Each line of noise, smoothed along x, adds to the lines within reach along y.
  for (std::int64_t j = y.first - half; j <= y.last + half; ++j) {
    for (std::size_t i = 0; i < noise.size(); ++i) {
      noise[i] = normal_at(surface.seed, x.first - half + static_cast<std::int64_t>(i), j);
    }
    for (std::size_t i = 0; i < smooth.size(); ++i) {
      double sum = 0.0;
      for (std::size_t k = 0; k < weights.size(); ++k) sum += weights[k] * noise[i + k];
      smooth[i] = surface.rms_m * sum;
    }
    const std::int64_t from = std::max(y.first, j - half);
    const std::int64_t to = std::min(y.last, j + half);
    for (std::int64_t row = from; row <= to; ++row) {
      const double weight = weights[static_cast<std::size_t>(row - j + half)];
      double* const line = &table.height_m[static_cast<std::size_t>(row - y.first) * x.count()];
      for (std::size_t i = 0; i < smooth.size(); ++i) line[i] += weight * smooth[i];
    }
  }
  return table;
}

}  // namespace viscard
