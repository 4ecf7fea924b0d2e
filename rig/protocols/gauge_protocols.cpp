#include "rig/protocols/gauge_protocols.h"

#include "models/maths/text_of_number.h"
#include "rig/lines/rig_error.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

constexpr double kOverload = 9.9e37;
constexpr const char* kClear = "\x03";  // device clear: aborts a measurement in progress

// On RS-232 remote control must be switched on first. The range of 10 V covers the amplifier
// without autoranging, one power line cycle is the shortest integration that rejects hum, and
// autozero would halve the rate. No line of the opening is answered, so that answers stay in step
// with queries.
const std::array<GaugeProtocol, 3>& dialects() {
  static const std::array<GaugeProtocol, 3> kRows{
      {{.name = "34401a",
        .opening = {kClear, "SYST:REM\n", "*CLS\n", "CONF:VOLT:DC 10,0.0001\n", "VOLT:DC:NPLC 1\n",
                    "ZERO:AUTO OFF\n", "TRIG:SOUR IMM\n", "SAMP:COUN 1\n"},
        .identity_query = "*IDN?\n",
        .query = "READ?\n",
        .error_query = "SYST:ERR?\n",
        .closing = "SYST:LOC\n",
        .parse = parse_scpi_reading},
       {.name = "gdm",
        .opening = {"*CLS\n", "CONF:VOLT:DC 10\n"},
        .identity_query = "*IDN?\n",
        .query = "VAL1?\n",
        .closing = "SYST:LOC\n",
        .parse = parse_scpi_reading},
       {.name = "owon",
        .opening = {"*CLS\n", "CONF:VOLT:DC 5\n", "RATE F\n"},
        .identity_query = "*IDN?\n",
        .query = "MEAS1?\n",
        .closing = "SYST:LOC\n",
        .parse = parse_scpi_reading}}};
  return kRows;
}

constexpr std::size_t kSauterLength = 7;

}  // namespace

GaugeProtocol scpi_protocol(const std::string& dialect) {
  std::string known;
  for (const GaugeProtocol& row : dialects()) {
    if (row.name == dialect) return row;
    known += (known.empty() ? "" : ", ") + row.name;
  }
  throw RigError("dialect '" + dialect +
                 "' under [load_cell] of the rig file is unknown; known are " + known);
}

std::optional<GaugeAnswer> parse_scpi_reading(std::string_view line) {
  GaugeAnswer answer;
  for (const std::string_view part : split(line, ',')) {
    // A unit may follow: "1.779E+0 VDC".
    std::string_view digits = trimmed(part);
    digits = digits.substr(0, digits.find(' '));
    const auto value = number_from_text(digits);
    if (!value) return std::nullopt;
    answer.is_overload = std::abs(*value) >= kOverload;
    answer.volts = answer.is_overload ? std::nullopt : value;
  }
  return answer;
}

std::optional<ScpiError> parse_scpi_error(std::string_view line) {
  const std::size_t comma = line.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const auto code = integer_from_text(line.substr(0, comma));
  std::string_view text = trimmed(line.substr(comma + 1));
  if (!code || *code < -32768 || *code > 32767 || text.size() < 2 || text.front() != '"') {
    return std::nullopt;
  }
  text.remove_prefix(1);
  if (text.back() == '"') text.remove_suffix(1);
  return ScpiError{static_cast<int>(*code), std::string(text)};
}

std::optional<GaugeAnswer> parse_mark10_reading(std::string_view line, const std::string& unit) {
  const std::string_view text = trimmed(line);
  GaugeAnswer answer;
  if (!text.empty() && text.front() == '*') {
    answer.error = std::string(text);
    return answer;
  }
  const std::size_t end = text.find_last_of("0123456789.");
  if (end == std::string_view::npos) return std::nullopt;
  const auto value = number_from_text(text.substr(0, end + 1));
  answer.unit = std::string(trimmed(text.substr(end + 1)));
  const auto newtons = newtons_per_unit(answer.unit.empty() ? unit : answer.unit);
  if (!value || !newtons) return std::nullopt;
  answer.force_N = *value * *newtons;
  return answer;
}

