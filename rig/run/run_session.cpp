#include "rig/run/run_session.h"

#include "models/experiment/sample_force.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace viscard {
namespace {

constexpr int kFewestReadings = 5;  // of a mean
constexpr double kLate_wall_s = 1.0;
constexpr double kLateMean_wall_s = 3.0;
// On an emulated clock that runs fast, every stall of the machine counts as seconds of rig time.
constexpr double kOldEmulated_wall_s = 2.0;
constexpr double kWhileUnwatched_wall_s = 0.5;  // after a delay its readings are judged
constexpr double kJumpShare = 0.5;              // of the capacity, between two readings
constexpr double kPressingShare = 0.1;          // of the soft limit

double counts_per_N(const RigConfig& rig) {
  const double volts = std::abs(rig.load_cell.volts_per_count);
  return volts > 0.0 ? std::abs(rig.calibration.volts_per_newton) / volts : 0.0;
}

std::string force_text(double force_N) {
  return text_from_number(force_N, 3) + " N";
}

}  // namespace

RunSession::RunSession(Stage& stage, LoadCell& load_cell, const RigConfig& rig,
                       const RecordSink& sink, const RunControl& control)
    : rig_(rig),
      sink_(sink),
      control_(control),
      clock_(*control.clock),
      devices_(stage, load_cell, control.thermometer, clock_),
      readings_(rig_),
      marks_(clock_, sink_),
      guard_(rig.safety, rig.calibration.capacity_N),
      ages_(rig.calibration.capacity_N,
            clock_.speed() > 1.0 ? clock_.from_wall_s(kOldEmulated_wall_s) : 0.0),
      progress_(control_, rig.frame.stiffness_N_m),
      n_late_before_(clock_.lateness().n_long()),
      n_late_(n_late_before_) {
  load_cell.set_listener([this](const LoadSample& sample) { take_sample(sample); });
}

RunSession::~RunSession() {
  devices_.load_cell().set_listener({});
}

void RunSession::connect() {
  is_guarded_ = true;  // the stop flag counts from here
  devices_.connect([this] { pump(); });
}

void RunSession::pump() {
  devices_.serve(is_guarded_);
  check_lateness();
  if (control_.stop_at_once != nullptr && *control_.stop_at_once) stop_at_once();
  if (is_guarded_) {
    if (control_.stop != nullptr && *control_.stop) {
      throw RunInterrupted("the run was interrupted; what was recorded is kept");
    }
    check_stream();
    check_age();
    check_follow();
    // At rest a doubtful reading waits for the next one; a stream that has stopped is noticed above.
    if (guards_force() && stage().is_moving())
      act_on(guard_.silent_until(clock_.now_s()), readings_.force_N());
  }
  progress_.report(readings_.force_N(), devices_.stage().position_m());
}

void RunSession::pump_until(double time_s) {
  while (clock_.now_s() < time_s) pump();
}

void RunSession::pump_until_received(double time_s) {
  pump_until(time_s);
  const double deadline_s = clock_.awake_s() + kLate_wall_s;
  while (readings_.last_made_s() < time_s - load_cell().period_s() &&
         clock_.awake_s() < deadline_s) {
    pump();
  }
}

std::optional<ForceMean> RunSession::mean_until_received(double time_s, double mean_s) {
  readings_.collect_from(time_s - mean_s);
  pump_until_received(time_s);
  readings_.stop_collecting();
  if (readings_.n_collected() < kFewestReadings) return std::nullopt;
  return readings_.collected_mean();
}

void RunSession::expect_force(double contact_m, double stiffness_N_m) {
  follow_ = {contact_m, stiffness_N_m};
  step_N_ = stiffness_N_m / stage().dynamics().steps_per_m;
}

// Before the stage is connected it can be neither stopped nor lifted, and only homing moves it.
bool RunSession::guards_force() const {
  return is_guarded_ && (devices_.is_stage_connected() || rig_.stage.home);
}

void RunSession::take_sample(const LoadSample& sample) {
  const double made_at_s = load_cell().made_at_s(sample);
  const auto [force_N, is_doubtful] = readings_.take(sample, made_at_s);
  is_doubtful_ = is_doubtful;
  if (!is_doubtful) {
    ages_.take(force_N, made_at_s);
    take_hold(force_N, made_at_s);
    progress_.report_reading(made_at_s, force_N, stage().position_m(), stage().is_moving());
  }
  std::optional<double> value;
  if (!is_doubtful) value = sample.counts ? sample.counts : force_N_from_sample(sample, rig_);
  marks_.expect_step(step_N_ * (sample.counts ? counts_per_N(rig_) : 1.0));
  marks_.take(sample, value, load_cell().period_s());
  if (!guards_force() && !devices_.is_stopping()) return;
  const GuardAction action = guard_.take(force_N, is_doubtful, sample.host_time_s,
                                         load_cell().period_s(), stage().is_moving());
  if (action == GuardAction::kNone || action == GuardAction::kWarn) take_life(sample, made_at_s);
  if (is_guarded_) {
    const bool is_limit = action == GuardAction::kSoftStop || action == GuardAction::kHardStop;
    const double rise_N = readings_.rise_N();
    if (!is_wild_ && rise_N > (is_limit ? judged_N() : most_rise_N())) end_wrong_way(rise_N);
    act_on(action, force_N);
  } else if (action == GuardAction::kHardStop) {
    stop_hard_while_stopping(force_N);
  }
}

