#include "rig/emulator/emulated_specimen.h"

#include "models/contact/punch_contact.h"
#include "models/material/material.h"

namespace viscard {

EmulatedSpecimen::EmulatedSpecimen(const EmulatedTruth& truth)
    : hereditary_(young_series(truth.material)),
      force_per_stress_m_(truth.contact_factor * force_per_modulus_and_depth_m(truth.contact)),
      frame_stiffness_N_m_(truth.frame_stiffness_N_m),
      surface_position_m_(truth.surface_position_m) {}

double EmulatedSpecimen::advance(double dt_s, double stage_position_m) {
  const double pressed_m = stage_position_m - surface_position_m_;
  if (!is_touched_ && pressed_m <= 0.0) return 0.0;
  // At the end of the step, stress = modulus * depth + carried; at free_m the stress is zero.
  const double modulus_Pa = hereditary_.algorithmic_modulus_Pa(dt_s);
  const double free_m = -hereditary_.carried_Pa(dt_s) / modulus_Pa;
  double depth_m = free_m;
  if (pressed_m > free_m) {
    is_touched_ = true;
    const double stiffness_N_m = force_per_stress_m_ * modulus_Pa;
    const double share = frame_stiffness_N_m_ > 0.0
                             ? frame_stiffness_N_m_ / (frame_stiffness_N_m_ + stiffness_N_m)
                             : 1.0;
    depth_m = free_m + share * (pressed_m - free_m);
  }
  const double stress_Pa_m = hereditary_.advance(dt_s, depth_m);
  force_N_ = pressed_m > free_m ? force_per_stress_m_ * stress_Pa_m : 0.0;
  return force_N_;
}

}  // namespace viscard
