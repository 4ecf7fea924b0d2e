#include "models/experiment/calibration.h"
#include "models/experiment/motion_profile.h"

#include <catch2/catch.hpp>

#include <stdexcept>

using namespace viscard;

TEST_CASE("a trapezoidal move takes distance over speed plus speed over acceleration", "[models]") {
  const StageMove move{.start_time_s = 1.0,
                       .from_m = 0.0,
                       .to_m = 1e-3,
                       .speed_m_s = 1e-3,
                       .acceleration_m_s2 = 0.01};
  CHECK(duration_s(move) == Approx(1.0 + 0.1).epsilon(1e-14));
  CHECK(position_m(move, 0.5) == 0.0);
  CHECK(position_m(move, 1.0 + 0.05) == Approx(0.5 * 0.01 * 0.05 * 0.05).epsilon(1e-14));
  CHECK(position_m(move, 1.0 + 0.55) == Approx(0.5e-3).epsilon(1e-13));
  CHECK(position_m(move, 3.0) == 1e-3);
  CHECK(velocity_m_s(move, 1.55) == Approx(1e-3).epsilon(1e-14));
  CHECK(knots_s(move).size() == 4);
}

TEST_CASE("a distance too short for full speed gives a triangular velocity profile", "[models]") {
  const StageMove move{.from_m = 1e-4, .to_m = 0.0, .speed_m_s = 1.0, .acceleration_m_s2 = 1.0};
  CHECK(duration_s(move) == Approx(2.0 * 0.01).epsilon(1e-14));
  CHECK(position_m(move, 0.01) == Approx(0.5e-4).epsilon(1e-12));
  CHECK(velocity_m_s(move, 0.01) == Approx(-0.01).epsilon(1e-12));
  CHECK(knots_s(move).size() == 3);
}

TEST_CASE("position is the integral of velocity", "[models]") {
  const StageMove move{
      .from_m = 0.2e-3, .to_m = -0.7e-3, .speed_m_s = 2e-3, .acceleration_m_s2 = 0.05};
  double integrated_m = 0.2e-3;
  const int steps = 100000;
  const double dt_s = duration_s(move) / steps;
  for (int i = 0; i < steps; ++i) integrated_m += velocity_m_s(move, (i + 0.5) * dt_s) * dt_s;
  CHECK(integrated_m == Approx(-0.7e-3).epsilon(1e-9));
}

TEST_CASE("a list of moves is followed one after another", "[models]") {
  const std::vector<StageMove> moves{{0.0, 0.0, 1e-3, 1e-3, 1.0}, {5.0, 1e-3, 0.0, 1e-3, 1.0}};
  CHECK(position_m(moves, -1.0) == 0.0);
  CHECK(position_m(moves, 4.0) == 1e-3);
  CHECK(position_m(moves, 100.0) == 0.0);
}

TEST_CASE("a stage stands at whole steps only", "[models]") {
  // GRBL's default of 250 steps/mm turns 0.25 mm into 63 steps, 0.252 mm.
  CHECK(quantised_m(0.25e-3, 250e3) == Approx(0.252e-3).epsilon(1e-12));
}

TEST_CASE("volts and force convert both ways through gain and zero", "[models]") {
  const LoadCellCalibration calibration{
      .volts_per_newton = 0.7255, .zero_volts = 0.1, .capacity_N = 2.45};
  CHECK(force_N_from_volts(calibration, volts_from_force_N(calibration, 1.5)) ==
        Approx(1.5).epsilon(1e-15));
  // The seed: 2.7573 N is 2.0004 V.
  CHECK(volts_from_force_N({.volts_per_newton = 0.7255}, 2.7573) == Approx(2.0004).epsilon(2e-5));
  CHECK_THROWS_AS(validate(LoadCellCalibration{.capacity_N = 1.0}), std::invalid_argument);
}
