#pragma once

#include "rig/run/test_run.h"

namespace viscard {

// Longest jog near or in contact: so far does a stage go whose host has died.
inline constexpr double kLongestJog_m = 25e-6;

// A force above this share of the soft limit before anything was moved means that something presses
// on the load cell already.
inline constexpr double kPressesAtStart = 0.5;

// Measures zero and noise of the load cell, then checks the rate of its readings. Throws RigError
// if something presses already, or if readings come too slowly for the approach to stop in time.
void carry_out_tare(TestRun& run, const TestPhase& phase);

// Jogs toward the specimen until the force passes the contact threshold, estimates the contact,
// checks that the specimen is not too stiff for the ramp, and backs off until the force is back at
// zero. Sets run.contact_m and outcome.contact_position_m. Throws RigError if nothing is touched,
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
};

// Extrapolates the force at the touch to zero with the guessed stiffness. The result is never
// before a stop at which no force was seen, because a specimen stiffer than guessed touches later.
// If both stops were in contact, their secant replaces the guess. noise_N: standard deviation of
// one reading; step_m: resolution of the stage; guess_N_m > 0: specimen and frame in series.
ContactEstimate contact_from_stops(const JogEnd& before, const JogEnd& touched, double noise_N,
                                   double step_m, double guess_N_m);

}  // namespace viscard
