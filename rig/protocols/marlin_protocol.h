#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace viscard {

// Writes and reads lines of Marlin-type G-code firmware; knows no port. Sources: Marlin's
// documentation (marlinfw.org/docs/gcode: M110, M114, M115, M410, M503) and MarlinFirmware/Marlin,
// Marlin/src/gcode/queue.cpp.
//   line     N2 G1 Z-0.25 F3*49     number, command, XOR of all bytes before the '*'
//   answer   ok, with or without more: ok N2 P15 B3
//   refusal  Error:checksum mismatch, Last Line: 1, then Resend: 2, then ok in some versions
// A line with the wrong number or checksum is not carried out, so a line may be sent again.

// "N2 G1 Z-0.25 F3*49\n".
std::string format_marlin_line(long number, std::string_view command);
// "G1 Z-0.02000 F3.000": to a position in mm, at mm/min.
std::string format_marlin_move(char axis, double to_mm, double feed_mm_min);

bool is_marlin_ok(std::string_view line);
// "start" and the banner "echo:Marlin 2.1.2": the firmware has just started.
bool is_marlin_start(std::string_view line);
// "echo:busy: processing": the answer comes later.
bool is_marlin_busy(std::string_view line);
// "echo:endstops hit:  Z:1.00": a limit switch ended a move.
bool is_marlin_endstop(std::string_view line);
// "Resend: 12": the number of the line that it expects.
std::optional<long> parse_marlin_resend(std::string_view line);
// The text of "Error:..."; nothing for the errors that a Resend follows.
std::optional<std::string> parse_marlin_error(std::string_view line);
// The text of "echo:..." or "//...".
std::optional<std::string> parse_marlin_echo(std::string_view line);
// M115: "Marlin 2.1.2 (Feb 1 2023)" of "FIRMWARE_NAME:Marlin 2.1.2 (Feb 1 2023) SOURCE_CODE_URL:...".
std::optional<std::string> parse_marlin_firmware(std::string_view line);
// M115: "Cap:EMERGENCY_PARSER:1".
bool has_marlin_emergency_parser(std::string_view line);
// M114 R: the steps of an axis after "Count": "X:0.00 Z:145.00 E:0.00 Count X: 0 Z:116000".
std::optional<long long> parse_marlin_count(std::string_view line, char axis);
// M503: adds the values of M92, M201, M203 and M204 in a line, as "M92Z": "echo:  M92 X80 Z400".
void add_marlin_settings(std::string_view line, std::map<std::string, double>& settings);

}  // namespace viscard