GaugeProtocol mark10_protocol(const std::string& unit) {
  const std::string word = checked_gauge_unit(unit);
  GaugeProtocol protocol;
  protocol.name = "mark10";
  protocol.query = "?\r";
  protocol.zero = "Z\r";
  protocol.zero_refused = {"*"};
  protocol.parse = [word](std::string_view line) { return parse_mark10_reading(line, word); };
  return protocol;
}

int mark10_stream_rate_Hz(double expected_Hz) {
  constexpr std::array<int, 7> kRates_Hz{2, 5, 10, 25, 50, 125, 250};
  for (const int rate_Hz : kRates_Hz) {
    if (rate_Hz >= expected_Hz) return rate_Hz;
  }
  return kRates_Hz.back();
}

std::string mark10_stream_command(int rate_Hz) {
  return "AOUT" + std::to_string(rate_Hz) + "\r";
}

std::optional<GaugeAnswer> parse_sauter_reading(std::string_view bytes, const std::string& unit) {
  if (bytes.size() != kSauterLength || (bytes[0] != '0' && bytes[0] != '1')) return std::nullopt;
  const std::string_view digits = bytes.substr(1);
  if (digits.find_first_not_of("0123456789.") != std::string_view::npos) return std::nullopt;
  const auto value = number_from_text(digits);
  const auto newtons = newtons_per_unit(unit);
  if (!value || !newtons) return std::nullopt;
  GaugeAnswer answer;
  answer.force_N = (bytes[0] == '0' ? 1.0 : -1.0) * *value * *newtons;
  return answer;
}

GaugeProtocol sauter_protocol(const std::string& unit) {
  const std::string word = checked_gauge_unit(unit);
  GaugeProtocol protocol;
  protocol.name = "sauter";
  protocol.query = "9";
  protocol.fixed_length = kSauterLength;
  protocol.parse = [word](std::string_view bytes) { return parse_sauter_reading(bytes, word); };
  return protocol;
}

namespace {

// The words of a line, without blanks.
std::vector<std::string> words_of(std::string_view line) {
  std::vector<std::string> words;
  for (const std::string_view part : split(trimmed(line), ' ')) {
    if (!trimmed(part).empty()) words.emplace_back(trimmed(part));
  }
  return words;
}

std::string upper_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

bool is_one_of(const std::string& word, std::initializer_list<const char*> words) {
  return std::any_of(words.begin(), words.end(), [&](const char* one) { return word == one; });
}

GaugeAnswer refusal(std::string_view line) {
  GaugeAnswer answer;
  answer.error = std::string(trimmed(line));
  return answer;
}

// A weight of so many of a unit; nothing for another quantity, such as pieces.
std::optional<GaugeAnswer> weight(std::string_view digits, const std::string& unit) {
  const auto value = number_from_text(digits);
  const auto newtons = newtons_per_unit(unit);
  if (!value || !newtons) return std::nullopt;
  GaugeAnswer answer;
  answer.force_N = *value * *newtons;
  answer.unit = unit;
  return answer;
}

GaugeAnswer above_range() {
  GaugeAnswer answer;
  answer.is_overload = true;
  return answer;
}

GaugeProtocol balance(std::string name, const std::string& unit,
                      std::optional<GaugeAnswer> (*parse)(std::string_view, const std::string&)) {
  const std::string word = checked_gauge_unit(unit.empty() ? "g" : unit);
  GaugeProtocol protocol;
  protocol.name = std::move(name);
  protocol.parse = [word, parse](std::string_view line) { return parse(line, word); };
  return protocol;
}

}  // namespace

std::optional<GaugeAnswer> parse_mt_sics_reading(std::string_view line, const std::string& unit) {
  const std::vector<std::string> words = words_of(line);
  if (words.size() == 1 && is_one_of(words[0], {"ES", "ET", "EL"})) return refusal(line);
  if (words.size() < 2 || !is_one_of(words[0], {"S", "SI"})) return std::nullopt;
  if (words[1] == "+") return above_range();
  if (is_one_of(words[1], {"-", "I", "L"})) return refusal(line);
  if (words.size() < 3 || !is_one_of(words[1], {"S", "D"})) return std::nullopt;
  if (words[2] == "Error") return refusal(line);
  return weight(words[2], words.size() > 3 ? words[3] : unit);
}

