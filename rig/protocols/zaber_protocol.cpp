#include "rig/protocols/zaber_protocol.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <utility>

namespace viscard {
namespace {

constexpr double kSpeedScale = 1.6384;
constexpr double kAccelerationScale = 1.6384 / 10000.0;

std::string two_digits(int number) {
  return (number < 10 ? "0" : "") + std::to_string(number);
}

// Removes the next word from the front; blanks and tabs separate words.
std::string_view take_word(std::string_view& text) {
  constexpr std::string_view kBlank = " \t";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return text = {};
  text.remove_prefix(first);
  const std::size_t end = std::min(text.find_first_of(kBlank), text.size());
  const std::string_view word = text.substr(0, end);
  text.remove_prefix(end);
  return word;
}

std::optional<int> small_number(std::string_view word) {
  const auto is_digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  if (word.empty() || word.size() > 2 || !std::all_of(word.begin(), word.end(), is_digit)) {
    return std::nullopt;
  }
  return static_cast<int>(*integer_from_text(word));
}

// Removes ":CC" from the end; false if the checksum is wrong. Data never contains a colon.
bool take_checksum(std::string_view& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos) return true;
  std::string found(trimmed(text.substr(colon + 1)));
  std::transform(found.begin(), found.end(), found.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  text = text.substr(0, colon);
  return found == zaber_checksum(text);
}

bool take_state(std::string_view& text, ZaberMessage& message) {
  const std::string_view state = take_word(text);
  message.is_busy = state == "BUSY";
  if (!message.is_busy && state != "IDLE") return false;
  message.flag = std::string(take_word(text));
  return message.flag.size() == 2;
}

using Row = std::pair<const char*, const char*>;

template <std::size_t n>
std::string text_of(const std::array<Row, n>& rows, std::string_view key) {
  for (const auto& [word, text] : rows) {
    if (key == word) return std::string(key) + " (" + text + ")";
  }
  return std::string(key);
}

}  // namespace

std::string zaber_checksum(std::string_view text) {
  unsigned sum = 0;
  for (const char c : text) sum += static_cast<unsigned char>(c);
  std::array<char, 3> digits{};
  std::snprintf(digits.data(), digits.size(), "%02X", (0x100U - (sum & 0xffU)) & 0xffU);
  return digits.data();
}

std::string format_zaber_command(int device, int axis, int id, std::string_view words) {
  std::string text = std::to_string(device) + " " + std::to_string(axis) + " " + two_digits(id);
  if (!words.empty()) text += " " + std::string(words);
  return "/" + text + ":" + zaber_checksum(text) + "\n";
}

std::optional<ZaberMessage> parse_zaber_message(std::string_view line) {
  // Noise in front of a message does not matter.
  const std::size_t start = line.find_first_of("@#!");
  if (start == std::string_view::npos) return std::nullopt;
  ZaberMessage message;
  message.kind = line[start] == '@'   ? ZaberMessage::Kind::kReply
                 : line[start] == '#' ? ZaberMessage::Kind::kInfo
                                      : ZaberMessage::Kind::kAlert;
  std::string_view rest = line.substr(start + 1);
  if (!take_checksum(rest)) return std::nullopt;
  const auto device = small_number(take_word(rest));
  const auto axis = small_number(take_word(rest));
  if (!device || !axis) return std::nullopt;
  message.device = *device;
  message.axis = *axis;
  if (message.kind != ZaberMessage::Kind::kAlert) {
    std::string_view after = rest;
    const std::string_view word = take_word(after);
    // Two digits right after the axis are the id; the words of a reply are letters.
    if (word.size() == 2 && (message.id = small_number(word))) rest = after;
  }
  if (message.kind == ZaberMessage::Kind::kReply) {
    const std::string_view verdict = take_word(rest);
    message.is_rejected = verdict == "RJ";
    if (!message.is_rejected && verdict != "OK") return std::nullopt;
  }
  if (message.kind != ZaberMessage::Kind::kInfo && !take_state(rest, message)) return std::nullopt;
  rest = trimmed(rest);
  message.is_continued = !rest.empty() && rest.back() == '\\';
  if (message.is_continued) rest.remove_suffix(1);
  message.data = std::string(trimmed(rest));
  return message;
}

std::string zaber_flag_text(std::string_view flag) {
  static constexpr std::array<Row, 23> kRows{
      {{"FF", "critical system error; switch the controller off and on"},
       {"FN", "peripheral not supported"},
       {"FZ", "peripheral inactive; plug it in again"},
       {"FH", "hardware emergency stop; release it"},
       {"FV", "over- or undervoltage; check the supply"},
       {"FO", "driver disabled by command"},
       {"FC", "current inrush error"},
       {"FM", "motor temperature too high"},
       {"FD", "driver disabled; check temperature and supply"},
       {"FQ", "encoder error; check its cable"},
       {"FS", "stalled and stopped; look for an obstacle"},
       {"FT", "excessive twist"},
       {"FB", "stream bounds error"},
       {"FE", "limit error; look at the limit switches"},
       {"WM", "displaced while at rest; something pushed it"},
       {"WL", "unexpected limit trigger"},
       {"WH", "device not homed"},
       {"WR", "no reference position; home it"},
       {"WS", "stalled and recovered; look for an obstacle"},
       {"WT", "controller too warm"},
       {"WV", "supply voltage out of range"},
       {"NC", "moved by its knob"},
       {"NI", "movement interrupted"}}};
  return text_of(kRows, flag);
}

std::string zaber_rejection_text(std::string_view reason) {
  static constexpr std::array<Row, 9> kRows{
      {{"BADDATA", "a number out of range; check travel and limits"},
       {"BADCOMMAND", "the firmware does not know this command"},
       {"BADAXIS", "there is no such axis; check axis_number in the rig file"},
       {"AGAIN", "not possible now; try again"},
       {"STATUSBUSY", "it is still moving"},
       {"PARKED", "it is parked; unpark it"},
       {"DRIVERDISABLED", "its motor driver is off"},
       {"FULL", "its queue is full"},
       {"DEVICEONLY", "allowed for the whole device only"}}};
  return text_of(kRows, reason);
}

long long zaber_speed_data(double microsteps_s) {
  return std::max(1LL, std::llround(microsteps_s * kSpeedScale));
}
double microsteps_s_from_zaber(double data) {
  return data / kSpeedScale;
}
double microsteps_s2_from_zaber(double data) {
  return data / kAccelerationScale;
}

}  // namespace viscard
