#include "rig/protocols/pi_protocol.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <utility>

namespace viscard {
namespace {

bool is_number(std::string_view word) {
  return !word.empty() && word.size() <= 3 &&
         std::all_of(word.begin(), word.end(),
                     [](unsigned char c) { return std::isdigit(c) != 0; });
}

}  // namespace

std::string format_pi_command(int device, std::string_view words) {
  const std::string prefix = device == 1 ? "" : std::to_string(device) + " ";
  const bool is_byte = words.size() == 1 && static_cast<unsigned char>(words.front()) < 0x20;
  std::string addressed = prefix + std::string(words) + (is_byte ? "" : "\n");
  if (words != std::string_view(&kPiStop, 1) || device == 1) return addressed;
  return kPiStop + addressed + "\n";  // the line end discards an address that the stop ignored
}

std::optional<std::string> pi_answer_text(std::string_view line, int device) {
  const std::size_t first = line.find(' ');
  const std::size_t second = first == std::string_view::npos ? first : line.find(' ', first + 1);
  const bool has_address = second != std::string_view::npos && line.substr(0, first) == "0" &&
                           is_number(line.substr(first + 1, second - first - 1));
  if (!has_address) return std::string(trimmed(line));
  if (line.substr(first + 1, second - first - 1) != std::to_string(device)) return std::nullopt;
  return std::string(trimmed(line.substr(second + 1)));
}

std::optional<std::string> pi_value_of_axis(std::string_view answer, int axis) {
  const std::string name = std::to_string(axis);
  for (const std::string_view line : split(answer, '\n')) {
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) continue;
    const std::string_view item = trimmed(line.substr(0, equals));
    if (item.substr(0, item.find(' ')) == name) {
      return std::string(trimmed(line.substr(equals + 1)));
    }
  }
  return std::nullopt;
}

std::optional<bool> parse_pi_moving(std::string_view answer, int axis) {
  answer = trimmed(answer);
  unsigned mask = 0;
  const auto [end, error] = std::from_chars(answer.data(), answer.data() + answer.size(), mask, 16);
  if (error != std::errc{} || end != answer.data() + answer.size()) return std::nullopt;
  return axis >= 1 && axis <= 32 && (mask >> (axis - 1) & 1U) != 0;
}

std::optional<bool> parse_pi_ready(std::string_view answer) {
  if (answer == "\xb1") return true;
  if (answer == "\xb0") return false;
  return std::nullopt;
}

std::optional<int> parse_pi_error(std::string_view answer) {
  constexpr long long kLargest = 100'000;
  const auto number = integer_from_text(answer);
  if (!number || *number < -kLargest || *number > kLargest) return std::nullopt;
  return static_cast<int>(*number);
}

bool is_pi_identity(std::string_view answer) {
  return answer.find("Physik Instrumente") != std::string_view::npos ||
         answer.find("(PI)") != std::string_view::npos;
}

std::string pi_error_text(int error) {
  static constexpr std::array<std::pair<int, const char*>, 16> kRows{
      {{1, "a parameter could not be read"},
       {2, "it does not know this command"},
       {5, "the axis is not referenced or its servo is off"},
       {7, "the target lies outside of its limits"},
       {8, "the speed is not allowed"},
       {10, "stopped by a command"},
       {15, "there is no such axis; check axis_number in the rig file"},
       {23, "there is no such axis; check axis_number in the rig file"},
       {45, "the reference move failed"},
       {49, "the move to the limit failed"},
       {51, "a joystick is active; switch it off"},
       {63, "it is still starting"},
       {216, "a limit switch is reached"},
       {333, "a fault of its hardware"},
       {1024,
        "motion error: the stage could not follow, so the servo was switched off; look for an "
        "obstacle or a load that is too large"},
       {-1024, "motion error: the stage could not follow, so the servo was switched off"}}};
  std::string number = "error " + std::to_string(error);
  for (const auto& [code, text] : kRows) {
    if (code == error) return number + " (" + text + ")";
  }
  return number;
}

}  // namespace viscard
