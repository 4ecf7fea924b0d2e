#pragma once

#include "rig/run/test_run.h"

namespace viscard {

// Longest jog near or in contact: so far does a stage go whose host has died.
inline constexpr double kLongestJog_m = 25e-6;

// Jogs toward the specimen until the force passes the contact threshold, presses a little further to
// measure the stiffness, estimates the contact, checks that the specimen is not too stiff for the
// ramp, and backs off until the force is back at zero. Sets run.contact_m,
// outcome.contact_position_m and, by the stiffness measured, how far the stage goes for a depth. Throws RigError if nothing is touched,
// if the load cell has the wrong sign, or if the force does not return to zero.
void carry_out_approach(TestRun& run);

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
