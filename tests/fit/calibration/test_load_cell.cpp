#include "fit/calibration/fit_frame_stiffness.h"
#include "fit/calibration/fit_load_cell.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>
#include <stdexcept>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

// n_series times up and down over loads of 0, 1/4, 1/2, 3/4 and 1 times 2 N.
WeightReadings cell_readings(int n_series, double gain, double hysteresis, double bow,
                             double noise_V, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  WeightReadings data;
  for (int series = 0; series < n_series; ++series) {
    for (int i = 0; i <= 8; ++i) {
      const double share = (i <= 4 ? i : 8 - i) / 4.0;
      const double parabola = 4.0 * share * (1.0 - share) * 2.0 * gain;
      const double loop = (i <= 4 ? -0.5 : 0.5) * hysteresis;
      data.force_N.push_back(2.0 * share);
      data.reading.push_back(0.1 + 0.001 * series + gain * 2.0 * share + parabola * (bow + loop) +
                             noise_V * normal(random));
    }
  }
  return data;
}

}  // namespace

TEST_CASE("a perfect cell gives its gain, and the budget holds only the weights", "[fit]") {
  WeightReadings data = cell_readings(2, 0.7255, 0.0, 0.0, 0.0, 1);
  data.force_relative_u = 2e-4;
  const LoadCellFit fit = fit_load_cell(data);
  CHECK(fit.gain == Approx(0.7255).epsilon(1e-12));
  CHECK(fit.zero == Approx(0.1005).epsilon(1e-12));  // mean of 0.1 and 0.101
  CHECK(fit.n_series == 2);
  CHECK(fit.gain_u == Approx(2e-4 * 0.7255).epsilon(1e-6));
  CHECK(fit.nonlinearity < 1e-12);
  CHECK(fit.hysteresis < 1e-12);
}

TEST_CASE("hysteresis and nonlinearity are found with their true values", "[fit]") {
  const LoadCellFit loop = fit_load_cell(cell_readings(3, 0.7255, 0.004, 0.0, 0.0, 1));
  CHECK(loop.hysteresis == Approx(0.004).epsilon(1e-9));  // at half load, relative to full scale
  CHECK(loop.has_hysteresis);
  CHECK(loop.gain == Approx(0.7255).epsilon(1e-9));  // the errors on the way up and down cancel
  // A bow of 4 b s (1 - s) over s = 0, 1/4, 1/2, 3/4 (twice each) and 1: the least-squares line is
  // b (5/9 + 2/7 (s - 4/9)), farthest from it, by 5/7 b, at full load; the gain takes 2/7 b.
  const LoadCellFit bow = fit_load_cell(cell_readings(3, 0.7255, 0.0, 0.003, 0.0, 1));
  CHECK(bow.hysteresis < 1e-12);
  CHECK(bow.nonlinearity == Approx(0.003 * 5.0 / 7.0 / (1.0 + 0.003 * 2.0 / 7.0)).epsilon(1e-6));
}

TEST_CASE("the interval of the gain holds the truth in at least 95 of 100 calibrations", "[fit]") {
  int n_inside = 0;
  const int n = 400;
  for (unsigned seed = 1; seed <= n; ++seed) {
    // The errors of the weights have the size of their stated uncertainty.
    std::mt19937 random(seed + 5000);
    const double wrong = 1.0 + std::normal_distribution<double>(0.0, 3e-4)(random);
    WeightReadings data = cell_readings(3, 0.7255 * wrong, 0.002, 0.001, 5e-4, seed);
    data.force_relative_u = 3e-4;
    const LoadCellFit fit = fit_load_cell(data);
    n_inside += std::abs(fit.gain - 0.7255) < 2.0 * fit.gain_u ? 1 : 0;
  }
  CHECK(n_inside >= 380);
}

TEST_CASE("repeatability is the pooled scatter of repeated loads", "[fit]") {
  const LoadCellFit fit = fit_load_cell(cell_readings(200, 0.7255, 0.0, 0.0, 1e-3, 3));
  CHECK(fit.has_repeatability);
  // 1 mV of 1.451 V; the zeros of the series take one of nine degrees of freedom.
  CHECK(fit.repeatability == Approx(1e-3 / 1.451 * std::sqrt(8.0 / 9.0)).epsilon(0.05));
}

TEST_CASE("the gain is as uncertain as its series differ, and 1 % between them is refused",
          "[fit]") {
  const auto with_third = [](double factor) {
    WeightReadings data = cell_readings(3, 0.7255, 0.0, 0.0, 3e-5, 4);
    for (std::size_t i = 18; i < data.reading.size(); ++i) {
      data.reading[i] = 0.1 + (data.reading[i] - 0.1) * factor;
    }
    return data;
  };
  CHECK_THROWS_WITH(fit_load_cell(with_third(1.04)),
                    Contains("differs by 4 % between the series") && Contains("at most 1 %"));
  const LoadCellFit fit = fit_load_cell(with_third(1.005));
  CHECK(fit.budget[1].relative_u == Approx(0.005 / std::sqrt(3.0)).epsilon(0.05));
  CHECK(std::abs(fit.gain - 0.7255 * 1.005) < 2.0 * fit.gain_u);
  CHECK(std::abs(fit.gain - 0.7255) < 2.0 * fit.gain_u);
}

