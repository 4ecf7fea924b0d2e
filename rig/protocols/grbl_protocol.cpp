#include "rig/protocols/grbl_protocol.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace viscard {
namespace {

bool starts_with_nocase(std::string_view text, std::string_view lower_prefix) {
  if (text.size() < lower_prefix.size()) return false;
  return std::equal(lower_prefix.begin(), lower_prefix.end(), text.begin(), [](char a, char b) {
    return a == static_cast<char>(std::tolower(static_cast<unsigned char>(b)));
  });
}

std::vector<double> numbers(std::string_view text) {
  std::vector<double> values;
  for (const std::string_view part : split(text, ',')) {
    const auto value = number_from_text(part);
    if (!value) return {};
    values.push_back(*value);
  }
  return values;
}

std::optional<int> code_after(std::string_view line, std::string_view lower_prefix) {
  line = trimmed(line);
  if (!starts_with_nocase(line, lower_prefix)) return std::nullopt;
  const auto code = integer_from_text(line.substr(lower_prefix.size()));
  if (!code || *code < 0 || *code > 255) return std::nullopt;
  return static_cast<int>(*code);
}

// The inside of "[KEY:inside]".
std::optional<std::string_view> bracketed(std::string_view line, std::string_view key) {
  line = trimmed(line);
  if (line.size() < key.size() + 3 || line.front() != '[' || line.back() != ']')
    return std::nullopt;
  if (line.substr(1, key.size()) != key || line[key.size() + 1] != ':') return std::nullopt;
  return line.substr(key.size() + 2, line.size() - key.size() - 3);
}

template <typename Rows>
std::string text_of_code(const std::string& kind, int code, const Rows& rows) {
  for (const auto& [number, text] : rows) {
    if (number == code) return kind + std::to_string(code) + ": " + text;
  }
  return kind + std::to_string(code);
}

void read_field(std::string_view key, std::string_view value, GrblStatus& status) {
  if (key == "MPos") status.machine_mm = numbers(value);
  if (key == "WPos") status.work_mm = numbers(value);
  if (key == "WCO") status.work_offset_mm = numbers(value);
  if (key == "Pn") status.pins = std::string(value);
  if (key == "Bf" || key == "F" || key == "FS") {
    const std::vector<double> values = numbers(value);
    if (values.empty()) return;
    if (key == "Bf") {
      status.planner_blocks_free = static_cast<int>(std::clamp(values[0], 0.0, 1e6));
    } else {
      status.feed_mm_min = values[0];
    }
  }
}

}  // namespace

std::optional<GrblStatus> parse_grbl_status(std::string_view line) {
  line = trimmed(line);
  if (line.size() < 3 || line.front() != '<' || line.back() != '>') return std::nullopt;
  if (line.find('<', 1) != std::string_view::npos) return std::nullopt;  // two reports in one line
  const std::vector<std::string_view> fields = split(line.substr(1, line.size() - 2), '|');
  GrblStatus status;
  const std::vector<std::string_view> state = split(fields[0], ':');
  const auto is_letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  if (state[0].empty() || !std::all_of(state[0].begin(), state[0].end(), is_letter)) {
    return std::nullopt;
  }
  status.state = std::string(state[0]);
  if (state.size() > 1) {
    if (const auto sub = integer_from_text(state[1]); sub && *sub >= 0 && *sub < 1000) {
      status.substate = static_cast<int>(*sub);
    }
  }
  for (std::size_t i = 1; i < fields.size(); ++i) {
    const std::size_t colon = fields[i].find(':');
    if (colon == std::string_view::npos) continue;
    read_field(fields[i].substr(0, colon), fields[i].substr(colon + 1), status);
  }
  // A report without a position was cut short.
  if (status.machine_mm.empty() && status.work_mm.empty()) return std::nullopt;
  return status;
}

bool is_grbl_ok(std::string_view line) {
  return trimmed(line) == "ok";
}

std::optional<int> parse_grbl_error(std::string_view line) {
  return code_after(line, "error:");
}

std::optional<int> parse_grbl_alarm(std::string_view line) {
  if (const auto code = code_after(line, "alarm:")) return code;
  // GRBL 0.9 sends words (report.c, report_alarm_message).
  static constexpr std::array<std::pair<const char*, int>, 3> kWords{
      {{"alarm: hard/soft limit", 1}, {"alarm: abort during cycle", 3}, {"alarm: probe fail", 5}}};
  for (const auto& [words, code] : kWords) {
    if (starts_with_nocase(trimmed(line), words)) return code;
  }
  return std::nullopt;
}

