#include "rig/protocols/marlin_protocol.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <array>

namespace viscard {
namespace {

bool begins(std::string_view text, std::string_view with) {
  return text.substr(0, with.size()) == with;
}

// What follows `word`, or nothing if the line does not begin with it.
std::optional<std::string_view> behind(std::string_view line, std::string_view word) {
  line = trimmed(line);
  if (!begins(line, word)) return std::nullopt;
  return trimmed(line.substr(word.size()));
}

}  // namespace

std::string format_marlin_line(long number, std::string_view command) {
  const std::string text = "N" + std::to_string(number) + " " + std::string(command);
  unsigned sum = 0;
  for (const char c : text) sum ^= static_cast<unsigned char>(c);
  return text + "*" + std::to_string(sum) + "\n";
}

std::string format_marlin_move(char axis, double to_mm, double feed_mm_min) {
  return std::string("G1 ") + axis + text_from_number(to_mm, 5) + " F" +
         text_from_number(feed_mm_min, 3);
}

bool is_marlin_ok(std::string_view line) {
  line = trimmed(line);
  return line == "ok" || begins(line, "ok ");
}

bool is_marlin_start(std::string_view line) {
  line = trimmed(line);
  return line == "start" || begins(line, "echo:Marlin ") || begins(line, "Marlin ");
}

bool is_marlin_busy(std::string_view line) {
  return behind(line, "echo:busy").has_value() || behind(line, "busy:").has_value();
}

bool is_marlin_endstop(std::string_view line) {
  return behind(line, "echo:endstops hit").has_value();
}

std::optional<long> parse_marlin_resend(std::string_view line) {
  const auto rest = behind(line, "Resend:");
  const auto number = rest ? integer_from_text(*rest) : std::nullopt;
  if (!number || *number < 0) return std::nullopt;
  return static_cast<long>(*number);
}

std::optional<std::string> parse_marlin_error(std::string_view line) {
  const auto rest = behind(line, "Error:");
  if (!rest || rest->find("Last Line:") != std::string_view::npos) return std::nullopt;
  return std::string(*rest);
}

std::optional<std::string> parse_marlin_echo(std::string_view line) {
  auto rest = behind(line, "echo:");
  if (!rest) rest = behind(line, "//");
  if (!rest || rest->empty()) return std::nullopt;
  return std::string(*rest);
}

std::optional<std::string> parse_marlin_firmware(std::string_view line) {
  const auto rest = behind(line, "FIRMWARE_NAME:");
  if (!rest) return std::nullopt;
  std::size_t end = rest->size();
  for (const char* key : {" SOURCE_CODE_URL:", " FIRMWARE_URL:", " PROTOCOL_VERSION:"}) {
    end = std::min(end, rest->find(key));
  }
  return std::string(trimmed(rest->substr(0, end)));
}

bool has_marlin_emergency_parser(std::string_view line) {
  return trimmed(line) == "Cap:EMERGENCY_PARSER:1";
}

std::optional<long long> parse_marlin_count(std::string_view line, char axis) {
  const std::size_t count = line.find("Count ");
  if (count == std::string_view::npos) return std::nullopt;
  line.remove_prefix(count);
  const std::size_t at = line.find(std::string(1, axis) + ":");
  if (at == std::string_view::npos) return std::nullopt;
  std::string_view digits = trimmed(line.substr(at + 2));
  return integer_from_text(digits.substr(0, digits.find_first_of(" \t\r\n")));
}

void add_marlin_settings(std::string_view line, std::map<std::string, double>& settings) {
  static constexpr std::array<std::string_view, 4> kCodes{"M92", "M201", "M203", "M204"};
  if (const auto rest = behind(line, "echo:")) line = *rest;
  line = trimmed(line.substr(0, line.find(';')));
  for (const std::string_view code : kCodes) {
    if (!begins(line, std::string(code) + " ")) continue;
    for (const std::string_view word : split(line.substr(code.size() + 1), ' ')) {
      const auto value = word.empty() ? std::nullopt : number_from_text(word.substr(1));
      if (value) settings[std::string(code) + word.front()] = *value;
    }
  }
}

}  // namespace viscard
