#include "rig/run_indentation.h"

#include "rig/run_session.h"
#include "rig/text_number.h"

#include <algorithm>
#include <cmath>
#include <exception>

namespace viscard {
namespace {

constexpr double kTare_s = 1.0;
constexpr double kSettle_s = 0.25;      // force after a stop, long against the readings' period
constexpr double kContactSigmas = 6.0;  // of one reading's noise
constexpr double kJog_m = 25e-6;        // longest way a dead host lets the stage go near contact
constexpr int kMostBackOffs = 10;
constexpr double kLoadedAtStart = 0.5;  // of the soft limit: something already presses

std::string in_um(double length_m) {
  return text_from_number(length_m * 1e6, 1) + " um";
}

class IndentationRun {
 public:
  IndentationRun(RunSession& session, const RigConfig& rig, const TestPlan& plan,
                 const Specimen& specimen)
      : session_(session), rig_(rig), plan_(plan), specimen_(specimen) {}

  void connect();
  void measure();
  // Where the punch is surely free, as far as is known.
  double safe_position_m() const;

  RunOutcome outcome;

 private:
  void prepare();
  void approach();
  void back_off(double contact_m);
  void ramp_and_hold();
  void unload_and_recover();
  void retract();
  double rest_s(double from_phase) const;

  RunSession& session_;
  const RigConfig& rig_;
  const TestPlan& plan_;
  const Specimen& specimen_;
  double start_m_ = 0.0;
  double contact_m_ = 0.0;
};

// What is planned from phase n on: 0 baseline, 1 ramp, 2 hold, 3 unload, 4 retract.
double IndentationRun::rest_s(double from_phase) const {
  const bool has_recovery = plan_.recovery_s > 0.0;
  double rest_s = plan_.baseline_s + 1.0;
  if (from_phase <= 3 && has_recovery) rest_s += plan_.recovery_s;
  if (from_phase <= 2) rest_s += plan_.hold_s;
  if (from_phase <= 1) rest_s += plan_.ramp_s;
  if (from_phase <= 0) rest_s += plan_.baseline_s;
  return rest_s;
}

void IndentationRun::connect() {
  const double way_s = 0.5 * plan_.approach_limit_m / plan_.approach_speed_m_s;
  session_.begin_phase("connect", rest_s(0) + way_s, "Waiting for both devices");
  session_.connect();
  outcome.expected = preflight(rig_, plan_, specimen_, session_.stage().dynamics());
  if (!outcome.expected.problems.empty()) throw RigError(outcome.expected.problems.front());
  for (const std::string& text : outcome.expected.warnings) session_.event("advice", "test", text);
  for (const std::string& text : session_.stage().advice()) session_.event("advice", "stage", text);
  start_m_ = session_.stage().position_m();
}

void IndentationRun::measure() {
  prepare();
  approach();
  session_.begin_phase("baseline", rest_s(0), "Out of contact, before the ramp");
  session_.pump_until(session_.now_s() + plan_.baseline_s);
  ramp_and_hold();
  if (plan_.recovery_s > 0.0) unload_and_recover();
  retract();
}

void IndentationRun::prepare() {
  session_.begin_phase("tare", rest_s(0), "Zero of the load cell");
  const ForceMean zero = session_.tare(kTare_s);
  outcome.noise_N = zero.sd_N;
  if (std::abs(zero.force_N) > kLoadedAtStart * outcome.expected.limit_N) {
    throw RigError("the load cell reads " + text_from_number(zero.force_N, 3) +
                   " N before anything was touched. Take away what presses on it, or correct "
                   "zero_volts of the calibration");
  }
}

void IndentationRun::approach() {
  session_.begin_phase("approach", rest_s(0), "In short jogs until the punch touches");
  const double threshold_N = std::max(plan_.contact_force_N, kContactSigmas * outcome.noise_N);
  if (threshold_N > plan_.contact_force_N) {
    session_.event("advice", "noise",
                   "Contact is told from " + text_from_number(threshold_N, 4) +
                       " N on, because of the noise, instead of contact_force");
  }
  const double limit_m = start_m_ + plan_.approach_limit_m;
  while (true) {
    const double next_m = session_.stage().position_m() + kJog_m;
    if (next_m > limit_m) {
      throw RigError("nothing was touched within " +
                     text_from_number(plan_.approach_limit_m * 1e3, 2) +
                     " mm. Bring the punch nearer to the specimen, or raise limit under "
                     "[approach] of the test file");
    }
    if (session_.move(next_m, plan_.approach_speed_m_s, "approach", threshold_N)) break;
  }
  const ForceMean touched = session_.mean_force(kSettle_s);
  const double here_m = session_.stage().position_m();
  back_off(here_m - touched.force_N / outcome.expected.total_stiffness_N_m);
}

// To gap_m above contact; further where the force says that the guess of the modulus was too high.
void IndentationRun::back_off(double contact_m) {
  for (int i = 0; i < kMostBackOffs; ++i) {
    session_.move(contact_m - plan_.gap_m, plan_.retract_speed_m_s, "back off");
    const ForceMean free = session_.mean_force(kSettle_s);
    const double free_N = kContactSigmas * outcome.noise_N / std::sqrt(free.n) + 1e-4;
    if (std::abs(free.force_N) < free_N + 0.2 * plan_.contact_force_N) {
      contact_m_ = contact_m;
      outcome.contact_position_m = contact_m;
      session_.set_contact_m(contact_m);
      session_.event("contact", text_from_number(contact_m, 8),
                     "Touched at " + text_from_number(contact_m * 1e3, 4) + " mm; backed off by " +
                         in_um(contact_m - session_.stage().position_m()));
      return;
    }
    contact_m -= plan_.gap_m;
  }
  throw RigError(
      "the force does not return to zero when the punch is backed off. Is the specimen "
      "sticky, or does the cell drift? Raise gap under [approach] of the test file");
}

void IndentationRun::ramp_and_hold() {
  const Preflight& expected = outcome.expected;
  session_.begin_phase("ramp", rest_s(1), "To full depth at constant speed");
  session_.move(contact_m_ + expected.stage_travel_m, expected.ramp_speed_m_s, "ramp");
  const double end_s = session_.stage().expected_end_s();
  session_.begin_phase("hold", rest_s(2), "Relaxation at full depth");
  const double frame_N_m = rig_.frame.stiffness_N_m;
  session_.pump_until(end_s + std::min(0.5, plan_.hold_s));
  outcome.achieved_depth_m = session_.stage().position_m() - contact_m_ -
                             (frame_N_m > 0.0 ? session_.force_N() / frame_N_m : 0.0);
  session_.pump_until(end_s + plan_.hold_s);
}

void IndentationRun::unload_and_recover() {
  session_.begin_phase("unload", rest_s(3), "Quickly to a part of the depth, still in contact");
  const double to_m = contact_m_ + plan_.unload_to_fraction * outcome.expected.stage_travel_m;
  session_.move(to_m, plan_.unload_speed_m_s, "unload");
  const double end_s = session_.stage().expected_end_s();
  session_.begin_phase("recovery", rest_s(3), "Hold after the unloading");
  session_.pump_until(end_s + plan_.recovery_s);
}

void IndentationRun::retract() {
  session_.begin_phase("retract", rest_s(4), "Off the specimen");
  session_.move(safe_position_m(), plan_.retract_speed_m_s, "retract");
  session_.begin_phase("baseline_after", plan_.baseline_s, "Out of contact, after the test");
  session_.pump_until(session_.now_s() + plan_.baseline_s);
}

double IndentationRun::safe_position_m() const {
  return outcome.contact_position_m ? contact_m_ - plan_.retract_m : start_m_;
}

// Says how it ended, without hiding the reason when even that cannot be written any more.
void conclude(RunSession& session, RunOutcome& outcome) {
  outcome.peak_force_N = session.peak_force_N();
  outcome.stream = session.load_cell().counts();
  outcome.stream.implausible += session.n_implausible();
  try {
    session.event(outcome.status, outcome.reason.empty() ? "" : "reason",
                  outcome.reason.empty() ? "The run is complete" : outcome.reason);
  } catch (const std::exception& error) {
    if (outcome.reason.empty()) throw;
    outcome.reason += std::string("; besides: ") + error.what();
  }
}

}  // namespace

RunOutcome run_indentation(Stage& stage, LoadCell& load_cell, const RigConfig& rig,
                           const TestPlan& plan, const Specimen& specimen, const RecordSink& sink,
                           const RunControl& control) {
  const RecordSink safe_sink = failing_once(sink);
  RunSession session(stage, load_cell, rig, safe_sink, control);
  IndentationRun run(session, rig, plan, specimen);
  run.connect();
  RunOutcome& outcome = run.outcome;
  const auto end = [&](const char* status, const std::exception& error) {
    outcome.status = status;
    outcome.reason = error.what();
    const std::string trouble = session.make_safe(run.safe_position_m(), plan.retract_speed_m_s);
    if (!trouble.empty()) outcome.reason += ". And: " + trouble;
  };
  try {
    run.measure();
    outcome.status = "finished";
  } catch (const LimitReached& error) {
    end("stopped", error);
  } catch (const std::exception& error) {
    end("interrupted", error);
  }
  conclude(session, outcome);
  return outcome;
}

}  // namespace viscard
