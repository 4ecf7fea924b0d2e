#pragma once

#include "models/experiment/captured_run.h"
#include "models/experiment/run_timing.h"

#include <filesystem>
#include <string>

namespace viscard {

// With this the head of such a table begins, in a comment.
inline constexpr const char* kExportedHead = "load-cell samples of a capture, written by ";

// Every load sample as a row: time_s, host_time_s, device_time_s, counts, volts, force_N,
// stage_position_m, depth_m, temperature_C, phase, is_saturated, is_glitch. Comment lines (#) above them describe
// the run, its status and its events. time_s is the time of the reading by `timing`, host_time_s
// when it was received. force_N is the force by the rig's calibration minus the tare of the run;
// stage_position_m is the position at time_s of moves that start by `timing`; depth_m is counted
// from the contact and corrected for the frame's stiffness (the column is left out if no contact was
// found); temperature_C (only with a thermometer) is its newest reading at host_time_s. Without a
// timing, receive times and recorded starts are used: positions in a ramp are then
// wrong by the delays. read_csv() reads the table back.
std::string csv_from_capture(const CapturedRun& run, const RunTiming& timing = {});

// The raw bytes as host_time_s, device, direction, bytes, below a comment line for each damage to the
// capture; `run` is what read_capture() returned. Bytes that are not printable ASCII are written as \r,
// \n or \xHH. Throws as read_raw_bytes() does.
std::string csv_from_raw_bytes(const std::filesystem::path& capture, const CapturedRun& run);

}  // namespace viscard
