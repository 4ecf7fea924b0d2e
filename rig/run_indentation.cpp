#include "rig/run_indentation.h"

#include "models/experiment/test_phases.h"
#include "models/maths/failure_text.h"
#include "models/maths/text_of_number.h"
#include "rig/run/approach_phase.h"
#include "rig/run/count_comparison.h"
#include "rig/run/force_phases.h"
#include "rig/run/preflight.h"
#include "rig/run/press_check.h"
#include "rig/run/rest_findings.h"
#include "rig/run/tare_phase.h"
#include "rig/run/test_run.h"
#include "rig/run/unload_check.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

namespace viscard {
namespace {

constexpr double kSamePlace_m = 10e-6;
constexpr double kSeenPeriods = 5.0;   // of the readings: a shorter wait shows no force
constexpr double kRestMean_s = 0.5;    // end of a baseline, whose mean is compared with the tare
constexpr double kRiseInHold = 0.03;   // of the peak
constexpr double kDepthAfter_s = 0.5;  // after a hold begins: the depth reached is noted then

// Carries out the phases of one test, one after another.
class IndentationRun {
 public:
  explicit IndentationRun(TestRun& run) : run_(run), force_phases_(run), unload_check_(run) {}

  void connect() {
    RunSession& session = run_.session;
    RunOutcome& outcome = run_.outcome;
    session.begin_phase("connect", planned_from_s(0), "Waiting for both devices");
    session.load_cell().accept_restarts(true);  // until the tare is done
    session.connect();
    run_.start_m = session.stage().position_m();
    outcome.expected = preflight(run_.rig, run_.plan, run_.specimen, session.stage().dynamics());
    session.expect_stiffness(outcome.expected.total_stiffness_N_m);
    for (const RestFinding& found : findings_of_stage(session.stage().dynamics())) {
      throw RigError(found.text);
    }
    if (!outcome.expected.problems.empty()) throw RigError(outcome.expected.problems.front());
    for (const std::string& text : outcome.expected.warnings) session.event("advice", "test", text);
    for (const std::string& text : session.stage().advice()) session.event("advice", "stage", text);
  }

  void measure() {
    is_begun_ = true;
    for (std::size_t i = 0; i < run_.phases.size(); ++i) {
      const TestPhase& phase = run_.phases[i];
      name_ = phase.name;
      if (!phase.load_key.empty()) run_.session.set_load_key(phase.load_key);
      run_.session.begin_phase(phase.name, planned_from_s(i), phase.text);
      carry_out(phase);
      const double lag_s = run_.session.take_lag_s();
      if (is_in_record(phase.kind) && lag_s > 0.0) doubt_lag(phase.name, lag_s);
    }
  }

  // Why the count was not compared after the test, or "".
  std::string compare(const RunControl& control) {
    name_ = kHomePhase;
    lifted_to_m_ = run_.session.stage().position_m();
    return compare_count(run_.session, run_.rig, control, run_.outcome);
  }

  // Where the lift of a test that is complete has ended; nothing before that.
  std::optional<double> lifted_to_m() const { return lifted_to_m_; }
  // Both devices are connected and the pre-flight check has found no problem.
  bool is_begun() const { return is_begun_; }
  // The phase that is carried out.
  const std::string& name() const { return name_; }
  // A stage position at which the punch is probably free. Once the test is complete, it is free
  // where it is, and a homing cycle that was cut short leaves a position without meaning.
  double safe_position_m() const {
    if (lifted_to_m_) return std::numeric_limits<double>::infinity();
    if (run_.outcome.contact_position_m) return run_.contact_m - run_.plan.retract_m;
    return presses_at_start() ? run_.start_m - run_.plan.retract_m : run_.start_m;
  }

  // If something presses before any move, it presses at the present position of the stage.
  bool presses_at_start() const {
    return run_.presses_at_start ||
           (is_begun_ && !run_.session.has_moved() &&
            std::abs(run_.session.force_N()) > kPressesAtStart * run_.rig.calibration.capacity_N);
  }

 private:
  // A fit reads the course of these moves.
  static bool is_in_record(TestPhase::Kind kind) {
    return kind == TestPhase::Kind::kMove || kind == TestPhase::Kind::kLoad ||
           kind == TestPhase::Kind::kHoldForce;
  }