// A person asked for it. The lift afterwards begins with a recovery, so a second stop is not needed.
void RunSession::stop_at_once() {
  if (has_stopped_at_once_) return;
  has_stopped_at_once_ = true;
  const bool was_moving = devices_.is_stage_connected() && stage().is_moving();
  devices_.end_gentle_stop();
  if (was_moving) devices_.stop_hard();
  event("limit", "person",
        was_moving ? "A person asked to stop at once: the stage was reset"
                   : "A person asked to stop at once; the stage stood still");
  if (is_guarded_) throw RunInterrupted("the run was stopped at once; what was recorded is kept");
}

// The gentle stop of make_safe() was too slow.
void RunSession::stop_hard_while_stopping(double force_N) {
  devices_.end_gentle_stop();
  devices_.stop_hard();
  event("limit", "hard",
        "The force still rose to " + force_text(force_N) + ": the stage was reset");
}

void RunSession::act_on(GuardAction action, double force_N) {
  switch (action) {
    case GuardAction::kNone:
      return;
    case GuardAction::kWarn:
      event("limit", "warn", "The force of " + force_text(force_N) + " nears the cell's limit");
      return;
    case GuardAction::kSoftStop:
      // No way to slow down is left if the stage goes the wrong way.
      if (stage().is_moving() && readings_.is_rise_open() && force_N > 0.0) {
        devices_.stop_hard();
      } else if (stage().is_moving()) {
        stage().stop_soft();
      }
      event("limit", "soft",
            "The force of " + force_text(force_N) + " is above the limit of " +
                force_text(guard_.soft_limit_N()) + ": the stage is stopped");
      break;
    case GuardAction::kHardStop:
      devices_.stop_hard();
      event("limit", "hard",
            "The force of " + force_text(force_N) +
                " is too high or cannot be read: the stage is reset");
      break;
  }
  throw_limit(action, force_N);
}

// The advice depends on how far the run has come. At this point it is not known whether the punch
// can be lifted.
void RunSession::throw_limit(GuardAction action, double force_N) {
  const bool is_hard = action == GuardAction::kHardStop;
  if (is_hard && is_doubtful_) {
    throw LimitReached(
        "readings of the load cell make no force: they are the end of the converter's range (an "
        "open wire of the cell, or an overload), and what cannot be read may be too much. Check "
        "the wires, and the load cell with: viscard rig check");
  }
  const std::string late = lateness_text(kWhileUnwatched_wall_s);
  const double before_N = readings_.earlier_N();
  const double jump_N = std::abs(force_N) - std::abs(before_N);
  if (has_moved_ && late.empty() && jump_N > kJumpShare * rig_.calibration.capacity_N) {
    blind_ = "is not to be trusted";
    throw LimitReached("the force jumped from " + force_text(before_N) + " to " +
                       force_text(force_N) +
                       " within one reading, which no stage can press so fast: a wire of the load "
                       "cell is open, or its amplifier fails. Check both with: viscard rig check");
  }
  const std::string reached = "the force reached " + force_text(force_N) + ", above the " +
                              (is_hard ? "hard limit of " + force_text(guard_.hard_limit_N())
                                       : "limit of " + force_text(guard_.soft_limit_N()));
  if (has_moved_ && !late.empty()) {
    throw LimitReached(reached + ", when nobody watched it: " + late);
  }
  if (!has_moved_ && !is_stage_connected()) {
    throw LimitReached(
        reached + ", while the stage was connected" + (rig_.stage.home ? " and homed" : "") +
        ": IT MAY STILL PRESS. Look at the punch, lift it with: viscard rig lift. If "
        "nothing touches it, correct zero_volts of the calibration");
  }
  if (!has_moved_) {
    throw LimitReached(reached +
                       ", before anything was moved: the punch was already pressing, or something "
                       "else presses on the cell. Take that away, or correct zero_volts of the "
                       "calibration");
  }
  if (progress_.phase() == kHomePhase) {
    throw LimitReached(reached +
                       ", while the stage was homed after the test. Look what touches the punch or "
                       "pulls at the load cell, then start the run again");
  }
  if (readings_.is_rise_open()) {
    throw LimitReached(reached + ", in a move away from the specimen");
  }
  if (!progress_.has_contact()) {
    throw LimitReached(reached +
                       ", in the approach. Lower speed under [approach] of the test file, or "
                       "check modulus_guess of the specimen");
  }
  throw LimitReached(reached + ". Lower " + load_key_ +
                     " of the test file, or check modulus_guess of the "
                     "specimen");
}

