#pragma once

#include "models/contact/punch_contact.h"
#include "models/experiment/rig_config.h"
#include "models/material/material.h"

#include <cstdint>

namespace viscard {

// The true properties of an emulated rig; SI. They are written to a file beside the capture, so
// that the result of a fit can be compared with them.
struct EmulatedTruth {
  Material material;
  PunchContact contact;
  double frame_stiffness_N_m = 10e3;
  double surface_position_m = 1.0e-3;  // stage position at contact, on the axis toward the specimen
  double force_noise_N = 0.0;          // standard deviation of white noise of one reading
  double force_offset_N = 0.0;
  double drift_relative_per_s = 0.0;  // of the force that acts
  // How the cell differs from its nominal calibration.
  double cell_gain = 0.0;  // V/N (or N/N of a force gauge); 0: that of the rig's calibration
  double cell_full_scale_N = 2.45;  // to which the next two values are relative
  double cell_nonlinearity = 0.0;   // departure from the line through the ends, at half scale
  double cell_hysteresis = 0.0;     // largest difference between falling and rising load
  double overload_N = 0.0;          // the cell breaks above it (usually 1.5 x capacity); 0: never
  double sample_rate_Hz = 80.0;     // true rate on the emulated clock
  double steps_per_m = 3200e3;      // GRBL $102
  double acceleration_m_s2 = 0.2;   // GRBL $122
  double max_rate_m_s = 10e-3;      // GRBL $112
  // How specimens and touches of a campaign differ (rig/emulator/emulated_touch.h); 0: not at all.
  double specimen_scatter = 0.0;   // standard deviation of ln E0 between specimens
  double alignment_scatter = 0.0;  // of ln contact_factor between touches
  double surface_scatter_m = 0.0;  // of the surface position between touches
  double contact_factor = 1.0;     // of this touch: force over that of the ideal contact
  std::uint64_t seed = 1;
};

}  // namespace viscard