GaugeProtocol mt_sics_protocol(const std::string& unit) {
  GaugeProtocol protocol = balance("mt-sics", unit, parse_mt_sics_reading);
  protocol.opening = {"@\r\n"};
  protocol.identity_query = "I4\r\n";
  protocol.query = "SI\r\n";
  protocol.zero = "ZI\r\n";
  protocol.zeroed = {"ZI D", "ZI S"};
  protocol.zero_refused = {"ZI", "ES", "ET", "EL"};
  return protocol;
}

std::optional<GaugeAnswer> parse_sartorius_reading(std::string_view line, const std::string& unit) {
  std::vector<std::string> words = words_of(line);
  // A label of up to four letters before the value: N, G, T, Stat.
  constexpr std::size_t kLongestLabel = 4;
  const auto is_label = [&](const std::string& word) {
    return word.size() <= kLongestLabel &&
           std::all_of(word.begin(), word.end(),
                       [](unsigned char c) { return std::isalpha(c) || c == '#'; });
  };
  if (!words.empty() && is_one_of(upper_case(words[0]), {"ERR", "APP.", "DIS.", "PRT."}))
    return refusal(line);
  if (words.size() > 1 && is_label(words[0])) words.erase(words.begin());
  if (words.empty()) return std::nullopt;
  const std::string first = upper_case(words[0]);
  if (is_one_of(first, {"H", "HH", "HIGH"})) return above_range();
  if (is_one_of(first, {"L", "LL", "LOW", "C", "CAL", "CAL.INT.", "--"})) return refusal(line);
  std::string digits = words[0];
  words.erase(words.begin());
  if ((digits == "+" || digits == "-") && !words.empty()) {
    digits += words[0];
    words.erase(words.begin());
  }
  std::erase_if(digits, [](char c) { return c == '[' || c == ']'; });
  if (digits.starts_with('+')) digits.erase(0, 1);
  if (words.size() > 1) return std::nullopt;
  return weight(digits, words.empty() ? unit : words[0]);
}

GaugeProtocol sartorius_protocol(const std::string& unit) {
  GaugeProtocol protocol = balance("sartorius", unit, parse_sartorius_reading);
  protocol.identity_query = "\x1bx1_\r\n";
  protocol.query = "\x1bP\r\n";
  protocol.zero = "\x1bV\r\n";
  protocol.zero_refused = {"ERR", "APP.", "DIS.", "PRT."};
  return protocol;
}

std::string checked_gauge_unit(const std::string& unit) {
  std::string word = unit.empty() ? "N" : unit;
  if (newtons_per_unit(word)) return word;
  throw RigError("unit '" + unit +
                 "' under [load_cell] of the rig file is unknown; choose N, mN, kN, mg, g, gf, "
                 "kgf, ozf or lbf");
}

std::optional<double> newtons_per_unit(std::string_view unit) {
  constexpr double kGravity = 9.80665;
  constexpr double kPound_kg = 0.45359237;
  static constexpr std::array<std::pair<const char*, double>, 14> kRows{
      {{"n", 1.0},
       {"mn", 1e-3},
       {"kn", 1e3},
       {"mg", 1e-6 * kGravity},
       {"g", 1e-3 * kGravity},
       {"gf", 1e-3 * kGravity},
       {"kg", kGravity},
       {"kgf", kGravity},
       {"oz", kPound_kg / 16.0 * kGravity},
       {"ozf", kPound_kg / 16.0 * kGravity},
       {"lb", kPound_kg * kGravity},
       {"lbs", kPound_kg * kGravity},
       {"lbf", kPound_kg * kGravity},
       {"p", 1e-3 * kGravity}}};  // pond, on older gauges
  std::string word(trimmed(unit));
  if (word == "MN") return std::nullopt;  // no gauge has meganewtons, and mN would be off by 1e9
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const auto& [name, newtons] : kRows) {
    if (word == name) return newtons;
  }
  return std::nullopt;
}

}  // namespace viscard
