#include "rig/run/punch_lift.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <exception>

namespace viscard {
namespace {

constexpr double kStandstill_wall_s = 10.0;  // longest wait for standstill
constexpr double kLargestLift_m = 2e-3;      // one lift is at most this long, contact known or not
constexpr double kOldReadings_wall_s = 1.0;  // longest wait for a reading made after the lift
constexpr int kAttempts = 4;
constexpr double kReopen_wall_s =
    5.0;  // longest wait for a port; USB needs 1 to 3 s to list it again
constexpr double kWatchedSpeed_m_s = 0.2e-3;  // of a lift that may go the wrong way
constexpr double kFallen = 0.9;               // of the force before the lift
constexpr int kFewestOfMean = 5;
constexpr double kNoForce_wall_s = 0.25;  // while a watched lift moves
constexpr double kNoForceEmulated_wall_s = 1.0;
constexpr const char* kStoppedEarly = "the lift was stopped before its end";

}  // namespace

std::string wrong_way_text(double rise_N) {
  return "the force rises by " + text_from_number(rise_N * 1e3, 1) +
         " mN while the stage moves away by its count: THE PUNCH MAY PRESS, look at it and lift it "
         "by hand. Either the stage moves toward the specimen (check the direction (DIR) wire, its "
         "driver and toward_specimen), or the load cell shows a force that is none (an open wire, "
         "its zero, a touch)";
}

SafeEnd PunchLift::carry_out() {
  was_moving = devices.stage().is_moving() || devices.needs_recovery();
  // A stage in alarm refuses the first attempt, and a limit switch that opens again while the stage
  // moves away from it raises another alarm.
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    try {
      if (attempt == 0) stop_gently();
      devices.end_gentle_stop();
      if (is_only_stopped()) {
        // An unlocked controller would count on from a place without meaning.
        if (devices.stage().is_moving()) devices.stop_hard();
      } else if (attempt > 0 || devices.needs_recovery()) {
        devices.recover(pump);
      }
      return ended(lift(std::pow(0.5, attempt)));
    } catch (const PortHungUp& error) {
      return after_hang_up(error.what());
    } catch (const std::exception& error) {
      if (attempt + 1 == kAttempts) return ended(error.what());
    }
  }
  return ended("");
}

// The port of the stage may come back. Its position is lost then, and with it all that was known of
// the way, so the punch is lifted slowly, no further than it had come, while the force is watched.
SafeEnd PunchLift::after_hang_up(const std::string& what) {
  const std::string cannot =
      ". THE STAGE CANNOT BE STOPPED FROM HERE: use its emergency stop and lift the punch by hand";
  if (!devices.is_cell_usable() || !options.blind.empty()) {
    return ended(what + cannot);
  }
  pressed_m = std::max(0.0, devices.stage().position_m() - options.retract_to_m);
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    try {
      if (attempt == 0) {
        devices.reopen_stage(kReopen_wall_s, pump);
      } else if (devices.needs_recovery()) {
        devices.recover(pump);
      }
      return ended(lift(std::pow(0.5, attempt)));
    } catch (const PortHungUp& error) {
      return ended(error.what() + cannot);
    } catch (const std::exception& error) {
      if (attempt == 0 || attempt + 1 == kAttempts) return ended(error.what());
    }
  }
  return ended("");
}

void PunchLift::stop_gently() {
  const Stage& stage = devices.stage();
  if (!stage.is_moving() || devices.needs_recovery()) return;
  devices.begin_gentle_stop();
  const double deadline_s = clock.awake_s() + kStandstill_wall_s;
  while (stage.is_moving() && !devices.needs_recovery() && clock.awake_s() < deadline_s) pump();
}

std::string PunchLift::stopped_as_wrong(double rise_N) {
  is_force_left = true;
  if (devices.stage().is_moving()) devices.stop_hard();
  return wrong_way_text(rise_N);
}

// Until the stage stands. Returns why it was stopped, or "".
std::string PunchLift::watch(double before_N, double deadline_s) {
  Stage& stage = devices.stage();
  // Readings may go on and make no force, or repeat one while the punch still presses.
  SilenceWatch no_force(clock.speed() > 1.0 ? kNoForceEmulated_wall_s : kNoForce_wall_s);
  const double period_s = devices.load_cell().period_s() / clock.speed();
  std::int64_t n_before = readings.n_forces();
  double last_N = readings.force_N();
  bool is_stopping = false;
  while (stage.is_moving() && clock.awake_s() < deadline_s) {
    pump();
    if (rises()) return stopped_as_wrong(readings.rise_N());
    if (!is_watched()) continue;
    if (devices.needs_recovery()) return kStoppedEarly;  // at once, by a person
    const double now_N = readings.force_N();
    const bool is_new = readings.n_forces() != n_before &&
                        (now_N != last_N || std::abs(now_N) <= options.pressing_N);
    no_force.pass(clock.awake_s(), is_new, true);
    n_before = readings.n_forces();
    last_N = now_N;
    // Only fresh readings show that the stage goes the right way.
    const bool is_blind =
        !devices.is_cell_usable() || devices.silence().has_value() || no_force.is_silent(period_s);
    if (is_blind) {
      devices.stop_hard();
      return "THE LOAD CELL SHOWS NO NEW FORCE while the punch is lifted: lift it by hand";
    }
    if (now_N > before_N + options.pressing_N) return stopped_as_wrong(now_N - before_N);
    if (now_N < -before_N - options.pressing_N) {
      is_force_left = true;
      devices.stop_hard();
      return "the specimen pulls at the punch with " + text_from_number(-now_N, 3) +
             " N, or toward_specimen or compression_is_positive of the rig file is wrong: lift it "
             "by hand";
    }
    if (is_stopping || !is_stop_asked()) continue;
    stage.stop_soft();
    is_stopping = true;
  }
  return is_stopping ? kStoppedEarly : "";
}