  void doubt_lag(const std::string& phase, double lag_s) {
    run_.outcome.doubts.push_back(
        "in the phase '" + phase + "' the stage fell " + text_from_number(lag_s, 2) +
        " s behind the course that the record holds: its controller stood still for so long, or "
        "is slower than its settings say. Check its supply and what else keeps it busy, then "
        "repeat the run");
    run_.session.event("doubt", "stage_late", run_.outcome.doubts.back());
  }

  void carry_out(const TestPhase& phase) {
    switch (phase.kind) {
      case TestPhase::Kind::kTare:
        return carry_out_tare(run_, phase);
      case TestPhase::Kind::kApproach:
        return carry_out_approach(run_);
      case TestPhase::Kind::kWait:
        return lifted_from_N_ ? await_end(phase, *lifted_from_N_) : wait(phase);
      case TestPhase::Kind::kMove:
        return go_to_depth(phase);
      case TestPhase::Kind::kLoad:
        has_pressed_ = true;
        return force_phases_.load(phase);
      case TestPhase::Kind::kHoldForce:
        force_phases_.hold(phase);
        depth_asked_m_ = live_depth_m(run_);
        return;
      case TestPhase::Kind::kRetract:
        return retract();
    }
  }

  // In contact the wait counts from the end of the last move, or from now if that is later.
  void wait(const TestPhase& phase) {
    RunSession& session = run_.session;
    if (!run_.is_in_contact) {
      const double until_s = session.now_s() + phase.duration_s;
      const auto rest =
          session.mean_until_received(until_s, std::min(kRestMean_s, phase.duration_s));
      if (rest && !has_pressed_) check_zero(run_, *rest);
      return;
    }
    const double end_s = session.stage().expected_end_s();
    watch_hold(phase);
    session.pump_until(end_s + std::min(kDepthAfter_s, phase.duration_s));
    note_depth(run_);
    const bool is_first_press = std::exchange(is_first_press_, false);
    if (phase.duration_s > kSeenPeriods * session.load_cell().period_s()) {
      check_last_move();
      if (is_first_press) check_press(run_, depth_asked_m_);
    }
    if (const auto due_s = unload_check_.due_after_s(); due_s && *due_s <= phase.duration_s) {
      session.pump_until(end_s + *due_s);
      unload_check_.judge();
    }
    session.pump_until(end_s + phase.duration_s);
  }

  // At a depth: a specimen that sticks to a punch at its surface may jump off.
  void watch_hold(const TestPhase& phase) {
    RunSession& session = run_.session;
    if (session.stage().position_m() < run_.contact_m + kSamePlace_m) return;
    // After an unloading it may have come off, and touch again as it recovers.
    if (has_unloaded_ && session.sound_force_N(run_.outcome.noise_N) < 2.0 * zero_drift_N(run_)) {
      return;
    }
    const double rise_N = std::max(kRiseInHold * session.peak_force_N(), zero_drift_N(run_)) +
                          felt_difference_N(run_.outcome.noise_N, 1);
    session.watch_hold(phase.name, has_unloaded_ ? std::nullopt : std::optional(rise_N));
  }

  void go_to_depth(const TestPhase& phase) {
    const Preflight& expected = run_.outcome.expected;
    const double way_m = std::abs(expected.stage_travel_of(phase.depth_m - depth_asked_m_));
    const double speed_m_s = phase.move_s > 0.0 ? way_m / phase.move_s : phase.speed_m_s;
    run_.is_in_contact = true;
    last_move_ = {run_.session.stage().position_m(),
                  run_.session.sound_force_N(run_.outcome.noise_N)};
    run_.session.move(run_.contact_m + expected.stage_travel_of(phase.depth_m), speed_m_s,
                      phase.purpose);
    unload_check_.take_move(last_move_->from_m, last_move_->force_N, way_m / speed_m_s);
    is_first_press_ = !std::exchange(has_pressed_, true);
    has_unloaded_ = has_unloaded_ || run_.session.stage().position_m() < last_move_->from_m;
    depth_asked_m_ = phase.depth_m;
    // The newest reading is later than the end of the move, so a hold reads its depth itself.
    const TestPhase* next = &phase + 1;
    const bool is_held = next->kind == TestPhase::Kind::kWait && next->duration_s > 0.0;
    if (!is_held && phase.depth_m >= deepest_m(run_.phases)) note_depth(run_);
  }

