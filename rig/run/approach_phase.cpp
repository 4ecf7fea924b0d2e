#include "rig/run/approach_phase.h"

#include "models/maths/text_of_number.h"
#include "rig/run/preflight.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

constexpr double kSettle_s = 0.25;      // force after a stop, long against the readings' period
constexpr double kContactSigmas = 6.0;  // contact threshold over the noise of one reading
constexpr double kStillThere = 0.25;    // of the threshold: below, it was a single bad reading
constexpr int kMostBackOffs = 10;
constexpr int kMostRestarts = 3;     // of the amplifier before its zero is known
constexpr double kSlow = 0.8;        // of the expected rate: measured again, then checked
constexpr double kFarTooSlow = 0.5;  // of the expected rate: refused in any case

// How far an approach overshoots depends on the rate of readings, so the rate in the rig file must
// be true. A rate that is too low is measured twice, because the machine may have stalled.
void check_rate(TestRun& run, const ForceMean& zero, double duration_s) {
  const double expected_Hz = run.rig.load_cell.expected_rate_Hz;
  double rate_Hz = zero.rate_Hz;
  if (rate_Hz < kSlow * expected_Hz) {
    rate_Hz = std::max(rate_Hz, run.session.mean_force(duration_s).rate_Hz);
  }
  if (rate_Hz >= kSlow * expected_Hz) return;
  RigConfig measured = run.rig;
  measured.load_cell.expected_rate_Hz = rate_Hz;
  const Preflight found =
      preflight(measured, run.plan, run.specimen, run.session.stage().dynamics());
  if (found.problems.empty() && rate_Hz >= kFarTooSlow * expected_Hz) return;
  throw RigError("the load cell gives " + text_from_number(rate_Hz, 1) +
                 " readings/s, but expected_rate in the rig file is " +
                 text_from_number(expected_Hz, 1) +
                 " Hz, so the approach would not stop in time: " +
                 remedy_for_slow_readings(run.rig.load_cell) +
                 ", or correct expected_rate under [load_cell] of the rig file");
}

