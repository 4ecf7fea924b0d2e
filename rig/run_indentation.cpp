#include "rig/run_indentation.h"

#include "models/experiment/test_phases.h"
#include "models/maths/text_of_number.h"
#include "rig/run/contact_estimate.h"
#include "rig/run/force_control.h"
#include "rig/run/run_conclusion.h"
#include "rig/run/run_session.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <vector>

namespace viscard {
namespace {

constexpr double kSettle_s = 0.25;      // force after a stop, long against the readings' period
constexpr double kContactSigmas = 6.0;  // of one reading's noise
constexpr double kStillThere = 0.25;    // of the threshold: less was a stray reading
constexpr double kFarTooSlow = 0.5;     // of the expected rate of readings
constexpr double kSlower = 0.8;
constexpr double kFlatForce = 0.2;  // of the expected peak: less is no specimen of that kind
constexpr double kJog_m = 25e-6;    // longest way a dead host lets the stage go near contact
constexpr int kMostBackOffs = 10;
constexpr double kDepthAfter_s = 0.5;  // of a hold's beginning: the depth reached is told then
// Force control.
constexpr double kNearShare = 0.45;    // of the force: from there on the stiffness is well seen
constexpr double kFirstShare = 0.7;    // of the force, reached by the stiffness guessed
constexpr double kLeastRatio = 0.2;    // of the stiffness seen over the one guessed
constexpr double kMeanReadings = 8.0;  // for one step
constexpr double kLeastMean_s = 0.1;
constexpr double kTolerance = 0.005;    // of the force, unless the test file says otherwise
constexpr double kDeepestShare = 2.0;   // of the elastic depth: creep beyond that ends the run
constexpr double kLoadedAtStart = 0.5;  // of the soft limit: something already presses

std::string in_um(double length_m) {
  return text_from_number(length_m * 1e6, 1) + " um";
}

class IndentationRun {
 public:
  IndentationRun(RunSession& session, const RigConfig& rig, const TestPlan& plan,
                 const Specimen& specimen)
      : session_(session),
        rig_(rig),
        plan_(plan),
        specimen_(specimen),
        phases_(phases_from_plan(plan)) {}

  void connect();
  void measure();
  // Both devices are there and nothing speaks against the test.
  bool is_begun() const { return is_begun_; }
  // Where the punch is surely free, as far as is known.
  double safe_position_m() const;
  // What presses before anything was moved presses where the stage stands.
  bool presses_at_start() const {
    return presses_at_start_ || (is_begun_ && !session_.has_moved() &&
                                 std::abs(session_.force_N()) > kLoadedAtStart * limit_N());
  }
  // Takes the depth reached when the run ends in contact.
  void note_depth_at_end() {
    if (is_in_contact_) note_depth();
  }

  RunOutcome outcome;

 private:
  void carry_out(const TestPhase& phase);
  void tare(const TestPhase& phase);
  void check_rate(const ForceMean& zero, double duration_s);
  void approach();
  void check_sign(double touched_N) const;
  void check_stiffness(double least_N_m) const;
  void back_off(double contact_m);
  void wait(const TestPhase& phase);
  void go_to_depth(const TestPhase& phase);
  void load(const TestPhase& phase);
  void hold_force(const TestPhase& phase);
  void note_depth();
  double approach_s() const { return 0.5 * plan_.approach_limit_m / plan_.approach_speed_m_s; }
  double mean_s() const;
  double live_depth_m() const;
  double limit_N() const { return rig_.safety.soft_fraction * rig_.calibration.capacity_N; }

