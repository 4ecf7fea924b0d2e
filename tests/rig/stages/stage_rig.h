#pragma once

#include "tests/rig/device_fixture.h"

#include <catch2/catch.hpp>

#include <string>

namespace viscard {

// For tests of what all stage drivers do alike.

// Each driver in turn.
inline std::string each_stage() {
  return GENERATE("grbl", "zaber", "apt", "marlin", "pi-gcs2", "smc100");
}

// An APT stage is a slow one with encoder counts of its own; the others share the usual truth.
inline EmulatedRigOptions stage_rig(const std::string& driver) {
  EmulatedRigOptions options = DeviceFixture::options(driver);
  if (driver != "apt") return options;
  options.truth.steps_per_m = 34304e3;
  options.truth.max_rate_m_s = 2.4e-3;
  options.truth.acceleration_m_s2 = 4e-3;
  return options;
}

// With a short way to the specimen.
inline EmulatedRigOptions near_stage_rig(const std::string& driver) {
  EmulatedRigOptions options = stage_rig(driver);
  options.truth.surface_position_m = 0.1e-3;
  return options;
}

// A restart that cuts the supply, of any stage.
inline void lose_power(EmulatedRigOptions& options) {
  options.zaber.loses_power = options.apt.loses_power = true;
  options.pi.loses_power = options.smc.loses_power = true;
}

inline TestPlan shortest_stage_plan() {
  TestPlan plan;
  plan.approach_speed_m_s = 0.2e-3;
  plan.baseline_s = 0.5;
  plan.hold_s = 1.0;
  plan.recovery_s = 0.5;
  return plan;
}

// Pumps until the stage has moved for move_s.
inline void pump_into_move(DeviceFixture& rig, double move_s) {
  const double until_s = rig.clock.awake_s() + 10.0;
  while (!rig.emulated.outcome().is_moving && rig.clock.awake_s() < until_s) rig.pump()();
  rig.pump_for(move_s);
}

}  // namespace viscard
