#pragma once

#include "models/captured_run.h"

#include <iosfwd>

namespace viscard {

// Every load sample as a row: time_s, device_time_s, counts, volts, force_N, stage_position_m,
// phase, is_saturated, is_glitch. force_N uses the rig's calibration and the tare event of the run;
// stage_position_m follows the commanded moves. Comment lines (#) above say what the run was and
// whether it was finished. read_csv() reads it back.
void write_capture_csv(const CapturedRun& run, std::ostream& out);

}  // namespace viscard
