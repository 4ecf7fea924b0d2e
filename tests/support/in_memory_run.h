#pragma once

#include "models/experiment/captured_run.h"
#include "models/experiment/emulated_specimen.h"

namespace viscard::test {

// A whole run as viscard capture records it, computed in memory without ports, threads or waiting.
// The force comes from time steps of the specimen and the frame spring (HereditaryStress), not from
// the closed forms that the fit uses. Positions of the stage are whole steps. The readings have the
// amplifier's clock, a random delay of each message, noise, drift and counts.
struct RunConditions {
  double clock_rate = 1.0;  // amplifier's clock over the host's
  double clock_offset_s = 3.7;
  double message_delay_s = 2e-3;              // mean of an exponential delay, every message
  double stage_speed = 1.0;                   // true speed of the moves over the commanded one
  double start_latency_s = 20e-3;             // moves begin up to this after they were commanded
  double lost_from_s = 0.0, lost_to_s = 0.0;  // readings lost, counted from the ramp's start
  // The rig's guess of the modulus divided by the true modulus. The contact position is where a
  // straight line of the guessed stiffness through `touched_N` reaches zero, so it is wrong by the
  // error of the guess.
  double guess_over_truth = 1.0;
  double touched_N = 0.1;
  // The motor makes a step when the move has gone that far, as GRBL does: on the way it lies half a step behind on
  // the average. false: it makes the step half a step earlier.
  bool steps_when_due = true;
  // Before the baseline the punch touches: it goes so far beyond the surface (frame included), stays, and backs off.
  // 0: no touch, and the run begins with the baseline.
  double touch_m = 0.0;
  double touch_s = 1.4;
};
CapturedRun in_memory_run(const EmulatedTruth& truth, const TestPlan& plan,
                          const RunConditions& conditions = {});

// The three materials of the demo (Table 6.1 of the thesis): ratio 10, 13 or 20.
EmulatedTruth demo_truth(int mixing_ratio, std::uint64_t seed);

}  // namespace viscard::test
