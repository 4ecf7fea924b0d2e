#pragma once

#include "models/experiment/rig_config.h"
#include "models/experiment/specimen.h"
#include "models/experiment/test_plan.h"
#include "rig/stages/stage.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// Below the first rate of readings, 1/s, the waits after the steps of the approach count; below the second
// one no test is possible.
inline constexpr double kSlowReadings_Hz = 20.0;
inline constexpr double kSlowestReadings_Hz = 2.0;

// What a test will do to the load cell, computed before anything moves.
struct Preflight {
  double specimen_stiffness_N_m = 0.0;  // c E, with the layer
  double total_stiffness_N_m = 0.0;     // in series with the frame
  double peak_force_N = 0.0;  // elastic, at full depth: an upper bound for a relaxing solid
  double limit_N = 0.0;       // soft limit of the cell
  double deepest_safe_depth_m = 0.0;
  double travel_per_depth = 1.0;  // of the stage, because the frame deforms too
  double stage_travel_m = 0.0;    // to full depth: depth + peak_force/frame stiffness
  double ramp_speed_m_s = 0.0;    // of the stage in the first ramp
  double total_s =
      0.0;  // of the test, with half of the approach limit, and the waits of a slow cell
  double approach_overshoot_N = 0.0;  // force above contact_force until the stage has stopped
  std::vector<std::string> problems;  // the test must not start if there is one
  std::vector<std::string> warnings;

  // Travel of the stage to that depth.
  double stage_travel_of(double depth_m) const { return depth_m * travel_per_depth; }
};

// Flat punch on a layer (models/contact/punch_contact.h) with the specimen's modulus_guess, in
// series with the frame. Without dynamics (no stage connected yet) the checks that depend on the
// controller's settings are left out. Throws std::invalid_argument on impossible geometry,
// calibration or safety settings.
Preflight preflight(const RigConfig& rig, const TestPlan& plan, const Specimen& specimen,
                    const std::optional<StageDynamics>& dynamics = std::nullopt);

// How to make a load cell send readings faster, depending on its driver.
std::string remedy_for_slow_readings(const LoadCellConfig& cell);

// Distance from the command of a gentle stop to standstill: GRBL first runs its queue of six
// segments of at least 1.25 steps or 10 ms, then decelerates (gnea/grbl stepper.c).
double stop_distance_m(double speed_m_s, const StageDynamics& dynamics);

}  // namespace viscard
