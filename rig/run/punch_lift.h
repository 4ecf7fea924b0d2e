#pragma once

#include "rig/run/force_readings.h"
#include "rig/run/served_devices.h"

#include <limits>
#include <string>

namespace viscard {

// What was still done for the specimen and the load cell after a run that ended early.
struct SafeEnd {
  double lifted_m = 0.0;
  // What could not be done, and what to do by hand; empty if everything was done.
  std::string trouble;
};

// Stops the stage, unlocks it if it locked itself, lifts the punch and checks that the force falls.
// Tries four times; each further try lifts by half the distance, because a stage that refuses to go
// so far (its own limits) may go part of the way.
struct PunchLift {
  struct Options {
    double retract_to_m = 0.0;
    double speed_m_s = 0.0;
    double pressing_N = 0.0;  // a force above this means that the punch presses
    std::string blind;        // why no reading shows the force; empty: they do
  };
  ServedDevices& devices;
  const ForceReadings& readings;
  const RigClock& clock;
  Pump pump;  // serves both devices
  Options options;
  double lifted_m = 0.0;  // so far
  double pressed_m =
      std::numeric_limits<double>::infinity();  // the way to here, once the position is lost

  SafeEnd carry_out();

  SafeEnd after_hang_up(const std::string& what);
  void stop_gently();
  std::string lift(double share);
  std::string trouble_with_force(double before_N);
};

}  // namespace viscard