TEST_CASE("an invalid calibration is refused", "[fit]") {
  WeightReadings data;
  data.force_N = {0.0, 1.0};
  data.reading = {0.1, 0.8};
  CHECK_THROWS_WITH(fit_load_cell(data), Contains("two different weights"));
  data.force_N = {1.0, 2.0, 3.0};
  data.reading = {0.1, 0.8, 0.9};
  CHECK_THROWS_WITH(fit_load_cell(data), Contains("begin without load"));
  data.force_N = {0.0, 1.0, 2.0};
  data.reading = {0.1, 0.1, 0.1};
  CHECK_THROWS_WITH(fit_load_cell(data), Contains("do not change"));
  data.reading = {0.1, 0.1 + 1e-17, 0.1 - 1e-16};  // frozen, but for the rounding of a mean
  CHECK_THROWS_WITH(fit_load_cell(data), Contains("do not change"));
  data.reading = {0.1, 0.1};
  CHECK_THROWS_AS(fit_load_cell(data), std::invalid_argument);
}

TEST_CASE("weights in air are lighter by their buoyancy", "[fit]") {
  CHECK(weight_N_from_mass_kg(0.2, 9.80665) == Approx(0.2 * 9.80665 * 0.99985).epsilon(1e-12));
}

TEST_CASE("points far off a line are of no frame on a rigid block, however many they are",
          "[fit]") {
  BlockPoints air, soft;
  for (int i = 0; i < 4000; ++i) {
    const double share = i / 4000.0;
    air.position_m.push_back(1.5e-3 * share);
    air.force_N.push_back(1.8 * std::max(0.0, share - 0.6) + 1e-4 * share);
    soft.position_m.push_back(1.5e-3 * std::sqrt(share));  // stiffens as it is pressed
    soft.force_N.push_back(1.8 * share);
  }
  CHECK_THROWS_WITH(fit_frame_stiffness(air, 0.0), Contains("no frame on a rigid block"));
  CHECK_THROWS_WITH(fit_frame_stiffness(soft, 0.0), Contains("no frame on a rigid block"));
  CapturedRun run;
  run.plan.protocol = "staircase";
  CHECK_THROWS_WITH(block_points_from_capture(run), Contains("protocol 'staircase'"));
}

TEST_CASE("a contact that stiffens is of no frame on a seated block, however smooth it is",
          "[fit]") {
  for (const double largest_m : {95e-6, 25e-6}) {
    BlockPoints round;  // a sphere: F = C x^1.5
    for (int i = 1; i < 20; ++i) {
      round.position_m.push_back(largest_m * i / 19.0);
      round.force_N.push_back(1e6 * std::pow(round.position_m.back(), 1.5));
    }
    CHECK_THROWS_WITH(fit_frame_stiffness(round, 0.0), Contains("seated"));
    for (std::size_t i = 0; i < round.force_N.size(); ++i) {
      round.position_m[i] += round.force_N[i] / 8e3;  // in series with a frame
    }
    CHECK_THROWS_WITH(fit_frame_stiffness(round, 0.0), Contains("seated"));
  }
}

TEST_CASE("the stiffness of the frame comes from the slope of position over force", "[fit]") {
  BlockPoints points;
  for (int i = 1; i <= 6; ++i) {
    points.force_N.push_back(0.3 * i);
    points.position_m.push_back(1e-3 + 0.3 * i / 10e3);
  }
  const FrameStiffnessFit exact = fit_frame_stiffness(points, 0.002);
  CHECK(exact.stiffness_N_m == Approx(10e3).epsilon(1e-9));
  CHECK(exact.relative_u == Approx(0.002).epsilon(1e-6));  // the gain's uncertainty only
  CHECK(exact.low_N_m == Approx(10e3 * 0.996).epsilon(1e-6));
  points.position_m[3] += 2e-6;
  CHECK(fit_frame_stiffness(points, 0.0).curvature_m > 1e-6);
  for (double& position : points.position_m) position = -position;
  CHECK_THROWS_WITH(fit_frame_stiffness(points, 0.0), Contains("does not grow"));
  for (const double constant_N : {0.0, 1.0}) {
    for (double& force_N : points.force_N) force_N = constant_N;
    CHECK_THROWS_WITH(fit_frame_stiffness(points, 0.0), Contains("the same at every position"));
  }
}

TEST_CASE("a calibration is valid for a year, or until its own date", "[fit]") {
  LoadCellCalibration calibration;
  CHECK_THAT(calibration_trouble(calibration, "2026-11-21"), Contains("no date"));
  calibration.date = "2025-11-21";
  CHECK(last_valid_day(calibration) == "2026-11-21");
  CHECK(calibration_trouble(calibration, "2026-11-21").empty());
  CHECK_THAT(calibration_trouble(calibration, "2026-11-22"), Contains("expired on 2026-11-21"));
  calibration.date = "2024-02-29";
  CHECK(last_valid_day(calibration) == "2025-02-28");
  calibration.valid_until = "2099-12-31";
  CHECK(calibration_trouble(calibration, "2098-01-01").empty());
  CHECK_THAT(calibration_trouble(calibration, "2024-02-28"), Contains("later than today"));
}

TEST_CASE("the date of a calibration is a day of the calendar", "[fit]") {
  LoadCellCalibration calibration;
  CHECK_NOTHROW(validate_dates(calibration));  // no date: reported when it is used
  calibration.date = GENERATE("2026-11-21", "2024-02-29", "2026-11-21T10:00:00Z");
  CHECK_NOTHROW(validate_dates(calibration));
  calibration.date =
      GENERATE("yesterday", "2026-13-01", "2023-02-29", "21.11.2026", "2026-1-2", "2026-11-213");
  CHECK_THROWS_WITH(validate_dates(calibration), Contains("calibration.date"));
  calibration.date.clear();
  calibration.valid_until = "for ever";
  CHECK_THROWS_WITH(validate_dates(calibration), Contains("calibration.valid_until"));
}

}  // namespace viscard
