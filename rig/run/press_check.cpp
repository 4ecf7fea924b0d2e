#include "rig/run/press_check.h"

#include "models/maths/text_of_number.h"

#include <cmath>
#include <limits>

namespace viscard {
namespace {

constexpr double kSofter = 0.7;           // of the touch's stiffness: no press is softer
constexpr double kContactKnown_m = 5e-6;  // the contact, by the touch
constexpr double kDepthMissed = 0.1;      // of the depth

double softest_N_m(const TestRun& run) {
  return kSofter * (1.0 - run.specimen.relaxation_guess) * run.contact_N_m;
}

std::string in_N_mm(double stiffness_N_m) {
  return text_from_number(stiffness_N_m * 1e-3, 2) + " N/mm";
}

const char* const kCauses =
    "the gain of the load cell changed (its amplifier restarted with another one, a wire), the "
    "stage lost steps, or the specimen relaxes more than relaxation_guess states";

}  // namespace

void check_zero(TestRun& run, const ForceMean& zero) {
  const double allowed_N = zero_drift_N(run) + felt_difference_N(run.outcome.noise_N, zero.n);
  if (std::abs(zero.force_N) <= allowed_N) return;
  const bool may_press = zero.force_N > 0.0;
  run.is_place_doubtful = run.is_place_doubtful || may_press;
  throw RigError("the zero jumped by " + text_from_number(zero.force_N, 3) +
                 " N at rest, between the tare and the press, where at most " +
                 text_from_number(allowed_N, 3) +
                 " N is drift: the amplifier changed its zero, an open wire of the load cell "
                 "drifts, or something touched the cell" +
                 (may_press ? ", or the axis sinks and THE PUNCH MAY PRESS: look at it"
                            : "; nothing was pressed on a zero that is not known") +
                 ". Check the cell with: viscard rig check");
}

double longest_way_m(const TestRun& run, double force_N) {
  if (!knows_stiffness(run)) return std::numeric_limits<double>::infinity();
  return force_N / softest_N_m(run) + kContactKnown_m;
}

void check_way(TestRun& run, double force_N) {
  const double way_m = run.session.stage().position_m() - run.contact_m;
  if (way_m <= longest_way_m(run, force_N)) return;
  throw ForceDoesNotFollow("the punch went " + text_from_number(way_m * 1e6, 1) +
                           " um beyond the contact, and the force is " +
                           text_from_number(force_N, 3) + " N, where the touch has shown " +
                           in_N_mm(run.contact_N_m) + ": " + kCauses +
                           ". Check the load cell first; only if it is sound, raise "
                           "relaxation_guess of the specimen");
}

void check_press(TestRun& run, double depth_m) {
  RunSession& session = run.session;
  const double peak_N = session.peak_force_N();
  const double way_m = session.stage().position_m() - run.contact_m;
  std::string what;
  if (way_m > longest_way_m(run, peak_N)) {
    what = "the press is far softer than the touch: " + in_N_mm(peak_N / way_m) + " after " +
           in_N_mm(run.contact_N_m);
  } else if (const double frame_N_m = run.rig.frame.stiffness_N_m;
             frame_N_m > 0.0 && knows_stiffness(run)) {
    // Of the deformation of the frame that the touch implies, what the specimen has got instead.
    const double implied_m = run.contact_N_m * way_m / frame_N_m;
    const double deeper_m = implied_m - session.sound_force_N(run.outcome.noise_N) / frame_N_m;
    const double least_m = kDepthMissed * depth_m + 2.0 * run.contact_u * implied_m +
                           kContactKnown_m * run.contact_N_m / frame_N_m;
    const double most_m = least_m + run.specimen.relaxation_guess * implied_m;
    if (deeper_m > most_m || deeper_m < -least_m) {
      what = "the depth reached is " + text_from_number(live_depth_m(run) * 1e6, 1) + " um, " +
             text_from_number(std::abs(deeper_m) * 1e6, 1) +
             (deeper_m > 0.0 ? " um more" : " um less") +
             " than the stiffness of the touch implies";
    }
  }
  if (what.empty()) return;
  run.outcome.doubts.push_back(what + ". Either " + kCauses +
                               ", or the punch did not touch with its whole face at first. Check "
                               "the load cell with a weight, then repeat the run");
  session.event("doubt", "press", run.outcome.doubts.back());
}

}  // namespace viscard
