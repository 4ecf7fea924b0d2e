#pragma once

#include "models/experiment/rig_config.h"
#include "models/experiment/specimen.h"
#include "models/experiment/test_phases.h"
#include "models/experiment/test_plan.h"
#include "rig/run/run_outcome.h"
#include "rig/run/run_session.h"

#include <vector>

namespace viscard {

// Shared by the phases of one test: the session, the plan, and what is known so far.
struct TestRun {
  RunSession& session;
  const RigConfig& rig;
  const TestPlan& plan;
  const Specimen& specimen;
  std::vector<TestPhase> phases;
  RunOutcome outcome;
  double start_m = 0.0;        // stage position before anything was moved
  double contact_m = 0.0;      // stage position at which the punch touches
  bool is_in_contact = false;  // the last move pressed the punch into the specimen
  bool lifts_at_start =
      false;  // a punch that presses before the test is lifted and the test goes on
  bool presses_at_start = false;   // it pressed, and the run ends because of that
  bool is_tared = false;           // the zero is known and nothing presses
  bool is_proven = false;          // the load cell has shown that it measures
  bool has_answered = false;       // it has answered to a force, now or on the day in the rig file
  double contact_N_m = 0.0;        // stiffness of the contact, as the approach has seen it
  double contact_u = 1.0;          // its relative uncertainty by noise and steps; 1: a lower bound
  bool is_place_doubtful = false;  // the force contradicts the stage's count
};

// The touch has shown the stiffness of the contact within 5 %, and with it where the contact is.
inline bool knows_stiffness(const TestRun& run) {
  return run.contact_N_m > 0.0 && run.contact_u < 0.05;
}

// Soft limit of the force, N.
double limit_N(const TestRun& run);

// Indentation by the live contact point and the newest force.
double live_depth_m(TestRun& run);

// How far the zero may have drifted since the tare, N; less before the contact, soon after it.
double zero_drift_N(const TestRun& run);

// After the last lift and before the end of the run: the force must be the zero again, within what
// a cell drifts. Throws PunchNotFree if it is not and is not far below the one before the lift; a
// smaller rest is a doubt. True if it is the zero.
enum class LiftEnd { kNow, kLater };
bool check_lifted(TestRun& run, double before_N, LiftEnd when);
// So long are the readings that it judges.
double lift_mean_s(const TestRun& run);

// Keeps the deepest indentation so far as outcome.achieved_depth_m.
void note_depth(TestRun& run);

// Fills in the totals of a run and adds the doubts about a finished one. If they cannot be recorded
// any more, the outcome still carries the reason for the early end.
void judge_record(RunSession& session, const RigConfig& rig, const RunControl& control,
                  RunOutcome& outcome);

// Records what the depth is (why: of compare_count()) and how the run ended, in the same way.
void record_end(RunSession& session, const std::string& why, RunOutcome& outcome);

// Where a jog of the approach ended, and the force there (from the tare).
struct JogEnd {
  double position_m = 0.0;
  double force_N = 0.0;
};

// The surface as the last two stops of an approach show it.
struct ContactEstimate {
  double position_m = 0.0;  // of the stage when the punch just touches
  // Lower bound of the stiffness of specimen and frame in series; independent of the guess.
  double least_stiffness_N_m = 0.0;
  double stiffness_N_m = 0.0;  // between the two stops; 0 unless both were in contact
};

// Extrapolates the force at the touch to zero with the guessed stiffness. The result is never
// before a stop at which no force was seen, because a specimen stiffer than guessed touches later.
// If both stops were in contact, their secant replaces the guess. noise_N: standard deviation of
// one reading; step_m: resolution of the stage; guess_N_m > 0: specimen and frame in series.
ContactEstimate contact_from_stops(const JogEnd& before, const JogEnd& touched, double noise_N,
                                   double step_m, double guess_N_m);

}  // namespace viscard
