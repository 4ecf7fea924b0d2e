// How a RunSession watches over the rig, and leaves it when something went wrong.
#include "models/maths/text_of_number.h"
#include "rig/run/run_session.h"

#include <algorithm>
#include <cmath>
#include <exception>

namespace viscard {
namespace {

constexpr double kStop_wall_s = 10.0;   // longest wait for standstill
constexpr double kUnloadStep_m = 2e-3;  // a lift is one move; this bounds it, contact known or not
constexpr int kAttempts = 4;
constexpr double kPressing = 0.1;  // of the soft limit

std::string in_N(double force_N) {
  return text_from_number(force_N, 3) + " N";
}

}  // namespace

void RunSession::act_on(GuardAction action, double force_N) {
  switch (action) {
    case GuardAction::kNone:
      return;
    case GuardAction::kWarn:
      event("limit", "warn", "The force of " + in_N(force_N) + " nears the cell's limit");
      return;
    case GuardAction::kSoftStop:
      if (stage_.is_moving()) stage_.stop_soft();
      event("limit", "soft",
            "The force of " + in_N(force_N) + " is above the limit of " +
                in_N(guard_.soft_limit_N()) + ": the stage is stopped");
      break;
    case GuardAction::kHardStop:
      needs_recovery_ = true;
      stage_.stop_hard();
      event("limit", "hard",
            "The force of " + in_N(force_N) + " is too high or cannot be read: the stage is reset");
      break;
  }
  throw_limit(action, force_N);
}

// What to do about it depends on how far the run had come. Whether the punch could be lifted is not
// known yet.
void RunSession::throw_limit(GuardAction action, double force_N) const {
  const bool is_hard = action == GuardAction::kHardStop;
  if (is_hard && std::abs(force_N) < guard_.hard_limit_N()) {
    throw LimitReached(
        "readings of the load cell make no force (end of the converter's range, "
        "overload, or a broken wire), and what cannot be read may be too much. Check the load cell "
        "with: viscard rig check");
  }
  const std::string reached = "the force reached " + in_N(force_N) + ", above the " +
                              (is_hard ? "hard limit of " + in_N(guard_.hard_limit_N())
                                       : "limit of " + in_N(guard_.soft_limit_N()));
  if (!has_moved_) {
    throw LimitReached(reached +
                       ", before anything was moved: the punch is already pressing. Lift it by "
                       "hand or jog it away; if nothing presses, correct zero_volts of the "
                       "calibration");
  }
  if (!contact_m_) {
    throw LimitReached(reached +
                       ", in the approach. Lower speed under [approach] of the test file, or "
                       "check modulus_guess of the specimen");
  }
  throw LimitReached(reached +
                     ". Lower depth under [ramp] of the test file, or check modulus_guess of the "
                     "specimen");
}

void RunSession::check_stream() {
  if (!is_cell_connected_ || !stage_.is_moving()) return;
  const double period_s = load_cell_.period_s() / clock_.speed();
  if (!silence_.is_silent(period_s)) return;
  needs_recovery_ = true;
  stage_.stop_hard();
  event("limit", "silent",
        "No reading of the load cell for " + text_from_number(silence_.silent_s(), 3) +
            " s while the stage moved, which may be " +
            text_from_number(silence_.limit_s(period_s), 3) + " s: it was reset");
  throw RigError(
      "the load cell fell silent while the stage was moving; the stage was stopped. Check "
      "the amplifier and its cable, then start the run again");
}

// Away from the specimen, slowly, by a share of the way. Says so if the force does not fall, which
// no second try mends.
std::string RunSession::lift(double retract_to_m, double speed_m_s, double share) {
  const double before_N = std::abs(force_N_);
  const double from_m = stage_.position_m();
  const double lifted_m = from_m - share * kUnloadStep_m;
  const double to_m =
      is_place_lost_
          ? lifted_m
          : std::min(from_m, std::max(from_m - share * (from_m - retract_to_m), lifted_m));
  if (to_m < from_m) {
    stage_.begin_move(to_m, speed_m_s, "retract");
    const double deadline_s = monotonic_s() + kStop_wall_s + (from_m - to_m) / speed_m_s;
    while (stage_.is_moving() && monotonic_s() < deadline_s) pump();
    lifted_m_ = from_m - stage_.position_m();
  }
  const bool was_pressing = before_N > kPressing * guard_.soft_limit_N();
  if (to_m < from_m && !(lifted_m_ > 0.0) && was_pressing) {
    return "THE PUNCH WAS NOT LIFTED: the controller's own travel ends where it stands ($20, "
           "$130-132). Lift it by hand";
  }
  return lifted_m_ > 0.0 && was_pressing ? force_after_lift(before_N) : "";
}

// "", or what is wrong with the force after a lift.
std::string RunSession::force_after_lift(double before_N) {
  const auto unseen = [](const char* why) {
    return std::string("whether the force has fallen cannot be seen, because the load cell ") +
           why + ": look at the punch";
  };
  if (is_cell_restarted_) return unseen("has restarted");
  if (!is_cell_connected_ || is_cell_lost_) return unseen("is gone");
  const std::int64_t n_before = n_forces_;
  const double wait_s = clock_.now_s() + 10.0 * load_cell_.period_s() + clock_.from_wall_s(0.1);
  while (clock_.now_s() < wait_s) pump();
  if (is_cell_restarted_) return unseen("has restarted");
  if (n_forces_ == n_before) return unseen("gives no force any more");
  if (std::abs(force_N_) <= 0.9 * before_N) return "";
  return "THE FORCE DOES NOT FALL after lifting the punch: lift it by hand";
}

std::string RunSession::make_safe(double retract_to_m, double speed_m_s) {
  is_armed_ = false;
  const Pump pump = [this] { this->pump(); };
  // More tries after a reset: a stage in alarm refuses the first, and a limit switch that opens
  // again on the way alarms once more.
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    try {
      if (attempt == 0 && stage_.is_moving() && !needs_recovery_) {
        is_stopping_ = true;
        stage_.stop_soft();
        const double deadline_s = monotonic_s() + kStop_wall_s;
        while (stage_.is_moving() && !needs_recovery_ && monotonic_s() < deadline_s) this->pump();
      }
      is_stopping_ = false;
      if (attempt > 0 || needs_recovery_) stage_.recover(pump);
      needs_recovery_ = false;
      // A stage that refuses to go so far (its own limits) may go part of it.
      return lift(retract_to_m, speed_m_s, std::pow(0.5, attempt));
    } catch (const PortHungUp& error) {
      return std::string(error.what()) +
             ". THE STAGE CANNOT BE STOPPED FROM HERE: use its emergency stop and lift the punch "
             "by hand";
    } catch (const std::exception& error) {
      if (attempt + 1 == kAttempts) return error.what();
    }
  }
  return "";
}

}  // namespace viscard