// A board that restarts while its zero is measured gives another zero: it is measured again, from
// the first readings that can be read. From then on a restart ends the run.
ForceMean undisturbed_tare(TestRun& run, double duration_s) {
  LoadCell& cell = run.session.load_cell();
  for (int i = 0; i < kMostRestarts; ++i) {
    if (cell.n_restarts() > 0) cell.connect([&] { run.session.pump(); });
    const std::int64_t n_before = cell.n_restarts();
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

struct Touch {
  JogEnd before;  // the last stop before the touch
  JogEnd at;
};

// The threshold of the plan, or a higher one if the noise demands it.
double contact_threshold_N(TestRun& run) {
  const double asked_N = run.plan.contact_force_N;
  const double threshold_N = std::max(asked_N, kContactSigmas * run.outcome.noise_N);
  if (threshold_N > asked_N) {
    run.session.event("advice", "noise",
                      "The noise is too high for contact_force: contact counts from " +
                          text_from_number(threshold_N, 4) + " N on");
  }
  return threshold_N;
}

// What a person sees at the rig tells the three causes apart.
std::string nothing_touched_text(const TestRun& run) {
  const int sign = run.rig.stage.toward_specimen;
  return "nothing was touched within " + text_from_number(run.plan.approach_limit_m * 1e3, 2) +
         " mm. If the punch came nearer, bring it nearer to the specimen before the start, or "
         "raise "
         "limit under [approach] of the test file. If it moved away, set toward_specimen = " +
         std::to_string(-sign) + " under [stage] of the rig file (it is " + std::to_string(sign) +
         "). If it did not move at all, the motor is dead: check its supply, its cable and the "
         "enable input of its driver";
}

Touch jog_until_touched(TestRun& run, double threshold_N) {
  RunSession& session = run.session;
  const double limit_m = run.start_m + run.plan.approach_limit_m;
  const double jog_m = std::max(kLongestJog_m, 1.01 / session.stage().dynamics().steps_per_m);
  while (true) {
    const double next_m = session.stage().position_m() + jog_m;
    if (next_m > limit_m) {
      throw RigError(nothing_touched_text(run));
    }
    const JogEnd before{session.stage().position_m(), session.sound_force_N(run.outcome.noise_N)};
    if (!session.move(next_m, run.plan.approach_speed_m_s, "approach", threshold_N)) continue;
    const double touched_N = session.mean_force(kSettle_s).force_N;
    if (std::abs(touched_N) > kStillThere * threshold_N) {
      return {before, {session.stage().position_m(), touched_N}};
    }
  }
}

// A punch that presses must raise the force; otherwise the load cell is wired the other way round.
void check_sign(const TestRun& run, double touched_N) {
  if (touched_N > 0.0) return;
  const bool is_positive = run.rig.load_cell.compression_is_positive;
  throw RigError("the force fell to " + text_from_number(touched_N, 4) +
                 " N when the punch touched: the load cell reads compression with the other sign. "
                 "Set compression_is_positive = " +
                 (is_positive ? "false" : "true") + " under [load_cell] of the rig file (it is " +
                 (is_positive ? "true" : "false") + ")");
}

// With the stiffness measured at the touch, a ramp that reaches the soft limit must come to a stop
// before the capacity of the cell, independent of the guessed modulus.
void check_stiffness(TestRun& run, double least_N_m) {
  const Preflight& expected = run.outcome.expected;
  const double least_peak_N = least_N_m * expected.stage_travel_of(deepest_m(run.phases));
  const double speed_m_s = expected.ramp_speed_m_s;
  const double late_m = speed_m_s * run.session.load_cell().period_s() +
                        stop_distance_m(speed_m_s, run.session.stage().dynamics());
  const double stopped_N = limit_N(run) + least_N_m * late_m;
  const double capacity_N = run.rig.calibration.capacity_N;
  if (least_peak_N <= limit_N(run) || stopped_N <= capacity_N) return;
  throw RigError(
      "the specimen is stiffer than modulus_guess says: at full depth the force would "
      "reach at least " +
      text_from_number(least_peak_N, 2) + " N, and the ramp would stop only at " +
      text_from_number(stopped_N, 2) + " N, beyond the cell's " + text_from_number(capacity_N, 2) +
      " N. Correct modulus_guess of the specimen, or press less deep");
}

// Goes to gap_m above contact, and further if the force shows that the guessed modulus was too
// high.
void back_off(TestRun& run, double contact_m) {
  RunSession& session = run.session;
  for (int i = 0; i < kMostBackOffs; ++i) {
    session.move(contact_m - run.plan.gap_m, run.plan.retract_speed_m_s, "back off");
    const ForceMean free = session.mean_force(kSettle_s);
    const double free_N = kContactSigmas * run.outcome.noise_N / std::sqrt(free.n) + 1e-4;
    if (std::abs(free.force_N) < free_N + 0.2 * run.plan.contact_force_N) {
      run.contact_m = contact_m;
      run.outcome.contact_position_m = contact_m;
      session.set_contact_m(contact_m);
      const double backed_off_m = contact_m - session.stage().position_m();
      session.event("contact", text_from_number(contact_m, 8),
                    "Touched at " + text_from_number(contact_m * 1e3, 4) + " mm; backed off by " +
                        text_from_number(backed_off_m * 1e6, 1) + " um");
      return;
    }
    contact_m -= run.plan.gap_m;
  }
  throw RigError(
      "the force does not return to zero when the punch is backed off. Is the specimen "
      "sticky, or does the cell drift? Raise gap under [approach] of the test file");
}

}  // namespace

void carry_out_tare(TestRun& run, const TestPhase& phase) {
  const ForceMean zero = undisturbed_tare(run, phase.duration_s);
  run.outcome.noise_N = zero.sd_N;
  if (std::abs(zero.force_N) > kPressesAtStart * limit_N(run)) {
    run.presses_at_start = true;
    throw RigError("the load cell reads " + text_from_number(zero.force_N, 3) +
                   " N before anything was touched. Take away what presses on it, or correct "
                   "zero_volts of the calibration");
  }
  check_rate(run, zero, phase.duration_s);
}

void carry_out_approach(TestRun& run) {
  const Touch touch = jog_until_touched(run, contact_threshold_N(run));
  check_sign(run, touch.at.force_N);
  const ContactEstimate contact = contact_from_stops(
      touch.before, touch.at, run.outcome.noise_N, 1.0 / run.session.stage().dynamics().steps_per_m,
      run.outcome.expected.total_stiffness_N_m);
  run.session.expect_stiffness(contact.least_stiffness_N_m);
  check_stiffness(run, contact.least_stiffness_N_m);
  back_off(run, contact.position_m);
}

ContactEstimate contact_from_stops(const JogEnd& before, const JogEnd& touched, double noise_N,
                                   double step_m, double guess_N_m) {
  constexpr double kFeltSigmas = 6.0;
  const double felt_N = kFeltSigmas * noise_N;
  const double way_m = touched.position_m - before.position_m;
  ContactEstimate estimate;
  estimate.position_m = touched.position_m - touched.force_N / guess_N_m;
  if (!(way_m > 0.0)) return estimate;
  const bool was_felt = before.force_N > felt_N;
  const double rise_N = touched.force_N - (was_felt ? before.force_N : 0.0);
  estimate.least_stiffness_N_m = std::max(0.0, rise_N - felt_N) / (way_m + step_m);
  if (!was_felt) {
    estimate.position_m = std::max(estimate.position_m, before.position_m);
  } else if (rise_N > felt_N) {
    estimate.position_m = touched.position_m - touched.force_N * way_m / rise_N;
  }
  return estimate;
}

}  // namespace viscard
