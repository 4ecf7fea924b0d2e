#include "rig/run/preflight.h"

#include "models/experiment/calibration_check.h"
#include "models/experiment/test_phases.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

namespace viscard {
namespace {

constexpr double kLinkDelay_s = 0.010;  // to read a line, decide and write a byte
constexpr int kFewestRampReadings = 10;
constexpr double kApproachStep_m = 25e-6;
constexpr double kUsualRate_Hz = 80.0;
constexpr double kWaitPeriods = 1.5;  // for the first reading made after a step

std::string in_N(double force_N) {
  return text_from_number(force_N, 3) + " N";
}
std::string in_mm(double length_m) {
  return text_from_number(length_m * 1e3, 4) + " mm";
}

void check_force(const RigConfig& rig, const std::vector<TestPhase>& phases, Preflight& result) {
  if (result.peak_force_N <= result.limit_N) return;
  const auto force_N = [&](const TestPhase& phase) {
    return std::max(phase.force_N, result.specimen_stiffness_N_m * phase.depth_m);
  };
  const TestPhase& highest = *std::max_element(
      phases.begin(), phases.end(),
      [&](const TestPhase& a, const TestPhase& b) { return force_N(a) < force_N(b); });
  const bool is_by_force = highest.force_N > 0.0;
  // Rounded down, so that the value in the message is itself accepted.
  const std::string remedy =
      is_by_force ? text_from_number(std::floor(result.limit_N * 1e3) * 1e-3, 3) + " N or less"
                  : text_from_number(std::floor(result.deepest_safe_depth_m * 1e6) * 1e-3, 3) +
                        " mm or less";
  // A force a hundred times too large is no deep test but a wrong number.
  const bool is_guess_wrong = !is_by_force && result.peak_force_N > 100.0 * result.limit_N;
  const bool is_above_rating = result.peak_force_N > rig.calibration.capacity_N;
  result.problems.push_back(
      "expected peak force " + in_N(result.peak_force_N) +
      (is_by_force ? std::string() : " at depth " + in_mm(highest.depth_m)) + " is above " +
      in_N(result.limit_N) + ", " + text_from_number(100.0 * rig.safety.soft_fraction, 0) +
      " % of the cell's " + in_N(rig.calibration.capacity_N) +
      (is_above_rating ? ", and above the cell's rating itself" : "") + ". " +
      (is_guess_wrong ? "Is the unit of modulus_guess of the specimen wrong, or that of " +
                            highest.load_key + " of the test file?"
                      : "Lower " + highest.load_key + " of the test file to " + remedy));
}

// A force that no approach would notice shows a mistake in the modulus or in the depth.
void check_least_force(const RigConfig& rig, const TestPlan& plan, Preflight& result) {
  if (result.peak_force_N > plan.contact_force_N) return;
  result.problems.push_back(
      "the expected peak force is only " + text_of(result.peak_force_N * 1e3, 3) +
      " mN, not above the contact_force of " + text_of(plan.contact_force_N * 1e3, 3) +
      " mN under [approach] of the test file. Is the unit of modulus_guess "
      "of the specimen missing? Otherwise press deeper, or lower "
      "contact_force; the cell takes " +
      in_N(rig.calibration.capacity_N));
}

void check_travel(const RigConfig& rig, const TestPlan& plan, Preflight& result) {
  if (plan.approach_limit_m <= rig.stage.travel_m) return;
  result.problems.push_back(
      "the approach may go " + in_mm(plan.approach_limit_m) + ", but the stage's travel is " +
      in_mm(rig.stage.travel_m) + ". Lower limit under [approach] of the test file to " +
      in_mm(0.5 * rig.stage.travel_m) + ", or correct travel under [stage] of the rig file");
}

// At a depth below the relaxed share of the largest earlier depth the punch loses contact, because
// the specimen has not recovered yet.
void check_lift_off(const std::vector<TestPhase>& phases, double relaxation, Preflight& result) {
  double deepest_m = 0.0;
  for (const TestPhase& phase : phases) {
    if (phase.kind != TestPhase::Kind::kMove) continue;
    deepest_m = std::max(deepest_m, phase.depth_m);
    if (phase.purpose != "unload" || phase.depth_m >= relaxation * deepest_m) continue;
    const double enough = std::min(0.9, std::ceil(200.0 * relaxation) * 0.01);
    result.warnings.push_back(
        "the move '" + phase.name + "' goes back to " +
        text_from_number(100.0 * phase.depth_m / deepest_m, 1) + " % of the depth, but " +
        text_from_number(100.0 * relaxation, 1) +
        " % of the force is expected to have relaxed: the punch will lift off. Raise " +
        (phase.load_key.empty()
             ? "unload_to_fraction of the test file to " + text_from_number(enough, 2)
             : phase.load_key + " to " + in_mm(enough * deepest_m)) +
        ", or correct relaxation_guess of the specimen");
    return;  // the same holds for later moves
  }
}

// Between a reading and the end of the stop that it causes the force must not rise from the limit to the
// capacity, at the stiffness that is expected.
void check_rise_between_readings(const RigConfig& rig, const std::vector<TestPhase>& phases,
                                 Preflight& result) {
  const double seen_after_s = kWaitPeriods / rig.load_cell.expected_rate_Hz + kLinkDelay_s;
  const double room_N = rig.calibration.capacity_N - result.limit_N;
  double before_m = 0.0;
  for (const TestPhase& phase : phases) {
    const double way_m = result.stage_travel_of(phase.depth_m - before_m);
    before_m = phase.depth_m;
    if (phase.kind != TestPhase::Kind::kMove || !(phase.move_s > 0.0) || !(way_m > 0.0)) continue;
    const double rise_N = result.total_stiffness_N_m * way_m * seen_after_s / phase.move_s;
    if (rise_N <= room_N) continue;
    result.problems.push_back(
        "in the move '" + phase.name + "' the force rises by " + in_N(rise_N) +
        " until a reading stops it, more than the " + in_N(room_N) +
        " between limit and capacity, because the load cell gives only " +
        text_from_number(rig.load_cell.expected_rate_Hz, 1) + " readings/s. Raise " +
        phase.speed_key + " of the test file to " +
        text_from_number(std::ceil(phase.move_s * rise_N / room_N * 10.0) / 10.0, 1) + " s, or " +
        remedy_for_slow_readings(rig.load_cell));
    return;
  }
}

void check_rates(const RigConfig& rig, const TestPlan& plan, const std::vector<TestPhase>& phases,
                 Preflight& result) {
  const double rate_Hz = rig.load_cell.expected_rate_Hz;
  if (rate_Hz < kSlowestReadings_Hz) {
    result.problems.push_back("the load cell gives " + text_from_number(rate_Hz, 1) +
                              " readings/s, fewer than the " +
                              text_from_number(kSlowestReadings_Hz, 0) +
                              "/s of any test: " + remedy_for_slow_readings(rig.load_cell) +
                              ", then expected_rate in the rig file");
    return;
  }
  const double way_m = 0.5 * plan.approach_limit_m;
  const auto total_s = [&](double at_Hz) {
    return planned_s(phases, 0, way_m / plan.approach_speed_m_s) +
           way_m / kApproachStep_m * kWaitPeriods / at_Hz;
  };
  result.total_s = total_s(rate_Hz);
  if (rate_Hz < kSlowReadings_Hz) {
    result.warnings.push_back(
        "the load cell gives " + text_from_number(rate_Hz, 1) +
        " readings/s: the approach goes in steps of " + text_from_number(kApproachStep_m * 1e6, 0) +
        " um and waits for a reading after each, so the test takes about " +
        text_from_number(result.total_s, 0) + " s instead of " +
        text_from_number(total_s(kUsualRate_Hz), 0) + " s. For a faster approach, " +
        remedy_for_slow_readings(rig.load_cell));
    check_rise_between_readings(rig, phases, result);
  }
  for (const TestPhase& phase : phases) {
    const bool is_timed = phase.kind == TestPhase::Kind::kMove || !phase.speed_key.empty();
    if (!is_timed || !(phase.move_s > 0.0)) continue;
    if (phase.move_s * rate_Hz >= kFewestRampReadings) continue;
    result.warnings.push_back("the move '" + phase.name + "' of " +
                              text_from_number(phase.move_s, 2) + " s holds only " +
                              text_from_number(std::floor(phase.move_s * rate_Hz), 0) +
                              " readings. Raise " + phase.speed_key +
                              " of the test file for a better "
                              "instantaneous modulus");
    return;  // one such warning is enough
  }
}

// The moves to a depth or force in a given time must not need a speed above the largest one.
void check_speeds(const std::vector<TestPhase>& phases, const StageDynamics& dynamics,
                  Preflight& result) {
  double before_m = 0.0;
  for (const TestPhase& phase : phases) {
    const bool is_load = phase.kind == TestPhase::Kind::kLoad && !phase.speed_key.empty();
    if (phase.kind != TestPhase::Kind::kMove && !is_load) continue;
    const double depth_m = is_load ? phase.force_N / result.specimen_stiffness_N_m : phase.depth_m;
    const double way_m = std::abs(result.stage_travel_of(depth_m - before_m));
    before_m = depth_m;
    if (!(phase.move_s > 0.0) || way_m <= dynamics.max_speed_m_s * phase.move_s) continue;
    result.problems.push_back("the move '" + phase.name + "' needs " +
                              text_from_number(way_m / phase.move_s * 1e3, 3) +
                              " mm/s, more than the stage's largest rate. Raise " +
                              phase.speed_key + " of the test file to " +
                              text_from_number(way_m / dynamics.max_speed_m_s * 1.01, 3) + " s");
    return;
  }
}

// The largest speed whose overshoot is within the room, by bisection; overshoot grows with speed.
double fastest_m_s(const std::function<double(double)>& overshoot_N, double too_fast_m_s,
                   double room_N) {
  double low_m_s = 0.0;
  double high_m_s = too_fast_m_s;
  for (int i = 0; i < 60; ++i) {
    const double middle_m_s = 0.5 * (low_m_s + high_m_s);
    (overshoot_N(middle_m_s) > room_N ? high_m_s : low_m_s) = middle_m_s;
  }
  return low_m_s;
}

// Warns of speeds below the smallest one that the controller can make.
void check_slowness(const TestPlan& plan, const std::vector<TestPhase>& phases,
                    const StageDynamics& dynamics, Preflight& result) {
  const auto warn = [&](const std::string& what, double asked_m_s) {
    result.warnings.push_back("the stage moves no slower than " + in_mm(dynamics.min_speed_m_s) +
                              "/s: " + what + " goes at that speed, not at " + in_mm(asked_m_s) +
                              "/s. Use microstepping");
  };
  if (plan.approach_speed_m_s < dynamics.min_speed_m_s)
    warn("the approach", plan.approach_speed_m_s);
  double before_m = 0.0;
  for (const TestPhase& phase : phases) {
    if (phase.kind != TestPhase::Kind::kMove) continue;
    const double way_m = std::abs(result.stage_travel_of(phase.depth_m - before_m));
    before_m = phase.depth_m;
    if (!(phase.move_s > 0.0) || !(way_m > 0.0)) continue;
    if (way_m >= dynamics.min_speed_m_s * phase.move_s) continue;
    return warn("the move '" + phase.name + "'", way_m / phase.move_s);
  }
}

void check_motion(const RigConfig& rig, const TestPlan& plan, const std::vector<TestPhase>& phases,
                  const StageDynamics& dynamics, Preflight& result) {
  const double k_N_m = result.total_stiffness_N_m;
  const auto overshoot_N = [&](double speed_m_s) {
    const double seen_after_s = 1.5 / rig.load_cell.expected_rate_Hz + kLinkDelay_s;
    return k_N_m * (speed_m_s * seen_after_s + stop_distance_m(speed_m_s, dynamics));
  };
  const double approach_m_s = std::max(plan.approach_speed_m_s, dynamics.min_speed_m_s);
  result.ramp_speed_m_s = std::max(result.ramp_speed_m_s, dynamics.min_speed_m_s);
  result.approach_overshoot_N = overshoot_N(approach_m_s);
  const double room_N = result.limit_N - plan.contact_force_N;
  if (result.approach_overshoot_N > room_N) {
    const double fastest_mm_s =
        std::floor(1e6 * fastest_m_s(overshoot_N, approach_m_s, room_N)) * 1e-3;
    result.problems.push_back(
        "the approach would overshoot contact by " + in_N(result.approach_overshoot_N) +
        ", more than " + in_N(room_N) + ". " +
        (fastest_mm_s > dynamics.min_speed_m_s * 1e3
             ? "Lower speed under [approach] of the test file to " +
                   text_from_number(fastest_mm_s, 3) + " mm/s or less"
             : std::string("Use finer steps: no speed under [approach] of the test "
                           "file is slow enough")));
  }
  check_speeds(phases, dynamics, result);
  check_slowness(plan, phases, dynamics, result);
  const double step_m = 1.0 / dynamics.steps_per_m;
  const double depth_m = deepest_m(phases);
  if (depth_m > 0.0 && 0.5 * step_m > 0.005 * depth_m) {
    result.warnings.push_back("one step of the stage is " +
                              text_from_number(100.0 * step_m / depth_m, 1) +
                              " % of the depth. Use microstepping");
  }
  const double force_N = highest_force_N(phases);
  const double step_N = step_m * result.total_stiffness_N_m;
  if (force_N > 0.0 && step_N > 0.01 * force_N) {
    result.warnings.push_back("one step of the stage changes the force by " + in_N(step_N) +
                              ", more than 1 % of the force to be held. Use microstepping");
  }
}

void check_rig_and_specimen(const RigConfig& rig, const Specimen& specimen) {
  const auto require = [](bool is_good, const std::string& text) {
    if (!is_good) throw std::invalid_argument(text);
  };
  require(specimen.modulus_guess_Pa > 0.0,
          "the specimen has no modulus_guess: without it the force cannot be predicted. Give "
          "one, rather too high than too low");
  require(rig.load_cell.expected_rate_Hz > 0.0, "expected_rate of the load cell must be positive");
  require(rig.safety.warn_fraction > 0.0 && rig.safety.soft_fraction > 0.0 &&
              rig.safety.hard_fraction >= rig.safety.soft_fraction &&
              rig.safety.hard_fraction <= 1.2,
          "safety fractions must be positive, hard not below soft, and hard at most 1.2");
}

}  // namespace

std::string remedy_for_slow_readings(const LoadCellConfig& cell) {
  if (cell.driver == "hx711") return "set its rate to 80/s (RATE pin of the HX711 high)";
  if (cell.driver == "adc" || cell.driver == "adc-frames") {
    return "let the board convert at 80/s or faster (ADS1256: DRATE; ADS1232: SPEED pin high; "
           "NAU7802: setSampleRate) and print every reading";
  }
  if (cell.driver == "scpi") {
    return "set the multimeter's interface to its highest baud rate and 1 power line cycle or less";
  }
  if (cell.driver == "mark10-continuous") return "set expected_rate to 125 or 250 Hz";
  return "set the gauge's interface to its highest baud rate";
}

double stop_distance_m(double speed_m_s, const StageDynamics& dynamics) {
  return std::max(7.5 / dynamics.steps_per_m, 0.06 * speed_m_s) +
         0.5 * speed_m_s * speed_m_s / dynamics.acceleration_m_s2;
}

Preflight preflight(const RigConfig& rig, const TestPlan& plan, const Specimen& specimen,
                    const std::optional<StageDynamics>& dynamics) {
  require_believable(rig);
  check_rig_and_specimen(rig, specimen);
  const std::vector<TestPhase> phases = phases_from_plan(plan);
  Preflight result;
  result.specimen_stiffness_N_m =
      force_per_modulus_and_depth_m(specimen.contact) * specimen.modulus_guess_Pa;
  const double frame_N_m = rig.frame.stiffness_N_m;
  const double compliance_m_N =
      1.0 / result.specimen_stiffness_N_m + (frame_N_m > 0.0 ? 1.0 / frame_N_m : 0.0);
  result.total_stiffness_N_m = 1.0 / compliance_m_N;
  result.limit_N = rig.safety.soft_fraction * rig.calibration.capacity_N;
  result.travel_per_depth =
      1.0 + (frame_N_m > 0.0 ? result.specimen_stiffness_N_m / frame_N_m : 0.0);
  const double depth_m =
      std::max(deepest_m(phases), highest_force_N(phases) / result.specimen_stiffness_N_m);
  result.peak_force_N = result.specimen_stiffness_N_m * depth_m;
  result.deepest_safe_depth_m = result.limit_N / result.specimen_stiffness_N_m;
  result.stage_travel_m = result.stage_travel_of(depth_m);
  for (const TestPhase& phase : phases) {
    if (phase.purpose != "ramp") continue;
    const double first_m = std::max(phase.depth_m, phase.force_N / result.specimen_stiffness_N_m);
    result.ramp_speed_m_s = result.stage_travel_of(first_m) / phase.move_s;
    break;
  }
  if (rig.stage.backlash_m > 0.0) {
    result.warnings.push_back(
        "backlash under [stage] of the rig file changes nothing: contact and ramp are reached from "
        "the same side, but an unloading loses it. Take the play out (preloaded nut, spring)");
  }
  check_force(rig, phases, result);
  check_least_force(rig, plan, result);
  check_travel(rig, plan, result);
  check_lift_off(phases, specimen.relaxation_guess, result);
  check_rates(rig, plan, phases, result);
  const std::string range = calibration_range_doubt(rig.calibration, result.peak_force_N);
  if (!range.empty()) result.warnings.push_back(range);
  if (dynamics) check_motion(rig, plan, phases, *dynamics, result);
  return result;
}

}  // namespace viscard
