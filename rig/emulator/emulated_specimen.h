#pragma once

#include "models/experiment/emulated_specimen.h"
#include "models/material/hereditary.h"

namespace viscard {

// A viscoelastic layer under a flat punch, pressed by a stage through a frame spring (the load cell
// is part of it):
//   F(t) = c int E(t - s) d(depth)/ds ds,   depth = stage - surface - F/k_frame,   F >= 0
// with c = 2 a kappa/(1 - nu^2) (models/punch_contact.h). Each step solves the pair exactly for a
// depth that is linear in it, with the split of models/hereditary.h. Out of contact the free
// surface recovers under no force, and the punch meets it where it then is.
class EmulatedSpecimen {
 public:
  explicit EmulatedSpecimen(const EmulatedTruth& truth);

  // Takes a step of dt_s >= 0 at whose end the stage stands at stage_position_m (grows toward the
  // specimen, same origin as truth.surface_position_m). Returns the force then, N.
  double advance(double dt_s, double stage_position_m);

  double force_N() const { return force_N_; }
  // How far the surface under the punch lies below where it was at first; not 0 out of contact
  // while it recovers.
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
