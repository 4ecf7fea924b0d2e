#pragma once

#include "models/experiment/rig_config.h"
#include "models/experiment/specimen.h"
#include "models/experiment/test_plan.h"
#include "rig/stages/stage.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// What a test will do to the cell, computed before anything moves.
struct Preflight {
  double specimen_stiffness_N_m = 0.0;  // c E, with the layer
  double total_stiffness_N_m = 0.0;     // in series with the frame
  double peak_force_N = 0.0;  // elastic, at the deepest: an upper bound for a relaxing solid
  double limit_N = 0.0;       // soft limit of the cell
  double deepest_safe_depth_m = 0.0;
  double travel_per_depth = 1.0;      // of the stage: the frame gives way as well
  double stage_travel_m = 0.0;        // to the deepest: depth + peak_force/frame stiffness
  double ramp_speed_m_s = 0.0;        // of the stage, in the first ramp
  double approach_overshoot_N = 0.0;  // beyond the contact force, until the stage stands
  std::vector<std::string> problems;  // any of these: do not start
  std::vector<std::string> warnings;

  double stage_travel_of(double depth_m) const { return depth_m * travel_per_depth; }
};

// Flat punch on the layer (models/punch_contact.h), modulus_guess of the specimen, frame in series.
// Without dynamics (no stage asked yet) what depends on the controller's settings is left out.
// Throws std::invalid_argument on geometry or calibration that make no sense.
Preflight preflight(const RigConfig& rig, const TestPlan& plan, const Specimen& specimen,
                    const std::optional<StageDynamics>& dynamics = std::nullopt);

// What to do about a load cell whose readings are too few, by its driver.
std::string remedy_for_slow_readings(const LoadCellConfig& cell);

// Way from the decision to stop gently to standstill: GRBL's queue of six segments of at least 1.25
// steps or 10 ms, then deceleration (gnea/grbl stepper.c).
double stop_distance_m(double speed_m_s, const StageDynamics& dynamics);

}  // namespace viscard
