#include "rig/preflight.h"

#include "rig/text_number.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace viscard {
namespace {

constexpr double kLinkDelay_s = 0.010;  // reading a line, deciding, writing a byte
constexpr int kFewestRampReadings = 10;
constexpr double kSlowestRate_Hz = 20.0;

std::string in_N(double force_N) {
  return text_from_number(force_N, 3) + " N";
}
std::string in_mm(double length_m) {
  return text_from_number(length_m * 1e3, 4) + " mm";
}

void check_force(const RigConfig& rig, const TestPlan& plan, Preflight& result) {
  if (result.peak_force_N <= result.limit_N) return;
  // Rounded down, so that the depth named is itself accepted.
  const double depth_mm = std::floor(result.deepest_safe_depth_m * 1e6) * 1e-3;
  const bool is_above_rating = result.peak_force_N > rig.calibration.capacity_N;
  result.problems.push_back("expected peak force " + in_N(result.peak_force_N) + " at depth " +
                            in_mm(plan.depth_m) + " is above " + in_N(result.limit_N) + ", " +
                            text_from_number(100.0 * rig.safety.soft_fraction, 0) +
                            " % of the cell's " + in_N(rig.calibration.capacity_N) +
                            (is_above_rating ? ", and above the cell's rating itself" : "") +
                            ". Lower depth under [ramp] of the test file to " +
                            text_from_number(depth_mm, 3) + " mm or less");
}

void check_rates(const RigConfig& rig, const TestPlan& plan, Preflight& result) {
  const double rate_Hz = rig.load_cell.expected_rate_Hz;
  if (rate_Hz < kSlowestRate_Hz) {
    result.problems.push_back("the load cell gives " + text_from_number(rate_Hz, 1) +
                              " readings/s, too few to stop an approach in time: " +
                              remedy_for_slow_readings(rig.load_cell) +
                              ", then expected_rate in the rig file");
  } else if (plan.ramp_s * rate_Hz < kFewestRampReadings) {
    result.warnings.push_back(
        "the ramp of " + text_from_number(plan.ramp_s, 2) + " s holds only " +
        text_from_number(std::floor(plan.ramp_s * rate_Hz), 0) +
        " readings. Raise duration under [ramp] of the test file for a better "
        "instantaneous modulus");
  }
}

void check_motion(const RigConfig& rig, const TestPlan& plan, const StageDynamics& dynamics,
                  Preflight& result) {
  const double v = plan.approach_speed_m_s;
  const double seen_after_s = 1.5 / rig.load_cell.expected_rate_Hz + kLinkDelay_s;
  result.approach_overshoot_N =
      result.total_stiffness_N_m * (v * seen_after_s + stop_distance_m(v, dynamics));
  const double room_N = result.limit_N - plan.contact_force_N;
  if (result.approach_overshoot_N > room_N) {
    result.problems.push_back(
        "the approach would overshoot contact by " + in_N(result.approach_overshoot_N) +
        ", more than " + in_N(room_N) + ". Lower speed under [approach] of the test file to " +
        text_from_number(0.5 * v * room_N / result.approach_overshoot_N * 1e3, 3) +
        " mm/s or use finer steps");
  }
  if (result.ramp_speed_m_s > dynamics.max_speed_m_s) {
    result.problems.push_back(
        "the ramp needs " + text_from_number(result.ramp_speed_m_s * 1e3, 3) +
        " mm/s, more than the stage's largest rate. Raise duration under [ramp] of the test file "
        "to " +
        text_from_number(result.stage_travel_m / dynamics.max_speed_m_s * 1.01, 3) + " s");
  }
  const double step_m = 1.0 / dynamics.steps_per_m;
  if (0.5 * step_m > 0.005 * plan.depth_m) {
    result.warnings.push_back("one step of the stage is " +
                              text_from_number(100.0 * step_m / plan.depth_m, 1) +
                              " % of the depth. Use microstepping");
  }
}

void check_plan(const RigConfig& rig, const TestPlan& plan, const Specimen& specimen) {
  const auto require = [](bool is_good, const std::string& text) {
    if (!is_good) throw std::invalid_argument(text);
  };
  require(
      specimen.modulus_guess_Pa > 0.0,
      "the specimen has no modulus_guess: without it nobody knows what the cell will bear. Give "
      "one, rather too high than too low");
  require(
      plan.depth_m > 0.0 && plan.ramp_s > 0.0 && plan.hold_s >= 0.0,
      "depth and duration under [ramp] of the test file must be positive and hold not negative");
  require(
      plan.approach_speed_m_s > 0.0 && plan.unload_speed_m_s > 0.0 && plan.retract_speed_m_s > 0.0,
      "all speeds of the test file must be positive");
  require(plan.contact_force_N > 0.0 && plan.gap_m > 0.0 && plan.retract_m >= plan.gap_m,
          "contact_force and gap under [approach] of the test file must be positive, and distance "
          "under "
          "[retract] not below gap");
  require(plan.unload_to_fraction >= 0.0 && plan.unload_to_fraction < 1.0,
          "unload_to_fraction under [recovery] of the test file must lie in [0, 1)");
  require(rig.load_cell.expected_rate_Hz > 0.0, "expected_rate of the load cell must be positive");
  require(rig.safety.warn_fraction > 0.0 && rig.safety.soft_fraction > 0.0 &&
              rig.safety.hard_fraction >= rig.safety.soft_fraction &&
              rig.safety.hard_fraction <= 1.2,
          "safety fractions must be positive, hard not below soft, and hard at most 1.2");
}

}  // namespace

std::string remedy_for_slow_readings(const LoadCellConfig& cell) {
  if (cell.driver == "hx711") return "set its rate to 80/s (RATE pin of the HX711 high)";
  if (cell.driver == "scpi") {
    return "set the multimeter's interface to its highest baud rate and 1 power line cycle or less";
  }
  return "set the gauge's interface to its highest baud rate";
}

double stop_distance_m(double speed_m_s, const StageDynamics& dynamics) {
  return std::max(7.5 / dynamics.steps_per_m, 0.06 * speed_m_s) +
         0.5 * speed_m_s * speed_m_s / dynamics.acceleration_m_s2;
}

Preflight preflight(const RigConfig& rig, const TestPlan& plan, const Specimen& specimen,
                    const std::optional<StageDynamics>& dynamics) {
  validate(rig.calibration);
  check_plan(rig, plan, specimen);
  Preflight result;
  result.specimen_stiffness_N_m =
      force_per_modulus_and_depth_m(specimen.contact) * specimen.modulus_guess_Pa;
  const double frame_N_m = rig.frame.stiffness_N_m;
  const double compliance_m_N =
      1.0 / result.specimen_stiffness_N_m + (frame_N_m > 0.0 ? 1.0 / frame_N_m : 0.0);
  result.total_stiffness_N_m = 1.0 / compliance_m_N;
  result.limit_N = rig.safety.soft_fraction * rig.calibration.capacity_N;
  result.peak_force_N = result.specimen_stiffness_N_m * plan.depth_m;
  result.deepest_safe_depth_m = result.limit_N / result.specimen_stiffness_N_m;
  result.stage_travel_m = plan.depth_m + (frame_N_m > 0.0 ? result.peak_force_N / frame_N_m : 0.0);
  result.ramp_speed_m_s = result.stage_travel_m / plan.ramp_s;
  check_force(rig, plan, result);
  check_rates(rig, plan, result);
  if (dynamics) check_motion(rig, plan, *dynamics, result);
  return result;
}

}  // namespace viscard
