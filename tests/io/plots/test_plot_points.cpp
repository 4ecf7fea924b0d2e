#include "io/plots/plot_points.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace viscard;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("an axis spans its finite values and obeys given ends", "[io][report]") {
  const AxisSpan span = axis_span({}, {2.0, kNaN, 12.0, kInf, -kInf});
  CHECK(span.low == 2.0);
  CHECK(span.high == 12.0);
  const PlotAxis zero{.label = "", .min = 0.0};
  CHECK(axis_span(zero, {2.0, 12.0}).low == 0.0);
}

TEST_CASE("a logarithmic axis has a margin and ignores values it cannot show", "[io][report]") {
  const PlotAxis axis{.is_log = true};
  const AxisSpan span = axis_span(axis, {-3.0, 0.0, 1e-3, 1e3, kNaN});
  CHECK(span.low == Approx(1e-3 * std::pow(1e6, -0.04)).epsilon(1e-12));  // rounding only
  CHECK(span.high == Approx(1e3 * std::pow(1e6, 0.04)).epsilon(1e-12));
  CHECK(fraction_of(span, 1.0) == Approx(0.5).epsilon(1e-12));
  CHECK_FALSE(std::isfinite(fraction_of(span, -1.0)));
}

TEST_CASE("a logarithmic axis within a decade is extended to whole decades", "[io][report]") {
  const AxisSpan span = axis_span({.is_log = true}, {130.0, 400.0});
  CHECK(span.low == Approx(100.0).epsilon(1e-12));  // rounding only
  CHECK(span.high == Approx(1000.0).epsilon(1e-12));
}

TEST_CASE("an axis over one value, or none, still has a length", "[io][report]") {
  const bool is_log = GENERATE(false, true);
  const std::vector<double> values = GENERATE(
      std::vector<double>{}, std::vector<double>{0.0}, std::vector<double>{7.0},
      std::vector<double>{-7.0, -7.0}, std::vector<double>{1e-300}, std::vector<double>{kNaN});
  const AxisSpan span = axis_span({.is_log = is_log}, values);
  CAPTURE(is_log, values);
  CHECK(span.high > span.low);
  CHECK((!is_log || span.low > 0.0));
}

TEST_CASE("a line keeps its extremes however many points it has", "[io][report]") {
  PlotSeries series;
  for (int i = 0; i < 100000; ++i) {
    series.x.push_back(i);
    series.y.push_back(std::sin(0.001 * i));
  }
  series.y[41234] = 5.0;
  series.y[77777] = -6.0;
  const AxisSpan x{0.0, 1e5, false}, y{-7.0, 7.0, false};
  const std::vector<PlotPoint> points = visible_points(series, x, y, 500, 300);
  CHECK(points.size() <= 4u * 501u);
  double low = 0.0, high = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    low = std::min(low, points[i].y);
    high = std::max(high, points[i].y);
    if (i > 0) CHECK(points[i].x >= points[i - 1].x);
  }
  CHECK(high == 5.0);
  CHECK(low == -6.0);
  CHECK(points.front().x == 0.0);
  CHECK(points.back().x == 99999.0);
}

TEST_CASE("dots are thinned to what the picture can tell apart and none is moved", "[io][report]") {
  PlotSeries series{.mark = Mark::kPoints};
  for (int i = 0; i < 200000; ++i) {
    series.x.push_back(std::fmod(i * 0.6180339887, 1.0));
    series.y.push_back(std::fmod(i * 0.7548776662, 1.0));
  }
  const AxisSpan unit{0.0, 1.0, false};
  const std::vector<PlotPoint> points = visible_points(series, unit, unit, 200, 100);
  CHECK(points.size() <= 101u * 51u);
  CHECK(points.size() > 4000u);  // 100 x 50 cells, nearly all of them hit
}

TEST_CASE("values that cannot be drawn break a line and never reach gnuplot", "[io][report]") {
  PlotSeries series;
  series.x = {1.0, 2.0, 3.0, 4.0, 5.0};
  series.y = {1.0, kNaN, 2.0, -1.0, 3.0};
  const AxisSpan x{0.0, 6.0, false};
  const std::vector<PlotPoint> points = visible_points(series, x, {0.1, 10.0, true}, 100, 100);
  REQUIRE(points.size() == 3);
  CHECK_FALSE(points[0].breaks_before);
  CHECK(points[1].breaks_before);
  CHECK(points[2].breaks_before);
}

TEST_CASE("an error bar that reaches below zero ends at the edge of a logarithmic axis",
          "[io][report]") {
  PlotSeries series{.mark = Mark::kErrorBars};
  series.x = {1.0};
  series.y = {0.5};
  series.y_low = {-0.2};
  series.y_high = {1.2};
  const std::vector<PlotPoint> points =
      visible_points(series, {0.0, 2.0, false}, {0.01, 10.0, true}, 100, 100);
  REQUIRE(points.size() == 1);
  CHECK(points[0].y_low == 0.01);
  CHECK(points[0].y_high == 1.2);
}

TEST_CASE("a series of unequal columns is refused by its name", "[io][report]") {
  PlotSeries series{.label = "force", .x = {1.0, 2.0}, .y = {1.0}};
  CHECK_THROWS_WITH(validate(series), Catch::Contains("'force'"));
  PlotSeries band{.mark = Mark::kBand, .label = "band", .x = {1.0}, .y_low = {1.0}};
  CHECK_THROWS_WITH(validate(band), Catch::Contains("'band'"));
}