void RunSession::check_stream() {
  const auto silence = devices_.silence();
  if (!silence) return;
  const bool is_moving = stage().is_moving();
  if (is_moving) devices_.stop_hard();
  event("limit", "silent",
        "No reading of the load cell for " + text_from_number(silence->silent_s, 3) + " s " +
            (is_moving ? "while the stage moved" : "at rest") + ", which may be " +
            text_from_number(silence->limit_s, 3) + " s" + (is_moving ? ": it was reset" : ""));
  const std::string slower = life_.usual_rate_Hz() > 0.0
                                 ? " (or its rate has dropped far below the " +
                                       text_from_number(life_.usual_rate_Hz(), 1) +
                                       "/s of the tare)"
                                 : "";
  throw CellIsSilent(std::string("the load cell fell silent ") +
                     (is_moving ? "while the stage was moving; the stage was stopped"
                                : "while the stage stood still") +
                     slower + ". Check the amplifier and its cable, then start the run again");
}

ForceMean RunSession::mean_force(double asked_s) {
  // A slow cell needs longer for its fewest readings.
  const double duration_s = std::max(asked_s, (kFewestReadings + 1) * load_cell().period_s());
  const double start_s = clock_.now_s();
  const double deadline_s = clock_.awake_s() + duration_s / clock_.speed() + kLateMean_wall_s;
  readings_.collect_from(start_s);
  while (readings_.collected_until_s() < start_s + duration_s && clock_.awake_s() < deadline_s)
    pump();
  readings_.stop_collecting();
  const int n = readings_.n_collected();
  if (n < kFewestReadings) {
    if (readings_.newest_made_s() < start_s && load_cell().last_arrival_s() > start_s) {
      throw_too_old("when its force was needed");
    }
    throw RigError("only " + counted(static_cast<std::size_t>(n), "reading") +
                   " of a force came in " + text_from_number(duration_s, 1) +
                   " s. Check the load cell's rate with: viscard rig check");
  }
  return readings_.collected_mean();
}

ForceMean RunSession::tare(double duration_s) {
  const ForceMean mean = mean_force(duration_s);
  readings_.add_to_tare(mean.force_N);
  noise_N_ = mean.sd_N;
  event("tare", text_from_number(readings_.tare_N(), 6),
        "Zero is at " + text_from_number(readings_.tare_N(), 4) + " N of the calibration; noise " +
            text_from_number(mean.sd_N * 1e3, 3) + " mN per reading");
  return mean;
}

void RunSession::begin_phase(const std::string& name, double planned_rest_s,
                             const std::string& text) {
  progress_.begin_phase(name, planned_rest_s);
  event("phase", name, text);
}

void RunSession::event(const std::string& name, const std::string& value, const std::string& text) {
  sink_(RunEvent{clock_.now_s(), name, value, text});
}

SafeEnd RunSession::make_safe(double retract_to_m, double speed_m_s,
                              std::optional<double> zero_drift_N) {
  is_guarded_ = false;
  hold_.end();
  // A stop that has ended the run does not end its lift.
  const bool can_stop = !has_moved_ && control_.stop != nullptr && !*control_.stop;
  PunchLift lift{devices_,
                 readings_,
                 clock_,
                 [this] { pump(); },
                 {.retract_to_m = retract_to_m,
                  .speed_m_s = speed_m_s,
                  .pressing_N = kPressingShare * guard_.soft_limit_N(),
                  .blind = blind_,
                  .noise_N = noise_N_,
                  .zero_drift_N = zero_drift_N,
                  .watches = !has_moved_,
                  .stop = can_stop ? control_.stop : nullptr,
                  .knows_sign = follow_.stiffness_N_m > 0.0,
                  .most_rise_N = is_wild_ ? std::numeric_limits<double>::infinity() : most_rise_N(),
                  .pressed_until_s = pressed_until_s_,
                  .least_start_N = least_start_N()}};
  return lift.carry_out();
}

void RunSession::stop_if_moving() {
  if (!stage().is_moving()) return;
  try {
    devices_.stop_hard();
  } catch (const PortHungUp&) {  // the error before has named it
  }
}

void RunSession::guard_again() {
  guard_ = ForceGuard(rig_.safety, rig_.calibration.capacity_N);
  is_guarded_ = true;
}

}  // namespace viscard
