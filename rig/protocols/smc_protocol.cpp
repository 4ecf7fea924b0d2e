#include "rig/protocols/smc_protocol.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

namespace viscard {
namespace {

bool is_between(unsigned value, unsigned low, unsigned high) {
  return low <= value && value <= high;
}

std::optional<unsigned> hex_number(std::string_view text) {
  unsigned value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value, 16);
  if (text.empty() || error != std::errc{} || stop != end) return std::nullopt;
  return value;
}

}  // namespace

std::string format_smc_command(int device, std::string_view words) {
  return std::to_string(device) + std::string(words) + "\r\n";
}

std::optional<std::string> smc_answer_text(std::string_view line, int device,
                                           std::string_view question) {
  constexpr std::size_t kLetters = 2;
  const auto is_odd = [](unsigned char c) { return c < 0x20 || c >= 0x7f; };
  if (std::any_of(line.begin(), line.end(), is_odd)) return std::nullopt;
  const std::string prefix = std::to_string(device) + std::string(question.substr(0, kLetters));
  if (line.substr(0, prefix.size()) != prefix) return std::nullopt;
  return std::string(trimmed(line.substr(prefix.size())));
}

std::optional<SmcState> parse_smc_state(std::string_view text) {
  constexpr std::size_t kFaultDigits = 4, kDigits = 6;
  if (text.size() != kDigits) return std::nullopt;
  const auto faults = hex_number(text.substr(0, kFaultDigits));
  const auto state = hex_number(text.substr(kFaultDigits));
  if (!faults || !state) return std::nullopt;
  const SmcState found{*faults, *state};
  const bool is_known = is_between(*state, 0x0a, 0x11) || *state == 0x14 || is_smc_moving(found) ||
                        is_smc_ready(found) || is_smc_disabled(found);
  return is_known ? std::optional(found) : std::nullopt;
}

bool is_smc_referenced(const SmcState& state) {
  return state.state >= 0x28;
}
bool is_smc_homing(const SmcState& state) {
  return is_between(state.state, 0x1e, 0x1f);
}
bool is_smc_moving(const SmcState& state) {
  return state.state == 0x28 || is_smc_homing(state) || is_between(state.state, 0x46, 0x47);
}
bool is_smc_ready(const SmcState& state) {
  return is_between(state.state, 0x32, 0x35);
}
bool is_smc_disabled(const SmcState& state) {
  return is_between(state.state, 0x3c, 0x3e);
}

std::string smc_fault_text(unsigned faults) {
  static constexpr std::array<std::pair<unsigned, const char*>, 10> kRows{
      {{0x001, "the negative end of its travel is reached"},
       {0x002, "the positive end of its travel is reached"},
       {0x004, "peak current"},
       {0x008, "the motor draws too much current"},
       {0x010, "short circuit"},
       {0x020,
        "following error: the stage could not follow; look for an obstacle or a load that is "
        "too large"},
       {0x040, "homing took too long"},
       {0x080, "the stage is not the one of the configuration"},
       {0x100, "the supply voltage is too low"},
       {0x200, "more than 80 W"}}};
  std::string text;
  for (const auto& [bit, words] : kRows) {
    if ((faults & bit) != 0) text += (text.empty() ? "" : "; ") + std::string(words);
  }
  return text;
}

std::string smc_error_text(std::string_view letter) {
  static constexpr std::array<std::pair<char, const char*>, 19> kRows{
      {{'A', "it does not know this command"},
       {'B', "wrong address"},
       {'C', "a parameter is missing or out of range"},
       {'D', "not allowed now"},
       {'E', "homing is running"},
       {'F', "it does not know the stage"},
       {'G', "the move goes beyond its limits"},
       {'H', "it has no reference; home it"},
       {'I', "it is in configuration"},
       {'J', "its motor is off"},
       {'K', "not allowed when it is ready"},
       {'L', "not allowed while it homes"},
       {'M', "not allowed while it moves"},
       {'N', "outside of its software limits"},
       {'S', "time-out of its own link"},
       {'U', "fault of its memory"},
       {'V', "it failed while it carried the command out"},
       {'W', "not for the model PP"},
       {'X', "not for the model CC"}}};
  if (letter == "@") return "";
  std::string error = "error " + std::string(letter);
  for (const auto& [key, text] : kRows) {
    if (letter.size() == 1 && letter.front() == key) return error + " (" + text + ")";
  }
  return error;
}

}  // namespace viscard
