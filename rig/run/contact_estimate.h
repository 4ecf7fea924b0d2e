#pragma once

namespace viscard {

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
