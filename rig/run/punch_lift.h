#pragma once

#include "rig/run/force_readings.h"
#include "rig/run/served_devices.h"

#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace viscard {

// What was still done for the specimen and the load cell after a run that ended early.
struct SafeEnd {
  double lifted_m = 0.0;
  // What could not be done, and what to do by hand; empty if everything was done.
  std::string trouble;
  bool is_force_left = false;  // after the lift the force is not that of a free punch
};

// What a force that has risen by so much in a move away from the specimen means.
std::string wrong_way_text(double rise_N);

// Stops the stage, unlocks it if it locked itself, lifts the punch and checks that the force falls
// to the zero of the tare, if that is known.
// Tries four times; each further try lifts by half the distance, because a stage that refuses to go
// so far (its own limits) may go part of the way.
struct PunchLift {
  struct Options {
    double retract_to_m = 0.0;  // infinite: nothing to lift, so the stage is only stopped
    double speed_m_s = 0.0;
    double pressing_N = 0.0;             // a force above this means that the punch presses
    std::string blind;                   // why no reading shows the force; empty: they do
    double noise_N = 0.0;                // of one reading
    std::optional<double> zero_drift_N;  // of a free punch since the tare; nothing: no tare yet
    // Nothing has shown yet that the stage lifts, so the lift is slow, and a force that rises or
    // cannot be read stops it, as after a lost position.
    bool watches = false;
    const std::atomic<bool>* stop = nullptr;  // ends a watched lift; nullptr: nothing does
    bool knows_sign =
        false;  // the touch has shown that a punch that presses makes a positive force
    // A force that rises by more stops every lift at once, unless no reading shows it.
    double most_rise_N = 0.0;
    double pressed_until_s = 0.0;  // readings made until then show the press before
    double least_start_N = 0.0;    // what the press before may still show
  };
  ServedDevices& devices;
  ForceReadings& readings;
  const RigClock& clock;
  Pump pump;  // serves both devices
  Options options;
  double lifted_m = 0.0;  // so far
  bool was_moving = false;
  bool is_force_left = false;
  double pressed_m =
      std::numeric_limits<double>::infinity();  // the way to here, once the position is lost

  SafeEnd carry_out();

  SafeEnd after_hang_up(const std::string& what);
  void stop_gently();
  bool is_only_stopped() const { return std::isinf(options.retract_to_m); }
  bool is_watched() const { return options.watches || devices.is_position_lost(); }
  bool rises() const {
    return options.blind.empty() && !devices.is_cell_restarted() &&
           readings.rise_N() > options.most_rise_N;
  }
  bool is_stop_asked() const { return options.stop != nullptr && *options.stop; }
  std::string watch(double before_N, double deadline_s);
  std::string stopped_as_wrong(double rise_N);
  std::string lift(double share);
  std::string trouble_with_force(double before_N, bool was_pressing);
  SafeEnd ended(const std::string& trouble) const { return {lifted_m, trouble, is_force_left}; }
};

}  // namespace viscard
