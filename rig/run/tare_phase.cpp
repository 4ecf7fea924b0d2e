#include "rig/run/tare_phase.h"

#include "models/maths/text_of_number.h"
#include "rig/run/approach_phase.h"
#include "rig/run/rest_findings.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

constexpr int kMostRestarts = 3;     // of the amplifier before its zero is known
constexpr double kProbe_m = 0.1e-3;  // lifted before the tare
constexpr double kHighest_m = 2e-3;  // farther than any test presses
constexpr double kProbeMean_s = 0.25;
constexpr double kFewestOfTare = 20.0;  // readings
constexpr double kChangeSigmas = 6.0;   // of the difference of two means
constexpr double kChangeOfTouch = 0.5;  // of contact_force: a smaller change is no contact
constexpr double kTwice = 1.5;          // of the change in the lift: it was made again
constexpr double kStillChanging = 0.3;  // of the change in the lift
constexpr double kAlmost = 0.8;         // of the way of a lift: here the force must have gone

RestReadings seen_at_rest(TestRun& run, const ForceMean& zero) {
  return {.force_N = zero.force_N,
          .noise_N = zero.sd_N,
          .drift = zero.drift,
          .rate_Hz = zero.rate_Hz,
          .life = run.session.life_signs()};
}

// What forbids any move, even a lift: a cell that does not measure would not notice that
// toward_specimen is wrong.
void refuse_dead_cell(TestRun& run, const RestReadings& seen) {
  using About = RestFinding::About;
  for (const RestFinding& found : findings_at_rest(seen, run.rig)) {
    const bool is_signal = found.about == About::kSignal || found.about == About::kNoise ||
                           found.about == About::kDrift;
    if (is_signal) throw CellIsDead(found.text);
  }
}

// How far an approach overshoots depends on the rate of readings, so the rate in the rig file must
// be true. A wrong rate is measured twice, because the machine may have stalled.
void check_rate(TestRun& run, RestReadings seen, double duration_s) {
  const auto wrong = [&]() -> std::string {
    for (const RestFinding& found : findings_at_rest(seen, run.rig)) {
      if (found.about == RestFinding::About::kRate) return found.text;
    }
    return "";
  };
  if (wrong().empty()) return;
  seen.rate_Hz = run.session.mean_force(duration_s).rate_Hz;
  if (const std::string text = wrong(); !text.empty()) throw RigError(text);
}

// A board that restarts while its zero is measured has a new zero, which is measured again from the
// first readings that can be read. After that a restart ends the run.
ForceMean undisturbed_tare(TestRun& run, double duration_s) {
  LoadCell& cell = run.session.load_cell();
  for (int i = 0; i < kMostRestarts; ++i) {
    if (cell.n_restarts() > 0) cell.connect([&] { run.session.pump(); });
    const std::int64_t n_before = cell.n_restarts();
    run.session.forget_readings();
    try {
      const ForceMean zero = run.session.tare(duration_s);
      if (cell.n_restarts() != n_before) continue;
      cell.accept_restarts(false);
      return zero;
    } catch (const PortHungUp&) {
      throw;
    } catch (const LimitReached&) {
      throw;
    } catch (const RunInterrupted&) {
      throw;
    } catch (const RigError&) {
      if (cell.n_restarts() == n_before) throw;  // otherwise too few readings because of it
    }
  }
  throw RigError(
      "the load cell's amplifier restarts again and again. Check its supply and its cable, then "
      "start the run again");
}

std::string millinewtons(double force_N) {
  return text_from_number(force_N * 1e3, 1) + " mN";
}

std::string in_mm_lifted(double way_m) {
  return text_from_number(way_m * 1e3, 3) + " mm";
}

// The smallest change between two mean forces that is more than noise.
double felt_N(const TestRun& run, const ForceMean& mean) {
  const double noise_N = kChangeSigmas * run.outcome.noise_N * std::sqrt(2.0 / mean.n);
  return std::max(kChangeOfTouch * run.plan.contact_force_N, noise_N);
}

double lifted_m(TestRun& run) {
  return run.start_m - run.session.stage().position_m();
}