// Moves away from the specimen by a share of the distance. Returns what is wrong afterwards, or "";
// a force that does not fall is no reason for another attempt.
std::string PunchLift::lift(double share) {
  Stage& stage = devices.stage();
  const double before_N = std::abs(readings.force_N());
  const double from_m = stage.position_m();
  const double shortest_m = from_m - share * std::min(kLargestLift_m, pressed_m);
  const double to_m =
      is_only_stopped() ? from_m
      : devices.is_position_lost()
          ? shortest_m
          : std::min(from_m,
                     std::max(from_m - share * (from_m - options.retract_to_m), shortest_m));
  // A stage that stands within a step of where it shall go does not move.
  const bool has_way = (from_m - to_m) * stage.dynamics().steps_per_m > 1.0;
  if (has_way && is_stop_asked()) return kStoppedEarly;
  if (has_way) {
    const double speed_m_s =
        is_watched() ? std::min(options.speed_m_s, kWatchedSpeed_m_s) : options.speed_m_s;
    const double seen_s =
        was_moving ? press_seen_after_s(devices.load_cell().period_s(), clock.from_wall_s(1.0))
                   : 0.0;
    // A move away that a limit has ended goes on here, and may have shown already where it goes.
    readings.watch_rise({.from_s = std::max(clock.now_s() + seen_s, options.pressed_until_s),
                         .least_N = options.least_start_N,
                         .goes_on = readings.is_rise_open()});
    if (rises()) return stopped_as_wrong(readings.rise_N());
    stage.begin_move(to_m, speed_m_s, "retract");
    const double deadline_s = clock.awake_s() + kStandstill_wall_s + (from_m - to_m) / speed_m_s;
    const std::string stopped = watch(before_N, deadline_s);
    readings.forget_rise();
    if (stopped.empty() || stopped == kStoppedEarly) lifted_m = from_m - stage.position_m();
    if (!stopped.empty()) return stopped;
  }
  const bool was_pressing = before_N > options.pressing_N || !options.blind.empty();
  if (has_way && !(lifted_m > 0.0) && was_pressing) {
    return "THE PUNCH WAS NOT LIFTED: the controller's own travel ends where it stands (GRBL: "
           "$20, $130-132). Lift it by hand";
  }
  const bool is_judged = options.zero_drift_N || (lifted_m > 0.0 && was_pressing);
  return is_judged ? trouble_with_force(before_N, lifted_m > 0.0 && was_pressing) : "";
}

// What is wrong with the force after a lift, or "".
std::string PunchLift::trouble_with_force(double before_N, bool was_pressing) {
  const auto unseen = [&](const char* why) {
    if (!was_pressing) return std::string();
    return std::string("whether the force has fallen cannot be seen, because the load cell ") +
           why + ": look at the punch";
  };
  if (!options.blind.empty()) return unseen(options.blind.c_str());
  if (devices.is_cell_restarted()) return unseen("has restarted");
  if (!devices.is_cell_usable()) return unseen("is gone");
  const std::int64_t n_before = readings.n_forces();
  readings.collect_from(clock.now_s());
  const double wait_s =
      clock.now_s() + 10.0 * devices.load_cell().period_s() + clock.from_wall_s(0.1);
  while (clock.now_s() < wait_s) pump();
  const double lifted_at_s = wait_s - clock.from_wall_s(0.1);
  const double deadline_s = clock.awake_s() + kOldReadings_wall_s;
  while (readings.last_made_s() < lifted_at_s && readings.n_forces() > n_before &&
         clock.awake_s() < deadline_s) {
    pump();
  }
  readings.stop_collecting();
  if (devices.is_cell_restarted()) return unseen("has restarted");
  if (readings.n_forces() == n_before) return unseen("gives no force any more");
  if (readings.last_made_s() < lifted_at_s) return unseen("sends readings that are too old");
  const bool has_mean = readings.n_collected() >= kFewestOfMean;
  const ForceMean after = has_mean ? readings.collected_mean() : ForceMean();
  // On a slow line the first of them may be older than they seem.
  const double newest_N = std::abs(readings.force_N());
  const double force_N = has_mean ? std::min(std::abs(after.force_N), newest_N) : newest_N;
  const double free_N =
      options.zero_drift_N.value_or(0.0) + felt_difference_N(options.noise_N, after.n);
  if (options.knows_sign && has_mean && after.force_N < -free_N) {
    return "after the lift the force is " + text_from_number(after.force_N, 4) +
           " N: its zero has moved by that (the amplifier, or an open wire of the load cell), or "
           "the specimen pulls at the punch";
  }
  if (was_pressing && force_N > kFallen * before_N) {
    is_force_left = true;
    return "THE FORCE DOES NOT FALL after lifting the punch: lift it by hand";
  }
  if (!options.zero_drift_N || !has_mean) return "";
  if (force_N <= free_N) return "";
  is_force_left = true;
  return "THE PUNCH MAY STILL PRESS: after the lift the force is " +
         text_from_number(after.force_N, 4) + " N and not the zero of the tare within " +
         text_from_number(free_N, 4) + " N. Look at it, and lift it by hand unless it is free";
}

}  // namespace viscard
