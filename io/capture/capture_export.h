#pragma once

#include "models/experiment/captured_run.h"

#include <filesystem>
#include <string>

namespace viscard {

// Every load sample as a row: time_s, device_time_s, counts, volts, force_N, stage_position_m,
// depth_m, phase, is_saturated, is_glitch; comment lines (#) above say what the run was, whether it
// was finished, and its events. force_N follows the rig's calibration less the run's tare,
// stage_position_m the commanded moves, depth_m these, the contact found and the frame's stiffness
// (left out when no contact was found). read_csv() reads it back.
std::string csv_from_capture(const CapturedRun& run);

// The raw bytes as host_time_s, device, direction, bytes; bytes that are no printable ASCII are
// written as \r, \n or \xHH. Throws as read_raw_bytes() does.
std::string csv_from_raw_bytes(const std::filesystem::path& capture);

}  // namespace viscard