// Lifts in the short jogs of an approach, which end as soon as the force changes: if
// toward_specimen has the wrong sign, the stage presses instead. Returns the change of the force.
ForceMean change_when_lifted(TestRun& run) {
  RunSession& session = run.session;
  const double threshold_N =
      std::max(run.plan.contact_force_N, kChangeSigmas * run.outcome.noise_N);
  const double jog_m = std::max(kLongestJog_m, 1.01 / session.stage().dynamics().steps_per_m);
  double before_m = 1e300;
  while (lifted_m(run) < kProbe_m - 0.5 * jog_m && session.stage().position_m() < before_m) {
    before_m = session.stage().position_m();
    if (!session.move(before_m - jog_m, run.plan.approach_speed_m_s, "lift", threshold_N)) continue;
    const ForceMean change = session.mean_force(kProbeMean_s);
    if (std::abs(change.force_N) > felt_N(run, change)) return change;
  }
  if (lifted_m(run) < 0.5 * kProbe_m) {
    session.event("advice", "pressing",
                  "The stage cannot be lifted before the tare, because the controller's own travel "
                  "ends where it stands: whether the punch presses is not known");
  }
  return session.mean_force(kProbeMean_s);
}

// A force that goes on changing while the stage stands still was not changed by the lift.
void refuse_drift(TestRun& run, const ForceMean& change) {
  const ForceMean later = run.session.mean_force(kProbeMean_s);
  const double still_N = later.force_N - change.force_N;
  if (still_N * change.force_N <= 0.0 || std::abs(still_N) < felt_N(run, later) ||
      std::abs(still_N) < kStillChanging * std::abs(change.force_N)) {
    return;
  }
  throw CellIsDead("the force changed by " + millinewtons(change.force_N) +
                   " in the lift before the approach and by another " + millinewtons(still_N) +
                   " while the stage stood still: it drifts. Look for an open wire of the load "
                   "cell; otherwise let the amplifier warm up, and keep hands and draught away");
}

// The stage went the wrong way, or the force is read with the wrong sign.
[[noreturn]] void refuse_wrong_way(TestRun& run, double change_N) {
  const double way_m = lifted_m(run);
  run.session.move(run.start_m, run.plan.approach_speed_m_s, "lift");
  // A stage that goes the wrong way goes back; one that knows one way only has pressed twice.
  const double back_N = run.session.mean_force(kProbeMean_s).force_N;
  if (back_N > kTwice * change_N) run.session.end_wrong_way(back_N);
  const int sign = run.rig.stage.toward_specimen;
  const bool is_positive = run.rig.load_cell.compression_is_positive;
  throw RigError(
      "the force rose by " + millinewtons(change_N) + " when the stage was to lift the punch by " +
      in_mm_lifted(way_m) +
      ", before the approach. It went back to where it stood. If the force also changes while the "
      "stage " +
      "stands, look for an open wire of the load cell. If the stage moved toward the specimen, set "
      "toward_specimen = " +
      std::to_string(-sign) + " under [stage] of the rig file (it is " + std::to_string(sign) +
      "); if it did lift, and a finger that presses on the cell lowers the force of 'viscard rig "
      "check', set compression_is_positive = " +
      (is_positive ? "false" : "true") + " under [load_cell] (it is " +
      (is_positive ? "true" : "false") + ")");
}

// Lifts by the distance of [retract], and again until the force no longer falls in the last part of
// a lift: then the punch is free.
void lift_until_free(TestRun& run) {
  RunSession& session = run.session;
  const double step_m = std::max(run.plan.retract_m, kProbe_m);
  const double resolution_m = 1.5 / session.stage().dynamics().steps_per_m;
  for (double way_m = step_m; way_m <= std::max(step_m, kHighest_m); way_m += step_m) {
    session.move(run.start_m - way_m + (1.0 - kAlmost) * step_m, run.plan.retract_speed_m_s,
                 "lift");
    const double almost_N = session.mean_force(kProbeMean_s).force_N;
    session.move(run.start_m - way_m, run.plan.retract_speed_m_s, "lift");
    const ForceMean now = session.mean_force(kProbeMean_s);
    if (lifted_m(run) < way_m - resolution_m) {
      throw PressesAtStart(
          "the punch was already pressing before anything was touched, and it can be lifted by "
          "only " +
          in_mm_lifted(lifted_m(run)) +
          ", because the controller's own travel ends there ($20, $130-132). Lift it by hand");
    }
    if (now.force_N > almost_N - felt_N(run, now)) return;
  }
  throw PressesAtStart(
      "the punch was already pressing before anything was touched, and the force still "
      "falls after it was lifted by " +
      in_mm_lifted(lifted_m(run)) + ". Lift it further by hand, then start the run again");
}