  // The force must have followed the move before this wait: up by a tenth of what the stiffness of
  // the contact implies, or down by a tenth of what there was.
  void check_last_move() {
    if (!last_move_) return;
    const LastMove last = *last_move_;
    last_move_.reset();
    RunSession& session = run_.session;
    const double to_m = session.stage().position_m();
    const double change_N = session.sound_force_N(run_.outcome.noise_N) - last.force_N;
    const double implied_N = std::max(session.implied_N(last.from_m, to_m), -last.force_N);
    if (session.follows(implied_N, change_N)) return;
    run_.is_place_doubtful = true;
    if (to_m < last.from_m && change_N > session.judged_N()) session.end_wrong_way(change_N);
    RunSession::throw_unfollowed(to_m > last.from_m ? "pressed" : "unloaded", last.from_m, to_m,
                                 implied_N, change_N);
  }

  void retract() {
    RunSession& session = run_.session;
    const double before_N = session.sound_force_N(run_.outcome.noise_N);
    run_.is_in_contact = false;
    session.move(safe_position_m(), run_.plan.retract_speed_m_s, "retract");
    if (check_lifted(run_, before_N, LiftEnd::kNow)) lifted_from_N_ = before_N;
  }

  // A punch that was free after the lift must still be at the end: an axis can sink.
  void await_end(const TestPhase& phase, double before_N) {
    const double end_s = run_.session.now_s() + phase.duration_s;
    if (const double mean_s = lift_mean_s(run_); phase.duration_s > mean_s) {
      run_.session.pump_until(end_s - mean_s);
      check_lifted(run_, before_N, LiftEnd::kLater);
    }
    run_.session.pump_until_received(end_s);
  }

  double planned_from_s(std::size_t phase) const {
    const double approach_s = 0.5 * run_.plan.approach_limit_m / run_.plan.approach_speed_m_s;
    return planned_s(run_.phases, phase, approach_s);
  }

