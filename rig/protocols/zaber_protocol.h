#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace viscard {

// Writes and reads lines of the Zaber ASCII protocol; knows no port. Sources: Zaber ASCII Protocol
// Manual (zaber.com); stphnt/zproto, src/ascii.
//   command  /1 1 07 get pos:CC
//   reply    @01 1 07 OK IDLE -- 12345:CC
//   info     #01 1 07 text
//   alert    !01 1 IDLE --
// Addresses and ids are decimal; axis 0 is the whole device. The checksum CC is optional in both
// directions.

// Two's complement of the sum of all bytes between the type character and the colon, as two
// hexadecimal digits.
std::string zaber_checksum(std::string_view text);

// "/1 1 07 get pos:CC\n".
std::string format_zaber_command(int device, int axis, int id, std::string_view words);

struct ZaberMessage {
  enum class Kind { kReply, kInfo, kAlert };
  Kind kind = Kind::kReply;
  int device = 0;
  int axis = 0;
  std::optional<int> id;     // nothing if the command had none, and in alerts
  bool is_rejected = false;  // reply: RJ
  bool is_busy = false;      // reply, alert: BUSY, the axis moves
  std::string flag;          // reply, alert: the warning of highest priority; "--" if there is none
  std::string data;          // the rest, without blanks around it
  bool is_continued = false;  // ends in a backslash: "cont" info messages carry the rest
};
// Returns nothing for other text and for a message with a wrong checksum.
std::optional<ZaberMessage> parse_zaber_message(std::string_view line);

// F...: a fault. The axis has stopped by itself, or its driver is off.
inline bool is_zaber_fault(std::string_view flag) {
  return !flag.empty() && flag.front() == 'F';
}

// What a warning flag, or the data of a rejection, means and what to do about it.
std::string zaber_flag_text(std::string_view flag);
std::string zaber_rejection_text(std::string_view reason);

// Speeds are sent as microsteps/s * 1.6384, accelerations as microsteps/s^2 * 1.6384/10000 (ASCII
// Protocol Manual, "maxspeed" and "accel").
long long zaber_speed_data(double microsteps_s);
double microsteps_s_from_zaber(double data);
double microsteps_s2_from_zaber(double data);

}  // namespace viscard
