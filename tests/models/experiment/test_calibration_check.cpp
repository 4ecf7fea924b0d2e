#include "models/experiment/calibration_check.h"

#include <catch2/catch.hpp>

#include <cmath>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

// The cell of the demonstration behind 24 bits from -10 V to +10 V.
RigConfig amplified() {
  RigConfig rig;
  rig.load_cell.volts_per_count = 20.0 / 16777216.0;
  rig.calibration.volts_per_newton = 0.7255;
  rig.calibration.volts_per_newton_u = 0.002;
  rig.calibration.capacity_N = 2.4517;
  return rig;
}

std::string fault_of(const RigConfig& rig) {
  const auto fault = calibration_fault(rig.calibration, reading_span(rig.load_cell));
  return fault ? fault->key + ": " + fault->text : "";
}

}  // namespace

TEST_CASE("cells of every usual kind are believed", "[models]") {
  CHECK(fault_of(amplified()).empty());
  RigConfig bridge = amplified();
  bridge.load_cell.volts_per_count = 20e-3 / 8388608.0;  // an HX711 with a gain of 128
  for (const double mV_at_capacity : {0.5, 2.5, 5.0, 10.0, 15.0}) {
    bridge.calibration.volts_per_newton = 1e-3 * mV_at_capacity / 2.4517;
    CAPTURE(mV_at_capacity);
    CHECK(fault_of(bridge).empty());
    RigConfig meter = bridge;  // a multimeter at the same bridge
    meter.load_cell.driver = "scpi";
    CHECK(fault_of(meter).empty());
  }
  RigConfig coarse = amplified();  // the 10 bits of a microcontroller
  coarse.load_cell.volts_per_count = 5.0 / 1024.0;
  CHECK(fault_of(coarse).empty());
  RigConfig gauge = amplified();
  gauge.load_cell.driver = "mark10";
  gauge.calibration.volts_per_newton = 1.003;
  CHECK(fault_of(gauge).empty());
}

TEST_CASE("a gain that is negative or a thousand times off is refused with the limit it breaks",
          "[models]") {
  RigConfig rig = amplified();
  rig.calibration.volts_per_newton = -0.7255;
  CHECK_THAT(fault_of(rig), Contains("volts_per_newton") && Contains("negative, -0.7255 V/N"));
  rig.calibration.volts_per_newton = 725.5;
  CHECK_THAT(fault_of(rig), Contains("gain x capacity") && Contains("above the span") &&
                                Contains("10 V") && Contains("kg for g"));
  rig.calibration.volts_per_newton = 0.7255e-3;
  CHECK_THAT(fault_of(rig), Contains("% of the span") && Contains("mV for V"));
  CHECK_THROWS_WITH(require_believable(rig), Contains("calibration.volts_per_newton"));
  // The span that the rig file states counts.
  rig.load_cell.span_V = 20e-3;
  CHECK(fault_of(rig).empty());
  rig.load_cell.span_V = 1.5e-3;
  CHECK_THAT(fault_of(rig), Contains("above the span of the converter, 0.0015 V"));
  RigConfig gauge = amplified();
  gauge.load_cell.driver = "sauter";
  gauge.calibration.volts_per_newton = GENERATE(1e-3, 9.80665, 1e3);
  CHECK_THAT(fault_of(gauge), Contains("a gain near 1"));
}

TEST_CASE("weights above the capacity and a zero outside the span are refused", "[models]") {
  RigConfig rig = amplified();
  rig.calibration.largest_force_N = 0.25 * 9.80665;  // 250 g on a cell of 250 gf
  CHECK(fault_of(rig).empty());
  rig.calibration.largest_force_N = 1961.0;
  CHECK_THAT(fault_of(rig),
             Contains("1961 N") && Contains("above the capacity") && Contains("2.452 N"));
  rig.calibration.largest_force_N = 0.0;
  rig.calibration.zero_volts = -20.0;
  CHECK_THAT(fault_of(rig), Contains("zero_volts") && Contains("outside the span"));
}

TEST_CASE("a frame a thousand times too soft is refused", "[models]") {
  RigConfig rig = amplified();
  for (const double stiffness_N_m : {0.0, 100.0, 10e3, 5e6}) {
    rig.frame.stiffness_N_m = stiffness_N_m;
    CHECK_NOTHROW(require_believable(rig));
  }
  rig.frame.stiffness_N_m = 10.0;  // N/mm without its unit
  CHECK_THROWS_WITH(require_believable(rig), Contains("10 N/m; expected 100 N/m"));
  rig.frame.stiffness_N_m = 10e3;
  rig.frame.stiffness_relative_u = 2.0;  // per cent without the sign
  CHECK_THROWS_WITH(require_believable(rig), Contains("a share below 1"));
  rig.frame.stiffness_relative_u = 0.02;
  rig.stage.depth_relative_u = 3.0;
  CHECK_THROWS_WITH(require_believable(rig),
                    Contains("stage.depth_relative_u") && Contains("a share below 1"));
}

TEST_CASE("the uncertainty of a gain is that at the force of use", "[models]") {
  LoadCellCalibration cell = amplified().calibration;
  // A record without a range has one uncertainty, and no force is a doubt.
  for (const double force_N : {0.01, 1.0, 2.4}) {
    CHECK(gain_relative_u(cell, force_N) == Approx(0.002 / 0.7255).epsilon(1e-12));
    CHECK(calibration_range_doubt(cell, force_N).empty());
  }
  cell.volts_per_newton_u = 0.0;
  cell.largest_force_N = 0.2452;
  cell.curvature_at_N = 0.2452;
  cell.common_u = 2e-4;
  cell.curvature_u = 2e-3;
  CHECK(gain_relative_u(cell, 0.2452) == Approx(2e-4).epsilon(1e-12));
  CHECK(gain_relative_u(cell, 2.4517) == Approx(std::hypot(2e-4, 1.8e-3)).epsilon(1e-3));
  CHECK(calibration_range_doubt(cell, 1.19 * 0.2452).empty());
  CHECK_THAT(calibration_range_doubt(cell, 1.226),
             Contains("1.23 N is 5 times") && Contains("0.245 N") && Contains("0.082 %"));
  // A larger uncertainty of a certificate counts.
  cell.volts_per_newton_u = 2.0 * gain_relative_u_in_use(cell) * cell.volts_per_newton;
  CHECK(gain_relative_u(cell, 0.2452) == Approx(4e-4).epsilon(1e-12));
  cell.volts_per_newton_u = 0.0;
  cell.hysteresis = 0.01;
  CHECK(gain_relative_u(cell, 0.1226) > 0.0057);  // half a loop of 1 % of twice the force
  CHECK(gain_relative_u(cell, 0.0) < 0.02);
}

}  // namespace viscard