  RunSession& session_;
  const RigConfig& rig_;
  const TestPlan& plan_;
  const Specimen& specimen_;
  std::vector<TestPhase> phases_;
  double start_m_ = 0.0;
  double contact_m_ = 0.0;
  double depth_asked_m_ = 0.0;  // by the last move to a depth
  double measured_N_m_ = 0.0;   // stiffness seen while loading to a force
  bool is_in_contact_ = false;
  bool is_begun_ = false;
  bool presses_at_start_ = false;
};

void IndentationRun::connect() {
  session_.begin_phase("connect", planned_s(phases_, 0, approach_s()), "Waiting for both devices");
  session_.connect();
  start_m_ = session_.stage().position_m();
  outcome.expected = preflight(rig_, plan_, specimen_, session_.stage().dynamics());
  if (!outcome.expected.problems.empty()) throw RigError(outcome.expected.problems.front());
  for (const std::string& text : outcome.expected.warnings) session_.event("advice", "test", text);
  for (const std::string& text : session_.stage().advice()) session_.event("advice", "stage", text);
}

void IndentationRun::measure() {
  is_begun_ = true;
  for (std::size_t i = 0; i < phases_.size(); ++i) {
    session_.begin_phase(phases_[i].name, planned_s(phases_, i, approach_s()), phases_[i].text);
    carry_out(phases_[i]);
  }
}

void IndentationRun::carry_out(const TestPhase& phase) {
  switch (phase.kind) {
    case TestPhase::Kind::kTare:
      return tare(phase);
    case TestPhase::Kind::kApproach:
      return approach();
    case TestPhase::Kind::kWait:
      return wait(phase);
    case TestPhase::Kind::kMove:
      return go_to_depth(phase);
    case TestPhase::Kind::kLoad:
      return load(phase);
    case TestPhase::Kind::kHoldForce:
      return hold_force(phase);
    case TestPhase::Kind::kRetract:
      is_in_contact_ = false;
      session_.move(safe_position_m(), plan_.retract_speed_m_s, "retract");
      return;
  }
}

void IndentationRun::tare(const TestPhase& phase) {
  const ForceMean zero = session_.tare(phase.duration_s);
  outcome.noise_N = zero.sd_N;
  if (std::abs(zero.force_N) > kLoadedAtStart * limit_N()) {
    presses_at_start_ = true;
    throw RigError("the load cell reads " + text_from_number(zero.force_N, 3) +
                   " N before anything was touched. Take away what presses on it, or correct "
                   "zero_volts of the calibration");
  }
  check_rate(zero, phase.duration_s);
}

// How far an approach overshoots depends on how often the force is seen: what the rig file promises
// must be true. Measured twice before it is refused, since a machine may stall.
void IndentationRun::check_rate(const ForceMean& zero, double duration_s) {
  const double expected_Hz = rig_.load_cell.expected_rate_Hz;
  double rate_Hz = zero.rate_Hz;
  if (rate_Hz < kSlower * expected_Hz) {
    rate_Hz = std::max(rate_Hz, session_.mean_force(duration_s).rate_Hz);
  }
  if (rate_Hz >= kSlower * expected_Hz) return;
  RigConfig measured = rig_;
  measured.load_cell.expected_rate_Hz = rate_Hz;
  const Preflight found = preflight(measured, plan_, specimen_, session_.stage().dynamics());
  if (found.problems.empty() && rate_Hz >= kFarTooSlow * expected_Hz) return;
  throw RigError(
      "the load cell gives " + text_from_number(rate_Hz, 1) +
      " readings/s and the rig file says expected_rate = " + text_from_number(expected_Hz, 1) +
      " Hz, so that the approach would not stop in time: " +
      remedy_for_slow_readings(rig_.load_cell) +
      ", or correct expected_rate under [load_cell] of the rig file");
}

void IndentationRun::approach() {
  const double threshold_N = std::max(plan_.contact_force_N, kContactSigmas * outcome.noise_N);
  if (threshold_N > plan_.contact_force_N) {
    session_.event("advice", "noise",
                   "Contact is told from " + text_from_number(threshold_N, 4) +
                       " N on, because of the noise, instead of contact_force");
  }
  const double limit_m = start_m_ + plan_.approach_limit_m;
  ForceMean touched;
  JogEnd before;
  const double jog_m = std::max(kJog_m, 1.01 / session_.stage().dynamics().steps_per_m);
  while (true) {
    const double next_m = session_.stage().position_m() + jog_m;
    if (next_m > limit_m) {
      throw RigError("nothing was touched within " +
                     text_from_number(plan_.approach_limit_m * 1e3, 2) +
                     " mm. Bring the punch nearer to the specimen, or raise limit under "
                     "[approach] of the test file");
    }
    before = {session_.stage().position_m(), session_.force_N()};
    if (!session_.move(next_m, plan_.approach_speed_m_s, "approach", threshold_N)) continue;
    touched = session_.mean_force(kSettle_s);
    if (std::abs(touched.force_N) > kStillThere * threshold_N) break;
  }
  check_sign(touched.force_N);
  const ContactEstimate contact = contact_from_stops(
      before, {session_.stage().position_m(), touched.force_N}, outcome.noise_N,
      1.0 / session_.stage().dynamics().steps_per_m, outcome.expected.total_stiffness_N_m);
  check_stiffness(contact.least_stiffness_N_m);
  back_off(contact.position_m);
}

// With the stiffness felt at the touch, whatever was guessed, a ramp that meets the limit must be
// stopped before the cell's capacity.
void IndentationRun::check_stiffness(double least_N_m) const {
  const Preflight& expected = outcome.expected;
  const double least_peak_N = least_N_m * expected.stage_travel_of(deepest_m(phases_));
  const double speed_m_s = expected.ramp_speed_m_s;
  const double late_m = speed_m_s * session_.load_cell().period_s() +
                        stop_distance_m(speed_m_s, session_.stage().dynamics());
  const double stopped_N = limit_N() + least_N_m * late_m;
  if (least_peak_N <= limit_N() || stopped_N <= rig_.calibration.capacity_N) return;
  throw RigError(
      "the specimen is stiffer than modulus_guess says: at full depth the force would "
      "reach at least " +
      text_from_number(least_peak_N, 2) + " N, and the ramp would stand only at " +
      text_from_number(stopped_N, 2) + " N, beyond the cell's " +
      text_from_number(rig_.calibration.capacity_N, 2) +
      " N. Correct modulus_guess of the specimen, or press less deep");
}

// A punch that presses makes a positive force, or the cell is wired the other way round.
void IndentationRun::check_sign(double touched_N) const {
  if (touched_N > 0.0) return;
  const bool is_positive = rig_.load_cell.compression_is_positive;
  throw RigError("the force fell to " + text_from_number(touched_N, 4) +
                 " N when the punch touched: the load cell reads compression with the other sign. "
                 "Set compression_is_positive = " +
                 (is_positive ? "false" : "true") + " under [load_cell] of the rig file (it is " +
                 (is_positive ? "true" : "false") + ")");
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

// Of the last move, or of now if that is later: a wait in contact is counted from the end of
// motion.
void IndentationRun::wait(const TestPhase& phase) {
  if (!is_in_contact_) return session_.hear_until(session_.now_s() + phase.duration_s);
  const double end_s = session_.stage().expected_end_s();
  session_.pump_until(end_s + std::min(kDepthAfter_s, phase.duration_s));
  note_depth();
  session_.pump_until(end_s + phase.duration_s);
}

double IndentationRun::live_depth_m() const {
  const double frame_N_m = rig_.frame.stiffness_N_m;
  return session_.stage().position_m() - contact_m_ -
         (frame_N_m > 0.0 ? session_.force_N() / frame_N_m : 0.0);
}

void IndentationRun::note_depth() {
  outcome.achieved_depth_m = std::max(outcome.achieved_depth_m, live_depth_m());
}

void IndentationRun::go_to_depth(const TestPhase& phase) {
  const Preflight& expected = outcome.expected;
  const double way_m = std::abs(expected.stage_travel_of(phase.depth_m - depth_asked_m_));
  const double speed_m_s = phase.move_s > 0.0 ? way_m / phase.move_s : phase.speed_m_s;
  is_in_contact_ = true;
  session_.move(contact_m_ + expected.stage_travel_of(phase.depth_m), speed_m_s, phase.purpose);
  depth_asked_m_ = phase.depth_m;
  if (phase.depth_m >= deepest_m(phases_)) note_depth();
}

// To most of the force by the stiffness guessed, then to the force by the stiffness seen on the
// way. Both moves end early, gently, where the force says so.
void IndentationRun::load(const TestPhase& phase) {
  is_in_contact_ = true;
  const double guess_N_m = outcome.expected.total_stiffness_N_m;
  const double speed_m_s = phase.force_N / guess_N_m / phase.move_s;
  ForceMean reached = session_.mean_force(mean_s());
  if (reached.force_N < kNearShare * phase.force_N) {
    const double first_N = kFirstShare * phase.force_N;
    const double believed_N_m = measured_N_m_ > 0.0 ? measured_N_m_ : guess_N_m;
    session_.move(contact_m_ + first_N / believed_N_m, speed_m_s, phase.purpose, first_N);
    reached = session_.mean_force(mean_s());
  }
  const double way_m = session_.stage().position_m() - contact_m_;
  measured_N_m_ = std::clamp(reached.force_N / std::max(way_m, 0.1 * plan_.gap_m),
                             kLeastRatio * guess_N_m, guess_N_m / kLeastRatio);
  const double rest_N = phase.force_N - reached.force_N;
  if (rest_N <= 0.0) return;
  session_.move(session_.stage().position_m() + rest_N / measured_N_m_, speed_m_s, phase.purpose,
                phase.force_N);
  note_depth();
}

// Long enough for a mean that is worth a step.
double IndentationRun::mean_s() const {
  return std::max(kLeastMean_s, kMeanReadings * session_.load_cell().period_s());
}

void IndentationRun::hold_force(const TestPhase& phase) {
  const double deepest_m =
      plan_.creep.depth_limit_m > 0.0
          ? plan_.creep.depth_limit_m
          : kDeepestShare * phase.force_N / outcome.expected.specimen_stiffness_N_m;
  const double noise_N = outcome.noise_N / std::sqrt(kMeanReadings);
  const double step_N = measured_N_m_ / session_.stage().dynamics().steps_per_m;
  const double tolerance_N = plan_.creep.tolerance_N > 0.0 && phase.purpose == "creep"
                                 ? plan_.creep.tolerance_N
                                 : kTolerance * phase.force_N;
  ForceControl control({.target_N = phase.force_N,
                        .stiffness_N_m = measured_N_m_,
                        .tolerance_N = std::max({tolerance_N, 3.0 * noise_N, 0.6 * step_N}),
                        .largest_step_m = kJog_m,
                        .noise_N = noise_N});
  const double end_s = session_.stage().expected_end_s() + phase.duration_s;
  while (session_.now_s() < end_s) {
    const double step_m = control.step_m(session_.mean_force(mean_s()).force_N);
    note_depth();
    if (live_depth_m() > deepest_m) {
      throw RigError("the specimen has crept to " + in_um(live_depth_m()) + ", beyond " +
                     in_um(deepest_m) +
                     ". Lower force or set depth_limit under [creep] of the test file");
    }
    if (step_m == 0.0) continue;
    session_.move(session_.stage().position_m() + step_m, plan_.approach_speed_m_s, phase.purpose);
  }
  depth_asked_m_ = live_depth_m();
}

double IndentationRun::safe_position_m() const {
  if (outcome.contact_position_m) return contact_m_ - plan_.retract_m;
  return presses_at_start() ? start_m_ - plan_.retract_m : start_m_;
}

}  // namespace

RunOutcome run_indentation(Stage& stage, LoadCell& load_cell, const RigConfig& rig,
                           const TestPlan& plan, const Specimen& specimen, const RecordSink& sink,
                           const RunControl& control) {
  const RecordSink safe_sink = failing_once(sink);
  RunSession session(stage, load_cell, rig, safe_sink, control);
  IndentationRun run(session, rig, plan, specimen);
  RunOutcome& outcome = run.outcome;
  const auto end = [&](const char* status, const std::exception& error) {
    outcome.status = status;
    outcome.reason = error.what();
    outcome.has_begun = session.has_moved();
    run.note_depth_at_end();
    const bool tells_lift = outcome.status == "stopped" || run.presses_at_start();
    const std::string trouble = session.make_safe(run.safe_position_m(), plan.retract_speed_m_s);
    if (tells_lift) outcome.reason += what_was_done(session.lifted_m());
    if (!trouble.empty()) outcome.reason += ". And: " + trouble;
  };
  try {
    run.connect();
    run.measure();
    outcome.status = "finished";
    outcome.has_begun = true;
  } catch (const LimitReached& error) {
    if (!session.is_stage_connected()) throw;
    end("stopped", error);
  } catch (const std::exception& error) {
    if (!run.is_begun()) throw;
    end("interrupted", error);
  }
  conclude(session, outcome, *control.clock);
  return outcome;
}

}  // namespace viscard