std::optional<GrblWelcome> parse_grbl_welcome(std::string_view line) {
  line = trimmed(line);
  GrblWelcome welcome;
  if (starts_with_nocase(line, "grblhal ")) {
    welcome.is_hal = true;
  } else if (!starts_with_nocase(line, "grbl ")) {
    return std::nullopt;
  }
  line.remove_prefix(line.find(' ') + 1);
  welcome.version = std::string(line.substr(0, line.find(' ')));
  return welcome;
}

std::optional<GrblSetting> parse_grbl_setting(std::string_view line) {
  line = trimmed(line);
  const std::size_t equals = line.find('=');
  if (line.empty() || line.front() != '$' || equals == std::string_view::npos) return std::nullopt;
  const auto number = integer_from_text(line.substr(1, equals - 1));
  // GRBL 0.9 and some clones add "(text)" after the value.
  std::string_view value_text = line.substr(equals + 1);
  value_text = value_text.substr(0, value_text.find('('));
  const auto value = number_from_text(value_text);
  if (!number || !value || *number < 0 || *number > 9999) return std::nullopt;
  return GrblSetting{static_cast<int>(*number), *value};
}

std::optional<std::string> parse_grbl_message(std::string_view line) {
  const auto inside = bracketed(line, "MSG");
  if (!inside) return std::nullopt;
  return std::string(*inside);
}

std::optional<std::string> parse_grbl_build_options(std::string_view line) {
  const auto inside = bracketed(trimmed(line), "OPT");
  if (!inside) return std::nullopt;
  return std::string(inside->substr(0, inside->find(',')));
}

bool is_grbl_push(std::string_view line) {
  line = trimmed(line);
  return line.empty() || line.front() == '<' || line.front() == '[' || line.front() == '$' ||
         line.front() == '>' || parse_grbl_alarm(line) || parse_grbl_welcome(line);
}

std::string format_grbl_jog(char axis, double target_mm, double feed_mm_min) {
  return std::string("$J=G53G90G21") + axis + text_from_number(target_mm, 5) + "F" +
         text_from_number(feed_mm_min, 3);
}

std::string grbl_error_text(int code) {
  static constexpr std::array<std::pair<int, const char*>, 17> kTexts{
      {{1, "a letter was expected"},
       {2, "a number could not be read"},
       {3, "the '$' command is unknown to this firmware"},
       {4, "a value must not be negative"},
       {5, "homing is switched off: set $22=1, or leave homing out of the rig file"},
       {7, "the settings memory was empty and has been filled with defaults: set it up again"},
       {8, "the command is allowed only at rest"},
       {9, "the stage is locked by an alarm: unlock it with $X after checking it"},
       {10, "soft limits need homing: set $22=1"},
       {11, "the line is too long"},
       {13, "the safety door is open: close it"},
       {14, "a settings line is too long"},
       {15, "the target is beyond the stage's travel ($130-132)"},
       {16, "a word that is not allowed in a jog"},
       {20, "a word that this firmware does not know"},
       {22, "the feed rate is missing"},
       {33, "the target is invalid"}}};
  return text_of_code("error ", code, kTexts);
}

std::string grbl_alarm_text(int code, bool is_hal) {
  static constexpr std::array<std::pair<int, const char*>, 9> kCommonTexts{
      {{1, "a limit switch was hit; the position is lost"},
       {2, "the target lies beyond the soft limits"},
       {3, "reset while moving; steps may be lost"},
       {4, "the probe was not in its expected state"},
       {5, "the probe touched nothing"},
       {6, "homing was interrupted by a reset"},
       {7, "homing was interrupted by the door"},
       {8, "homing could not clear the limit switch: raise the pull-off $27, or check its wiring"},
       {9, "homing found no limit switch: check its wiring and the travel $130-132"}}};
  static constexpr std::array<std::pair<int, const char*>, 1> kGrblTexts{
      {{10, "homing found no second limit switch of an axis with two motors: check its wiring"}}};
  static constexpr std::array<std::pair<int, const char*>, 13> kHalTexts{
      {{10, "the emergency stop is pressed: release it, then switch the controller off and on"},
       {11, "it must be homed first: set home = true under [stage] of the rig file"},
       {12, "a limit switch is pressed: free it"},
       {13, "the protection of the probe was triggered: free the probe"},
       {14, "the spindle did not come to its speed"},
       {15, "homing found no second limit switch of an axis with two motors: check its wiring"},
       {16, "its self-test at power-on failed"},
       {17, "a motor driver reports a fault: check the motor and its supply"},
       {18, "homing failed: its settings do not fit ($22-$27, $44-46)"},
       {19, "a device on its Modbus does not answer"},
       {20, "its input and output expander does not answer"},
       {21, "its memory of the settings failed"},
       {22, "a buffer overflowed"}}};
  if (code < 10) return text_of_code("alarm ", code, kCommonTexts);
  return is_hal ? text_of_code("alarm ", code, kHalTexts)
                : text_of_code("alarm ", code, kGrblTexts);
}

}  // namespace viscard
