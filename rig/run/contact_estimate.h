#pragma once

namespace viscard {

// Where a jog of the approach ended, and the force there (from the tare).
struct JogEnd {
  double position_m = 0.0;
  double force_N = 0.0;
};

// What the last two stops of an approach tell of the surface.
struct ContactEstimate {
  double position_m = 0.0;  // where the punch touches
  // Specimen and frame together are at least that stiff, whatever was guessed.
  double least_stiffness_N_m = 0.0;
};

// The stiffness guessed carries the force at the touch back to zero, but never to before a stop
// where nothing was felt: where the specimen is stiffer than guessed, that stop is nearer. With
// both stops in contact their secant takes the guess's place. noise_N: of one reading; step_m:
// resolution of the stage; guess_N_m > 0: specimen and frame in series.
ContactEstimate contact_from_stops(const JogEnd& before, const JogEnd& touched, double noise_N,
                                   double step_m, double guess_N_m);

}  // namespace viscard
