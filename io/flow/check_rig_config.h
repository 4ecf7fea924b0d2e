#pragma once

#include "models/experiment/rig_config.h"
#include "rig/rig_check.h"

namespace viscard {

// Opens both devices of a rig (or of an emulated one) and measures them for some seconds; moves
// nothing. Throws RigError as check_rig() does.
RigCheck check_rig_config(RigConfig rig, bool is_emulated, double seconds);

// As in a capture: an expired calibration, or one dated later than today, forbids a test; one
// without a date is only a warning.
void add_calibration(const RigConfig& rig, RigCheck& found);

}  // namespace viscard
