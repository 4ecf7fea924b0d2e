#include "rig/protocols/force_gauge_protocols.h"

#include "models/maths/text_of_number.h"
#include "rig/lines/rig_error.h"
#include "rig/protocols/force_unit.h"

namespace viscard {
namespace {

constexpr std::size_t kSauterLength = 7;

// The unit of a gauge that does not send one; N unless the rig file has another.
std::string checked_unit(const std::string& unit) {
  const std::string word = unit.empty() ? "N" : unit;
  if (newtons_per_unit(word)) return word;
  throw RigError(
      "unit '" + unit +
      "' under [load_cell] of the rig file is unknown; choose N, mN, kN, gf, kgf, ozf or lbf");
}

}  // namespace

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
  const std::string word = checked_unit(unit);
  GaugeProtocol protocol;
  protocol.name = "mark10";
  protocol.query = "?\r";
  protocol.parse = [word](std::string_view line) { return parse_mark10_reading(line, word); };
  return protocol;
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
  const std::string word = checked_unit(unit);
  GaugeProtocol protocol;
  protocol.name = "sauter";
  protocol.query = "9";
  protocol.fixed_length = kSauterLength;
  protocol.parse = [word](std::string_view bytes) { return parse_sauter_reading(bytes, word); };
  return protocol;
}

}  // namespace viscard
