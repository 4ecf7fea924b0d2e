#pragma once

#include "models/experiment/emulated_specimen.h"
#include "models/material/hereditary.h"

namespace viscard {

// A viscoelastic layer under a flat punch that a stage presses through a frame spring (the load
// cell is part of the frame):
//   F(t) = c int E(t - s) d(depth)/ds ds,   depth = stage - surface - F/k_frame,   F >= 0
// with c = 2 a kappa/(1 - nu^2) (models/contact/punch_contact.h) times the truth's contact_factor.
// Each step solves both equations exactly for a depth that is linear in time, with the split of
// models/material/hereditary.h. Out of contact the surface recovers without force, and the punch
// touches it where it is then.
class EmulatedSpecimen {
 public:
  explicit EmulatedSpecimen(const EmulatedTruth& truth);

  // Takes a step of dt_s >= 0 at the end of which the stage is at stage_position_m (growing toward
  // the specimen, same origin as truth.surface_position_m). Returns the force at the end, N.
  double advance(double dt_s, double stage_position_m);

  double force_N() const { return force_N_; }
  // How far the surface under the punch lies below its first position; out of contact it is not 0
  // while the surface recovers.
  double depth_m() const { return hereditary_.strain(); }
  bool is_touched() const { return is_touched_; }

 private:
  HereditaryStress hereditary_;  // strain is the depth in m, so stress is in Pa m
  double force_per_stress_m_;    // c
  double frame_stiffness_N_m_;   // 0: rigid
  double surface_position_m_;
  double force_N_ = 0.0;
  bool is_touched_ = false;
};

}  // namespace viscard