  TestRun& run_;
  ForcePhases force_phases_;
  UnloadCheck unload_check_;
  struct LastMove {
    double from_m = 0.0, force_N = 0.0;
  };
  std::optional<LastMove> last_move_;  // in contact, not judged yet
  bool has_pressed_ = false;           // into the specimen, beyond the touch
  bool is_first_press_ = false;        // the last move, not judged yet
  bool has_unloaded_ = false;          // in contact, once at least
  double depth_asked_m_ = 0.0;         // where the last phase that changed the depth has left it
  std::optional<double> lifted_to_m_;
  // The force before the last lift, after which it was free.
  std::optional<double> lifted_from_N_;
  bool is_begun_ = false;
  std::string name_ = "connect";
};

std::string mm_text(double length_m) {
  return text_from_number(length_m * 1e3, 3) + " mm";
}

// Position of the punch relative to the contact or, before the contact is known, to the start.
std::string place_of_stage(TestRun& run) {
  const double position_m = run.session.stage().position_m();
  if (run.outcome.contact_position_m) {
    const double clear_m = run.contact_m - position_m;
    return clear_m > 0.0 ? "the punch is " + mm_text(clear_m) + " above the contact"
                         : "the punch is still " + mm_text(-clear_m) + " below the contact";
  }
  const double above_m = run.start_m - position_m;
  if (std::abs(above_m) < kSamePlace_m) return "it stands where it started";
  return "it stands " + mm_text(std::abs(above_m)) + (above_m > 0.0 ? " above" : " below") +
         " where it started";
}

// Where the punch is after a run that ended early: the first information that a person at the rig
// needs. Empty if only the trouble of the lift is known.
std::string place_of_punch(TestRun& run, const SafeEnd& end, bool had_moved, bool knows_position) {
  const std::string counted = run.is_place_doubtful ? "by its count, which is in doubt, " : "";
  if (end.lifted_m > 0.0) {
    return ". The stage was stopped and " + counted + "lifted by " + mm_text(end.lifted_m) +
           (knows_position ? ": " + place_of_stage(run)
                           : " from where it stood; its position is not known any more");
  }
  if (!end.trouble.empty() && !end.is_force_left) return "";
  if (!had_moved) return ". The stage was not moved: the punch is where it was before the run";
  return knows_position ? ". The stage was stopped: " + counted + place_of_stage(run)
                        : ". The stage was stopped; it was not lifted: look at the punch";
}

std::string place_in_homing(const TestRun& run, double lifted_to_m) {
  return ". The test was complete; the stage was stopped while it was homed, after a lift to " +
         mm_text(run.contact_m - lifted_to_m) + " above the contact";
}

template <typename Type>
bool is_a(const std::exception& error) {
  return dynamic_cast<const Type*>(&error) != nullptr;
}

// The code is for programs; the reason is for people.
std::string code_of_end(const std::exception& error, bool presses_at_start) {
  if (presses_at_start || is_a<PressesAtStart>(error)) return "pressing";
  if (is_a<LimitReached>(error)) return "force-limit";
  if (is_a<RunInterrupted>(error)) return "interrupted";
  if (is_a<PortHungUp>(error)) return "device-lost";
  if (is_a<DeviceRestarted>(error)) return "device-restarted";
  if (is_a<StageAlarm>(error)) return "stage-alarm";
  if (is_a<ReadingsTooOld>(error)) return "readings-old";
  if (is_a<CellIsDead>(error)) return "cell-dead";
  if (is_a<ForceDoesNotFollow>(error)) return "no-response";
  if (is_a<StageGoesWrongWay>(error)) return "wrong-way";
  if (is_a<PunchNotFree>(error)) return "not-lifted";
  if (is_a<ComputerLate>(error)) return "computer-late";
  return is_a<RigError>(error) ? "device" : "failed";
}

// Ends a run that did not finish: notes why, stops the stage and lifts the punch.
void end_early(TestRun& run, const IndentationRun& phases, const char* status,
               const std::exception& error) {
  RunOutcome& outcome = run.outcome;
  outcome.status = status;
  outcome.cause = failure_text(error, "this run");
  outcome.reason = outcome.cause;
  // After a delay of this computer the rig may not be the cause of what follows.
  const std::string late = run.session.lateness_text();
  if (!is_a<RunInterrupted>(error) && !late.empty() &&
      outcome.reason.find(late) == std::string::npos) {
    outcome.reason = late + ". What followed may come from that: " + outcome.reason;
  }
  outcome.code = code_of_end(error, phases.presses_at_start());
  outcome.phase = phases.name();
  outcome.has_begun = run.session.has_moved() && run.is_tared;
  if (run.is_in_contact) note_depth(run);
  const bool goes_wrong_way = is_a<StageGoesWrongWay>(error);
  if (goes_wrong_way || is_a<ForceDoesNotFollow>(error)) run.is_place_doubtful = true;
  // PunchNotFree has judged the force after a lift already, and a stage that presses when it shall
  // lift is not moved any more.
  const bool is_zero_known = run.is_tared && !goes_wrong_way && !is_a<PunchNotFree>(error);
  const SafeEnd end = run.session.make_safe(
      goes_wrong_way ? run.session.stage().position_m() : phases.safe_position_m(),
      run.plan.retract_speed_m_s, is_zero_known ? std::optional(zero_drift_N(run)) : std::nullopt);
  if (end.is_force_left) run.is_place_doubtful = true;
  const bool knows_position =
      !is_a<DeviceRestarted>(error) && !is_a<StageAlarm>(error) && !run.session.is_position_lost();
  outcome.reason += phases.lifted_to_m()
                        ? place_in_homing(run, *phases.lifted_to_m())
                        : place_of_punch(run, end, run.session.has_moved(), knows_position);
  if (!end.trouble.empty()) outcome.reason += ". And: " + end.trouble;
}

}  // namespace

RunOutcome run_indentation(Stage& stage, LoadCell& load_cell, const RigConfig& rig,
                           const TestPlan& plan, const Specimen& specimen, const RecordSink& sink,
                           const RunControl& control) {
  if (rig.stage.home) stage.plan_count_check(control.homed_before);
  const RecordSink safe_sink = failing_once(sink);
  RunSession session(stage, load_cell, rig, safe_sink, control);
  TestRun run{session, rig, plan, specimen, phases_from_plan(plan), {}};
  run.lifts_at_start = control.lifts_at_start;
  run.has_answered = control.has_answered || !rig.load_cell.answered_on.empty();
  IndentationRun phases(run);
  const auto carry_out = [&](const std::function<void()>& part) {
    try {
      part();
    } catch (const LimitReached& error) {
      if (!session.is_stage_connected()) throw;
      end_early(run, phases, "stopped", error);
    } catch (const std::exception& error) {
      if (!phases.is_begun()) throw;
      end_early(run, phases, "interrupted", error);
    }
  };
  carry_out([&] {
    phases.connect();
    phases.measure();
    run.outcome.status = "finished";
    run.outcome.has_begun = true;
  });
  judge_record(session, rig, control, run.outcome);
  std::string not_compared = kNotHomed;
  if (run.outcome.status == "finished") {
    carry_out([&] { not_compared = phases.compare(control); });
  }
  record_end(session, not_compared, run.outcome);
  return run.outcome;
}

}  // namespace viscard
