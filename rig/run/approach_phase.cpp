#include "rig/run/approach_phase.h"

#include "models/maths/text_of_number.h"
#include "rig/run/preflight.h"
#include "rig/run/rest_findings.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace viscard {
namespace {

constexpr double kSettle_s = 0.25;  // force after a stop, long against the readings' period
constexpr double kFiltered_s = 0.5, kSettlePeriods = 5.0;  // until filters and converters show it
constexpr double kContactSigmas = 6.0;  // contact threshold over the noise of one reading
constexpr double kStillThere = 0.25;    // of the threshold: below, it was a single bad reading
constexpr int kMostBackOffs = 10;
constexpr double kFurther = 0.08;     // of the stage's way to full depth
constexpr double kReported_m = 2e-6;  // twice the resolution of a report
constexpr double kFewestSteps = 4.0;  // of the motor
constexpr double kSureRise = 10.0;    // over the smallest rise that is felt
constexpr double kMostFurther = 0.5;  // of the soft limit
constexpr double kSurelySeen = 4.0;   // times the noise of a difference of means
constexpr int kMostPulls = 5;
constexpr double kReleased = 0.5;  // of the force at the touch: below, the punch did back off
constexpr double kOfFrame = 0.95;  // a stiffer contact says nothing of the specimen

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

// Observations that distinguish the causes for a person at the rig. A punch that may press already
// must not be brought nearer, so the load cell comes first.
std::string nothing_touched_text(const TestRun& run) {
  const int sign = run.rig.stage.toward_specimen;
  const std::string& day = run.rig.load_cell.answered_on;
  const std::string cell =
      "with a finger: viscard rig touch --rig FILE. If it does not answer, a wire of its "
      "excitation or signal is open, which its noise does not show. ";
  return "nothing was touched within " + text_from_number(run.plan.approach_limit_m * 1e3, 2) +
         " mm. " +
         (run.has_answered
              ? "If the punch stands above the specimen, bring it nearer before the start, or "
                "raise limit under [approach] of the test file. If it stood on it, touch the load "
                "cell" +
                    (day.empty() ? "" : ", which answered on " + day + ",") + " " + cell
              : "The load cell has shown no force yet, so the punch may have pressed unnoticed. "
                "Touch the cell first " +
                    cell) +
         "If the punch moved away, set toward_specimen = " + std::to_string(-sign) +
         " under [stage] of the rig file (it is " + std::to_string(sign) +
         "). If it did not move at all, the motor is dead: check its supply, its cable and the "
         "enable input of its driver";
}

// Of the way toward the specimen. Without proof that the load cell measures, it is only the one to
// the surface and a margin, whatever the cell says.
double farthest_m(TestRun& run) {
  const TestPlan& plan = run.plan;
  if (run.is_proven) return plan.approach_limit_m;
  if (!(plan.surface_m > 0.0)) {
    throw CellIsDead(
        "nothing shows that the load cell measures: its readings are equal or nearly so, as those "
        "of a dead one are. Put a finger or a weight on it while 'viscard rig touch --rig FILE' "
        "listens, which writes the day into the rig file; or state the distance from the punch to "
        "the surface as surface under [approach] of the test file");
  }
  return std::min(plan.approach_limit_m, plan.surface_m + plan.surface_margin_m);
}

[[noreturn]] void throw_nothing_touched(TestRun& run) {
  run.is_place_doubtful = true;  // a dead motor counts too
  if (run.is_proven) throw RigError(nothing_touched_text(run));
  throw CellIsDead(
      "the punch has gone " + text_from_number(run.plan.surface_margin_m * 1e3, 3) +
      " mm beyond the stated surface, and the load cell, whose readings show no noise, has not "
      "answered. Put a finger or a weight on it while 'viscard rig touch --rig FILE' listens, or "
      "correct surface under [approach] of the test file");
}

Touch jog_until_touched(TestRun& run, double threshold_N) {
  RunSession& session = run.session;
  const double limit_m = run.start_m + farthest_m(run);
  const double jog_m = std::max(kLongestJog_m, 1.01 / session.stage().dynamics().steps_per_m);
  while (true) {
    const double next_m = session.stage().position_m() + jog_m;
    if (next_m > limit_m) {
      throw_nothing_touched(run);
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

// Standard deviation of the difference of two mean forces.
double difference_N(const TestRun& run) {
  const double n = std::max(1.0, kSettle_s / run.session.load_cell().period_s());
  return run.outcome.noise_N * std::sqrt(2.0 / n);
}

[[noreturn]] void throw_no_contact(TestRun& run, const std::string& what) {
  run.is_place_doubtful = true;
  throw ForceDoesNotFollow(
      "a force was felt in the approach, but it does not follow the stage: " + what +
      ". Either the motor does not turn and the punch stands where it touched; or it is no "
      "contact: an open wire of the load cell drifts like that, or something else touched the "
      "cell. Check the motor's supply and its enable input, then the wires, and run: viscard rig "
      "check");
}

// A punch that presses further raises the force by at least a tenth of what the touch has shown.
void check_rise(TestRun& run, const Touch& touch, const JogEnd& first, const JogEnd& second) {
  const double way_m = second.position_m - first.position_m;
  const double touch_m = touch.at.position_m - touch.before.position_m;
  const double noise_N = difference_N(run);
  const double seen_N = std::max(0.0, touch.at.force_N - kContactSigmas * run.outcome.noise_N);
  const double implied_N = touch_m > 0.0 ? seen_N * way_m / touch_m : 0.0;
  const double rise_N = second.force_N - first.force_N;
  if (rise_N > std::max(kSurelySeen * noise_N, RunSession::kFollows * implied_N)) return;
  throw_no_contact(run, "it changed by " + text_from_number(rise_N * 1e3, 2) +
                            " mN when the stage pressed " + text_from_number(way_m * 1e3, 4) +
                            " mm further");
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
  check_rise(run, touch, first, second);
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
    const std::string needs =
        std::isfinite(peak_N)
            ? "The specimen is stiffer than modulus_guess says: the whole depth would need " +
                  text_from_number(peak_N, 2) + " N, more than the "
            : "The contact is as stiff as the frame alone, so stiffness under [frame] of the rig "
              "file may be too low; otherwise the whole depth would need far more than the ";
    run.session.event("advice", "stiffness",
                      needs + text_from_number(limit_N(run), 2) +
                          " N allowed. The punch goes less deep; lower the depth, or correct " +
                          (std::isfinite(peak_N) ? "modulus_guess" : "one of the two"));
    return;
  }
  const double before = expected.travel_per_depth;
  expected.travel_per_depth = 1.0 + specimen_N_m / frame_N_m;
  expected.stage_travel_m *= expected.travel_per_depth / before;
  expected.ramp_speed_m_s *= expected.travel_per_depth / before;
}

// Specimen and frame in series are softer than the frame, however stiff the specimen. A run that
// measures the frame does not know it.
void check_frame(const TestRun& run, double least_N_m) {
  if (run.plan.protocol == "compliance") return;
  const FrameConfig& frame = run.rig.frame;
  const double most_N_m = frame.stiffness_N_m * (1.0 + 2.0 * frame.stiffness_relative_u);
  if (!(frame.stiffness_N_m > 0.0) || least_N_m <= most_N_m) return;
  throw RigError("the contact is at least " + text_of(least_N_m * 1e-3, 3) +
                 " N/mm stiff, and stiffness under [frame] of the rig file is only " +
                 text_of(frame.stiffness_N_m * 1e-3, 3) +
                 " N/mm, which nothing in series with it can exceed. Measure the frame with: "
                 "viscard calibrate --compliance --rig FILE");
}

// A punch that presses must raise the force.
[[noreturn]] void throw_wrong_sign(const TestRun& run, double touched_N) {
  const bool is_positive = run.rig.load_cell.compression_is_positive;
  throw RigError("the force fell to " + text_from_number(touched_N, 4) +
                 " N when the punch touched, and came back after a lift. If a finger that presses "
                 "on the cell lowers the force of 'viscard rig check', too, set "
                 "compression_is_positive = " +
                 (is_positive ? "false" : "true") + " under [load_cell] of the rig file (it is " +
                 (is_positive ? "true" : "false") + "); otherwise look at the wires of the cell");
}

// A force that falls at the touch. If it falls further when the punch presses and comes back when the
// punch lifts, the load cell is wired the other way round. If it rises, the specimen has pulled the
// punch at the touch (adhesion), and the approach goes on. Otherwise it was no touch.
void judge_negative_touch(TestRun& run, const Touch& touch) {
  const double noise_N = difference_N(run);
  const double steps_m = kFewestSteps / run.session.stage().dynamics().steps_per_m;
  const double touch_m = std::max(steps_m, touch.at.position_m - touch.before.position_m);
  const double further_m = std::clamp(kSureRise * noise_N * touch_m / -touch.at.force_N,
                                      std::max(steps_m, kReported_m), kLongestJog_m);
  const double most_N = kMostFurther * limit_N(run);
  const JogEnd pressed = pressed_to(run, touch.at.position_m + further_m, most_N);
  const double change_N = pressed.force_N - touch.at.force_N;
  if (change_N > kSurelySeen * noise_N) {
    run.session.event("adhesion", text_from_number(touch.at.force_N, 6),
                      "The specimen pulled the punch by " +
                          text_from_number(-touch.at.force_N * 1e3, 2) + " mN at the touch");
    return;
  }
  run.session.move(touch.before.position_m - touch_m, run.plan.approach_speed_m_s, "back off");
  const double lifted_N = run.session.mean_force(kSettle_s).force_N;
  if (change_N > -kSurelySeen * noise_N || lifted_N < kStillThere * touch.at.force_N) {
    throw_no_contact(run, "it was " + text_from_number(touch.at.force_N * 1e3, 2) +
                              " mN, changed by " + text_from_number(change_N * 1e3, 2) +
                              " mN when the stage pressed further, and was " +
                              text_from_number(lifted_N * 1e3, 2) + " mN after a lift");
  }
  throw_wrong_sign(run, touch.at.force_N);
}

// Jogs on after an adhesion until the force is one of compression.
Touch touched_in_compression(TestRun& run, double threshold_N) {
  for (int i = 0; i < kMostPulls; ++i) {
    const Touch touch = jog_until_touched(run, threshold_N);
    if (touch.at.force_N > 0.0) return touch;
    judge_negative_touch(run, touch);
  }
  throw RigError(
      "the specimen pulls the punch again and again in the approach. Clean the punch, or cover "
      "the specimen with powder or a drop of water");
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

// A force that stays although the stage has counted its way back.
[[noreturn]] void throw_not_released(TestRun& run, double touched_N, double still_N) {
  if (std::abs(still_N) < kReleased * touched_N) {
    throw RigError(
        "the force does not return to zero when the punch is backed off. Is the specimen "
        "sticky, or does the cell drift (an open wire)? Raise gap under [approach] of the test "
        "file, or check the wires of the load cell");
  }
  run.is_place_doubtful = true;
  throw ForceDoesNotFollow(
      "the force does not follow the stage: it was " + text_from_number(touched_N * 1e3, 2) +
      " mN at the touch, and is still " + text_from_number(still_N * 1e3, 2) +
      " mN after the punch was backed off by the stage's count. Either the motor does not turn "
      "(supply, cable, enable input of its driver), or the specimen sticks to the punch (raise gap "
      "under [approach] of the test file), or the cell drifts (an open wire)");
}

// A punch that still presses above a contact that the stiffness has shown: the stage counts what its
// play takes up when it turns round.
void doubt_play(TestRun& run, double still_N) {
  run.outcome.doubts.push_back(
      "lost motion on reversal of some " +
      text_from_number((run.plan.gap_m + still_N / run.contact_N_m) * 1e6, 0) +
      " um: by its count the stage had backed off to " + text_from_number(run.plan.gap_m * 1e6, 0) +
      " um above the contact, and the force was still " + text_from_number(still_N * 1e3, 1) +
      " mN. The screw or its coupling has play, or the specimen follows the punch; what an "
      "unloading shows is then wrong. Take the play out (preloaded nut, spring)");
  run.session.event("doubt", "lost_motion", run.outcome.doubts.back());
}

// Goes to gap_m above contact, and further if the force has not gone: then the guessed modulus was
// too high or, if the stiffness is known, the stage has play. touched_N: the force before.
void back_off(TestRun& run, double contact_m, double touched_N) {
  RunSession& session = run.session;
  double still_N = touched_N;
  double to_m = contact_m - run.plan.gap_m;
  for (int i = 0; i < kMostBackOffs; ++i) {
    session.move(to_m, run.plan.retract_speed_m_s, "back off");
    ForceMean free = session.mean_force(kSettle_s);
    const double free_N = kContactSigmas * run.outcome.noise_N / std::sqrt(free.n) + 1e-4 +
                          0.2 * run.plan.contact_force_N;
    if (std::abs(free.force_N) >= free_N) {  // or the converter or a filter still settles
      session.pump_until(session.now_s() +
                         std::max(kFiltered_s, kSettlePeriods * session.load_cell().period_s()));
      free = session.mean_force(kSettle_s);
    }
    still_N = free.force_N;
    const double rise_N = still_N - touched_N;
    if (rise_N > session.judged_N()) session.end_wrong_way(rise_N);
    if (std::abs(free.force_N) < free_N) {
      run.contact_m = contact_m;
      run.outcome.contact_position_m = contact_m;
      session.set_contact_m(contact_m);
      const double backed_off_m = contact_m - session.stage().position_m();
      session.event("contact", text_from_number(contact_m, 8),
                    "Touched at " + text_from_number(contact_m * 1e3, 4) + " mm; backed off by " +
                        text_from_number(backed_off_m * 1e6, 1) + " um");
      return;
    }
    to_m -= run.plan.gap_m;
    if (!knows_stiffness(run)) {
      contact_m -= run.plan.gap_m;
    } else if (i == 0 && still_N > free_N + 0.8 * run.plan.contact_force_N) {
      doubt_play(run, still_N);
    }
  }
  throw_not_released(run, touched_N, still_N);
}

}  // namespace

void carry_out_approach(TestRun& run) {
  if (!run.has_answered) run.session.event("advice", "unanswered", kUnanswered);
  const Touch first = touched_in_compression(run, contact_threshold_N(run));
  const Touch touch = pressed_further(run, first);
  const ContactEstimate contact = contact_from_stops(
      touch.before, touch.at, run.outcome.noise_N, 1.0 / run.session.stage().dynamics().steps_per_m,
      run.outcome.expected.total_stiffness_N_m);
  run.session.expect_stiffness(contact.least_stiffness_N_m);
  check_frame(run, contact.least_stiffness_N_m);
  use_stiffness(run, contact.stiffness_N_m);
  check_stiffness(run, contact.least_stiffness_N_m);
  run.contact_N_m =
      contact.stiffness_N_m > 0.0 ? contact.stiffness_N_m : contact.least_stiffness_N_m;
  if (contact.stiffness_N_m > 0.0) {
    const double step_m = 1.0 / run.session.stage().dynamics().steps_per_m;
    run.contact_u = std::hypot(difference_N(run) / (touch.at.force_N - touch.before.force_N),
                               step_m / (touch.at.position_m - touch.before.position_m));
  }
  back_off(run, contact.position_m, touch.at.force_N);
  // It rose when the stage pressed, and went when the stage lifted.
  run.is_proven = run.has_answered = true;
  run.session.expect_force(run.contact_m, run.contact_N_m);
}

}  // namespace viscard
