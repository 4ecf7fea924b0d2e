#include "rig/run/approach_phase.h"

#include "models/maths/text_of_number.h"
#include "rig/run/preflight.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace viscard {
namespace {

constexpr double kSettle_s = 0.25;      // force after a stop, long against the readings' period
constexpr double kContactSigmas = 6.0;  // contact threshold over the noise of one reading
constexpr double kStillThere = 0.25;    // of the threshold: below, it was a single bad reading
constexpr int kMostBackOffs = 10;
constexpr double kFurther = 0.08;     // of the stage's way to full depth
constexpr double kReported_m = 2e-6;  // twice the resolution of a report
constexpr double kFewestSteps = 4.0;  // of the motor
constexpr double kSureRise = 10.0;    // over the smallest rise that is felt
constexpr double kMostFurther = 0.5;  // of the soft limit
constexpr double kOfFrame = 0.95;     // a stiffer contact says nothing of the specimen

struct Touch {
  JogEnd before;  // the last stop before contact
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

// Observations that distinguish the three causes for a person at the rig.
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

JogEnd pressed_to(TestRun& run, double position_m, double most_N) {
  run.session.move(position_m, run.plan.approach_speed_m_s, "approach", most_N);
  const double force_N = run.session.mean_force(kSettle_s).force_N;
  return {run.session.stage().position_m(), force_N};
}

// Presses a few per cent of the depth further, so that two stops in contact show the stiffness.
// With a wrong modulus_guess, contact and travel would miss the depth by tens of um. The stop at
// the touch is not one of the two, because a report has only three decimals of a mm; the end of a
// whole move is known to a step. Returns the touch itself if the force leaves no room for the
// second stop.
Touch pressed_further(TestRun& run, const Touch& touch) {
  const Preflight& expected = run.outcome.expected;
  const double least_m = kFewestSteps / run.session.stage().dynamics().steps_per_m;
  const double sure_m =
      kSureRise * kContactSigmas * run.outcome.noise_N / expected.total_stiffness_N_m;
  const double jog_m = std::max(
      least_m, std::min(kLongestJog_m, std::max(kFurther * expected.stage_travel_m, sure_m)));
  const double first_m = std::max(least_m, kReported_m);
  const double most_N = kMostFurther * limit_N(run);
  const double rise_N = 2.0 * (first_m + jog_m) * expected.total_stiffness_N_m;
  if (touch.at.force_N + rise_N > most_N) return touch;
  const JogEnd first = pressed_to(run, touch.at.position_m + first_m, most_N);
  const JogEnd second = pressed_to(run, first.position_m + jog_m, most_N);
  return second.force_N > first.force_N ? Touch{first, second} : touch;
}

// With a known frame, the stage's travel to a depth follows from the measured stiffness. If the
// force at full depth would pass the limit, the travel computed from modulus_guess is kept.
void use_stiffness(TestRun& run, double total_N_m) {
  const double frame_N_m = run.rig.frame.stiffness_N_m;
  const double depth_m = deepest_m(run.phases);
  if (!(frame_N_m > 0.0 && total_N_m > 0.0 && depth_m > 0.0)) return;
  Preflight& expected = run.outcome.expected;
  const double specimen_N_m = total_N_m < kOfFrame * frame_N_m
                                  ? 1.0 / (1.0 / total_N_m - 1.0 / frame_N_m)
                                  : std::numeric_limits<double>::infinity();
  const double peak_N = specimen_N_m * depth_m;
  if (peak_N > limit_N(run)) {
    run.session.event(
        "advice", "stiffness",
        "The specimen is stiffer than modulus_guess says: the whole depth would need " +
            (std::isfinite(peak_N) ? text_from_number(peak_N, 2) + " N, more than the "
                                   : std::string("far more than the ")) +
            text_from_number(limit_N(run), 2) +
            " N allowed. The punch goes less deep; lower the depth, or correct modulus_guess");
    return;
  }
  const double before = expected.travel_per_depth;
  expected.travel_per_depth = 1.0 + specimen_N_m / frame_N_m;
  expected.stage_travel_m *= expected.travel_per_depth / before;
  expected.ramp_speed_m_s *= expected.travel_per_depth / before;
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

void carry_out_approach(TestRun& run) {
  const Touch first = jog_until_touched(run, contact_threshold_N(run));
  check_sign(run, first.at.force_N);
  const Touch touch = pressed_further(run, first);
  const ContactEstimate contact = contact_from_stops(
      touch.before, touch.at, run.outcome.noise_N, 1.0 / run.session.stage().dynamics().steps_per_m,
      run.outcome.expected.total_stiffness_N_m);
  run.session.expect_stiffness(contact.least_stiffness_N_m);
  use_stiffness(run, contact.stiffness_N_m);
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
    estimate.stiffness_N_m = rise_N / way_m;
    estimate.position_m = touched.position_m - touched.force_N / estimate.stiffness_N_m;
  }
  return estimate;
}

}  // namespace viscard
