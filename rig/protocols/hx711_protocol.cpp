#include "rig/protocols/hx711_protocol.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <initializer_list>

namespace viscard {
namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

bool is_one_of(std::initializer_list<const char*> words, std::string_view text) {
  return std::find(words.begin(), words.end(), lower(trimmed(text))) != words.end();
}

bool is_no_number_word(std::string_view text) {
  return is_one_of({"nan", "-nan", "inf", "-inf", "ovf", "-ovf", "+inf", "overflow"}, text);
}

bool is_unit(std::string_view text) {
  return is_one_of({"g", "kg", "lbs", "lb", "n"}, text);
}

// Reads "12.34 g", "12.34g", "12,34" or "nan" into line; false for anything else.
bool read_value(std::string_view text, bool allow_comma, Hx711Line& line) {
  text = trimmed(text);
  if (text.empty()) return false;
  if (is_no_number_word(text)) return true;
  std::size_t end = text.find_last_of("0123456789.");
  if (end == std::string_view::npos) return false;
  const std::string_view unit = trimmed(text.substr(end + 1));
  if (!unit.empty() && !is_unit(unit)) return false;
  std::string digits(trimmed(text.substr(0, end + 1)));
  if (allow_comma && std::count(digits.begin(), digits.end(), ',') == 1 &&
      digits.find('.') == std::string::npos) {
    std::replace(digits.begin(), digits.end(), ',', '.');
  }
  const auto value = number_from_text(digits);
  if (!value) return false;
  line.value = value;
  line.is_integer = digits.find_first_of(".eE") == std::string::npos;
  line.unit = std::string(unit);
  return true;
}

}  // namespace

std::optional<Hx711Format> hx711_format_from_word(std::string_view word) {
  for (const auto format : {Hx711Format::kAuto, Hx711Format::kCounts, Hx711Format::kMicrosCounts,
                            Hx711Format::kMillisCounts, Hx711Format::kVolts}) {
    if (word == word_of(format)) return format;
  }
  return std::nullopt;
}

const char* word_of(Hx711Format format) {
  switch (format) {
    case Hx711Format::kCounts:
      return "counts";
    case Hx711Format::kMicrosCounts:
      return "micros,counts";
    case Hx711Format::kMillisCounts:
      return "millis,counts";
    case Hx711Format::kVolts:
      return "volts";
    case Hx711Format::kAuto:
      break;
  }
  return "auto";
}

std::optional<Hx711Line> parse_hx711_line(std::string_view text, bool has_clock) {
  text = trimmed(text);
  Hx711Line line;
  if (has_clock) {
    const std::vector<std::string_view> parts = split(text, ',');
    if (parts.size() < 2) return std::nullopt;
    const auto ticks = integer_from_text(parts[0]);
    if (!ticks || *ticks < 0 || *ticks > 0xffffffffLL) return std::nullopt;
    if (!read_value(parts[1], false, line)) return std::nullopt;
    line.ticks = static_cast<double>(*ticks);
    if (parts.size() > 2 && is_unit(parts[2])) line.unit = std::string(trimmed(parts[2]));
    return line;
  }
  // Of "one reading:\t12.3\t| average:\t12.4" the first number is taken.
  std::string_view rest = text.substr(0, text.find('|'));
  const std::size_t colon = rest.rfind(':');
  if (colon != std::string_view::npos) rest = rest.substr(colon + 1);
  if (lower(rest.substr(0, 5)) == "read ") rest.remove_prefix(5);  // of Adafruit_NAU7802
  if (!read_value(rest, true, line)) return std::nullopt;
  return line;
}

bool is_hx711_fault(std::string_view text) {
  const std::string line = lower(text);
  constexpr std::array kFaults{"hx711 not found", "not ready", "scale not detected",
                               "failed to find nau7802"};
  return std::any_of(kFaults.begin(), kFaults.end(),
                     [&](const char* fault) { return line.find(fault) != std::string::npos; });
}

bool is_hx711_glitch(double counts, std::optional<double> previous_counts) {
  constexpr double kLeast = 1023.0;  // shorter runs of ones are within the noise of a reading
  constexpr double kJump = 1000.0;
  if (!previous_counts || std::abs(counts - *previous_counts) < kJump) return false;
  if (counts == -1.0) return true;
  if (!(counts >= kLeast) || counts >= kHx711Highest || counts != std::floor(counts)) return false;
  const auto code = static_cast<unsigned long>(counts);
  return (code & (code + 1)) == 0;
}

}  // namespace viscard
