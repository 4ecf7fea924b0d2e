#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace viscard {

// Writes and reads lines of PI's General Command Set 2; knows no port. Sources: PI "C-863 Mercury
// Controller, Commands" (MS173E); PI-PhysikInstrumente/PIPython, gcsmessages and gcserror.
//   question  POS? 1        answer  1=0.2500000
//   command   MOV 1 0.25    no answer; ERR? then answers 0, or the number of the error
// Lengths in mm, speeds in mm/s, accelerations in mm/s^2. A line that ends in a blank is continued
// by the next one. Single bytes are carried out at once, also in the middle of a line.

inline constexpr char kPiIsMoving = '\x05';  // answered by a hexadecimal mask of the moving axes
inline constexpr char kPiIsReady = '\x07';   // answered by B1 (ready) or B0 (a reference move runs)
inline constexpr char kPiStop = '\x18';      // all axes stop at once; leaves error 10
inline constexpr int kPiStopped = 10;        // the error that every stop leaves

// "POS? 1\n"; on a chain "3 POS? 1\n" with the address in front. A single byte has no line end.
// Address 1 is written without a prefix, which a controller that stands alone expects. The stop is
// written without an address first, because it is meant for all.
std::string format_pi_command(int device, std::string_view words);

// An answer without its address ("0 3 " from address 3; controllers that stand alone send none).
// Returns nothing for an answer from another address.
std::optional<std::string> pi_answer_text(std::string_view line, int device);

// What stands behind "=" for the axis: "0.25" of "1=0.25", or of "1 0xE=0.25" for a parameter. The
// answer may have several lines. Returns nothing if the axis is not in it.
std::optional<std::string> pi_value_of_axis(std::string_view answer, int axis);

// Whether the axis moves, from the answer to kPiIsMoving; its first axis is 1. Nothing for other text.
std::optional<bool> parse_pi_moving(std::string_view answer, int axis);

// From the answer to kPiIsReady.
std::optional<bool> parse_pi_ready(std::string_view answer);

// From the answer to ERR?.
std::optional<int> parse_pi_error(std::string_view answer);

// The answer to *IDN?: "(c)2013 Physik Instrumente (PI) ..., C-863.11, 0, 1.2.1.0".
bool is_pi_identity(std::string_view answer);

// What an error means and what to do about it.
std::string pi_error_text(int error);

}  // namespace viscard
