#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace viscard {

// Writes and reads lines of GRBL 1.1 and grblHAL; knows no port.
// Source: gnea/grbl doc/markdown/{interface,commands,jogging,settings}.md and
// grbl/{gcode,report}.c.

// Realtime commands: single bytes that are accepted at any time and never answered by "ok".
namespace grbl {
inline constexpr char kStatus = '?';
inline constexpr char kHold = '!';
inline constexpr char kResume = '~';
inline constexpr char kSoftReset = '\x18';
inline constexpr char kJogCancel = static_cast<char>(0x85);
}  // namespace grbl

// <State:sub|MPos:x,y,z|...>. Fields come in any order; unknown ones are ignored. Lengths are in
// mm, or in inches if setting $13 is 1, which the caller must know.
struct GrblStatus {
  std::string state;                   // Idle Run Hold Jog Home Alarm Door Check Sleep Tool
  int substate = -1;                   // of Hold and Door; -1: not given
  std::vector<double> machine_mm;      // empty if the report carries work positions
  std::vector<double> work_mm;         // empty if it carries machine positions
  std::vector<double> work_offset_mm;  // WCO, in some reports; WPos = MPos - WCO
  int planner_blocks_free = -1;        // Bf; -1: not given
  double feed_mm_min = -1.0;           // F or FS; negative: not given
  std::string pins;                    // Pn: letters of the active switches
};
std::optional<GrblStatus> parse_grbl_status(std::string_view line);

bool is_grbl_ok(std::string_view line);
std::optional<int> parse_grbl_error(std::string_view line);  // "error:9"
std::optional<int> parse_grbl_alarm(std::string_view line);  // "ALARM:1"

// "Grbl 1.1h ['$' for help]", "GrblHAL 1.1f ['$' or '$HELP' for help]".
struct GrblWelcome {
  bool is_hal = false;
  std::string version;
};
std::optional<GrblWelcome> parse_grbl_welcome(std::string_view line);

// "$102=3200.000".
struct GrblSetting {
  int number = 0;
  double value = 0.0;
};
std::optional<GrblSetting> parse_grbl_setting(std::string_view line);

// The text of "[MSG:Caution: Unlocked]".
std::optional<std::string> parse_grbl_message(std::string_view line);

// The letters of the build in "[OPT:VH,15,128]", an answer to $I.
std::optional<std::string> parse_grbl_build_options(std::string_view line);
// The build homes one axis alone ($HX, $HY, $HZ). Others answer $HZ with error:3 and are left in a
// state that only a reset ends (gnea/grbl system.c).
inline constexpr char kGrblHomesOneAxis = 'H';

// True for lines that answer no command: messages, settings, reports, alarms, welcomes, blank
// lines, and ">line:ok" of start-up blocks.
bool is_grbl_push(std::string_view line);

// "$J=G53G90G21Z-1.23456F30.000": a jog to an absolute machine position, so that neither rounding
// errors nor a repeated line add up.
std::string format_grbl_jog(char axis, double target_mm, double feed_mm_min);

// What a code means and what to do about it.
std::string grbl_error_text(int code);
// From alarm 10 on the two dialects differ (grblHAL core alarms.h; 10 of newer forks of gnea/grbl).
std::string grbl_alarm_text(int code, bool is_hal);

}  // namespace viscard
