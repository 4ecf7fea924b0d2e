#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace viscard {

// Writes and reads lines of the Newport SMC100CC and SMC100PP; knows no port. Sources: Newport
// "SMC100CC & SMC100PP User's Manual" (EDH0206En2042), chapter 6; freespace/pySMC100; hvl_ccb,
// Newport SMC100PP driver; houlihaj/newport-smc100 (names of the states).
//   question  1TP        answer  1TP-0.25003     the same address and letters
//   command   1PA0.25    no answer; 1TE then answers 1TE@, or the letter of the error
// Lengths in mm, speeds in mm/s, accelerations in mm/s^2.

inline constexpr char kSmcXon = '\x11', kSmcXoff = '\x13';  // flow control, beside the lines

// "1PA0.25\r\n".
std::string format_smc_command(int device, std::string_view words);

// What follows address and letters: "-0.25003" of "1TP-0.25003" for the question "TP" or "TP?".
// Returns nothing for an answer to another question, from another address, or with a byte that no
// answer has (after the supply was cut, NUL).
std::optional<std::string> smc_answer_text(std::string_view line, int device,
                                           std::string_view question);

// The answer to TS: four digits of faults, two of the state, hexadecimal.
struct SmcState {
  unsigned faults = 0;
  unsigned state = 0;
};
// Returns nothing for other text and for a state that the manual does not name.
std::optional<SmcState> parse_smc_state(std::string_view text);

bool is_smc_referenced(const SmcState& state);  // false also in configuration and while it homes
bool is_smc_homing(const SmcState& state);
bool is_smc_moving(const SmcState& state);  // also while it homes or follows its keypad
bool is_smc_ready(const SmcState& state);
bool is_smc_disabled(const SmcState& state);  // the motor is off

// The faults in words, such as "following error"; empty for none.
std::string smc_fault_text(unsigned faults);

// What the answer to TE means and what to do about it; empty for "@", no error.
std::string smc_error_text(std::string_view letter);

}  // namespace viscard