// The punch was lifted away from what it pressed on, and the run goes on.
void go_on_from_here(TestRun& run, const std::string& what) {
  run.outcome.doubts.push_back(what + "; what is left of that in the specimen is not known");
  run.session.event("doubt", "pressed_before", run.outcome.doubts.back());
  run.start_m = run.session.stage().position_m();
  run.presses_at_start = false;
}

// A punch that a crashed run has left in the specimen: the force falls when the stage lifts.
void free_punch(TestRun& run, double fell_N) {
  const double felt_after_m = lifted_m(run);
  run.presses_at_start = true;
  run.has_answered = true;
  run.session.event("pressing", text_from_number(fell_N, 6),
                    "The punch was already pressing: the force fell by " + millinewtons(fell_N) +
                        " when the stage lifted by " + in_mm_lifted(felt_after_m));
  lift_until_free(run);
  const std::string what =
      "the punch was already pressing before anything was touched: the force "
      "fell by " +
      millinewtons(fell_N) + " when the stage lifted by " + in_mm_lifted(felt_after_m) +
      ". It was lifted by " + in_mm_lifted(lifted_m(run));
  if (!run.lifts_at_start) {
    throw PressesAtStart(what +
                         " and is free now. Let the specimen recover, then start the run again "
                         "(capture --lift lifts and goes on by itself)");
  }
  go_on_from_here(run, what);
}

// The first tare of a run. A force above the limit ends a run, even a constant one; with --lift the
// punch is lifted first, and if the force falls, the tare begins again.
ForceMean first_tare(TestRun& run, double duration_s) {
  RunSession& session = run.session;
  std::string limit;
  try {
    return undisturbed_tare(run, duration_s);
  } catch (const LimitReached& error) {
    if (!run.lifts_at_start || session.has_moved() || !session.is_pressed()) throw;
    const double way_m = std::max(run.plan.retract_m, kProbe_m);
    const SafeEnd end = session.make_safe(run.start_m - way_m, run.plan.retract_speed_m_s);
    if (!end.trouble.empty() || !(end.lifted_m > 0.0)) throw;
    limit = std::string(error.what()) + ". It was lifted by " + in_mm_lifted(end.lifted_m);
  }
  session.guard_again();
  go_on_from_here(run, limit);
  return undisturbed_tare(run, duration_s);
}

}  // namespace

void carry_out_tare(TestRun& run, const TestPhase& phase) {
  // A slow cell needs longer to show its noise.
  const double duration_s =
      std::max(phase.duration_s, kFewestOfTare * run.session.load_cell().period_s());
  ForceMean zero = first_tare(run, duration_s);
  run.outcome.noise_N = zero.sd_N;
  const RestReadings seen = seen_at_rest(run, zero);
  refuse_dead_cell(run, seen);
  run.is_proven = is_proven_by_noise(seen) || !run.rig.load_cell.answered_on.empty();
  const double most_N = kPressesAtStart * run.rig.calibration.capacity_N;
  // First away from what may press: for this move the rate of the readings does not matter.
  if (std::abs(zero.force_N) <= most_N) check_rate(run, seen, duration_s);
  run.session.watch_life();
  const ForceMean change = change_when_lifted(run);
  if (std::abs(change.force_N) > felt_N(run, change)) refuse_drift(run, change);
  if (change.force_N > felt_N(run, change)) refuse_wrong_way(run, change.force_N);
  if (change.force_N < -felt_N(run, change)) {
    free_punch(run, -change.force_N);
    const double pressed_N = zero.force_N;
    zero = undisturbed_tare(run, duration_s);
    zero.force_N += pressed_N;
    check_rate(run, seen_at_rest(run, zero), duration_s);
    run.session.watch_life();
  }
  for (const RestFinding& found : findings_at_rest(seen_at_rest(run, zero), run.rig)) {
    if (found.about != RestFinding::About::kForce) continue;
    throw PressesAtStart(found.text + ". It does not fall when the stage lifts by " +
                         in_mm_lifted(lifted_m(run)));
  }
  run.is_tared = true;
}

}  // namespace viscard
