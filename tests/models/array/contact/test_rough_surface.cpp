// Statistics of random rough surfaces.
#include "models/array/contact/rough_surface.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>

using namespace viscard;

namespace {

// Mean over all places of f(row i, column j).
double mean_over(std::size_t rows, std::size_t columns,
                 const std::function<double(std::size_t, std::size_t)>& f) {
  double sum = 0.0;
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t i = 0; i < columns; ++i) sum += f(i, j);
  }
  return sum / static_cast<double>(rows * columns);
}

}  // namespace

// Expected: mean 0, variance h^2, correlation h^2 exp(-(r/c)^2), slope sqrt(2) h/c along each axis, kurtosis
// 3. Scatter of the variance over a square of side W: its relative standard deviation is sqrt(pi) c/W, since
// the variance of the mean of z^2 is 2 h^4 int exp(-2 r^2/c^2)/W^2 = pi c^2 h^4/W^2. Here 20 surfaces with W =
// 20 c: 0.0886/sqrt(20) = 0.02; margins are 3.5 of these.
TEST_CASE("a rough surface has the statistics that it was asked for", "[array][contact]") {
  constexpr double kRms_m = 0.25e-6, kCorrelation_m = 75e-6;
  const RoughExtent extent{0.0, 20.0 * kCorrelation_m, 0.0, 20.0 * kCorrelation_m};
  double variance = 0.0, at_70um = 0.0, slope_x = 0.0, slope_y = 0.0, fourth = 0.0, mean = 0.0;
  constexpr int kSurfaces = 20;
  const double step_m = kCorrelation_m / kLinesPerCorrelation;
  constexpr std::size_t kLag = 15;  // lines: 70.3 um
  for (int seed = 1; seed <= kSurfaces; ++seed) {
    const HeightTable table =
        rough_heights({kRms_m, kCorrelation_m, static_cast<std::uint64_t>(seed)}, extent);
    const std::size_t nx = table.x_m.size();
    const std::size_t ny = table.y_m.size();
    const auto z = [&](std::size_t i, std::size_t j) {
      return table.height_m[j * nx + i] / kRms_m;
    };
    mean += mean_over(ny, nx, z) / kSurfaces;
    variance += mean_over(ny, nx, [&](auto i, auto j) { return z(i, j) * z(i, j); }) / kSurfaces;
    fourth += mean_over(ny, nx, [&](auto i, auto j) { return std::pow(z(i, j), 4.0); }) / kSurfaces;
    at_70um += 0.5 / kSurfaces *
               (mean_over(ny, nx - kLag, [&](auto i, auto j) { return z(i, j) * z(i + kLag, j); }) +
                mean_over(ny - kLag, nx, [&](auto i, auto j) { return z(i, j) * z(i, j + kLag); }));
    const auto squared = [](double x) { return x * x; };
    slope_x +=
        mean_over(ny, nx - 1, [&](auto i, auto j) { return squared(z(i + 1, j) - z(i, j)); }) /
        kSurfaces;
    slope_y +=
        mean_over(ny - 1, nx, [&](auto i, auto j) { return squared(z(i, j + 1) - z(i, j)); }) /
        kSurfaces;
  }
  CHECK(mean == Approx(0.0).margin(0.07));  // sqrt(pi) c/W/sqrt(20) = 0.02
  CHECK(variance == Approx(1.0).margin(0.07));
  CHECK(fourth == Approx(3.0).margin(0.45));
  const double lag = static_cast<double>(kLag) / kLinesPerCorrelation;
  CHECK(at_70um == Approx(std::exp(-lag * lag)).margin(0.06));
  // E (z(x + s) - z(x))^2 = 2 (1 - exp(-s^2/c^2)), for small s the square of sqrt(2) h s/c.
  const double s = step_m / kCorrelation_m;
  CHECK(slope_x == Approx(2.0 * (1.0 - std::exp(-s * s))).epsilon(0.07));
  CHECK(slope_y == Approx(2.0 * (1.0 - std::exp(-s * s))).epsilon(0.07));
}

TEST_CASE("a seed stands for one surface, of which every table is a part", "[array][contact]") {
  const RoughSurface surface{1e-6, 50e-6, 42};
  const HeightTable whole = rough_heights(surface, {-200e-6, 200e-6, -200e-6, 200e-6});
  const HeightTable part = rough_heights(surface, {50e-6, 120e-6, -30e-6, 10e-6});
  RigidShape a{.kind = ShapeKind::kTable, .table = whole};
  RigidShape b{.kind = ShapeKind::kTable, .table = part};
  for (const double x_m : {55e-6, 83e-6, 119e-6}) {
    CHECK(height_m(a, x_m, 2e-6) == Approx(height_m(b, x_m, 2e-6)).margin(1e-15));
  }
  const HeightTable other = rough_heights({1e-6, 50e-6, 43}, {50e-6, 120e-6, -30e-6, 10e-6});
  CHECK(other.height_m != part.height_m);
  // Twice the rms: twice the heights.
  const HeightTable rougher = rough_heights({2e-6, 50e-6, 42}, {50e-6, 120e-6, -30e-6, 10e-6});
  CHECK(rougher.height_m[7] == Approx(2.0 * part.height_m[7]).epsilon(1e-12));
  CHECK_THROWS_AS(rough_heights({1e-6, 1e-9, 42}, {0.0, 1e-3, 0.0, 1e-3}), std::invalid_argument);
  CHECK_THROWS_AS(rough_heights({0.0, 1e-6, 42}, {0.0, 1e-5, 0.0, 1e-5}), std::invalid_argument);
}
