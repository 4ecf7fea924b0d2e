#include "rig/cells/hx711_load_cell.h"
#include "rig/lines/rig_error.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

constexpr double kLargest_V = 100.0;

// Counts printed as floating-point numbers, such as a mean "20386.0": no amplifier of a load cell
// gives 100 V, and noise never makes whole volts.
bool are_counts(const std::vector<double>& values) {
  const auto is_large = [](double value) { return std::abs(value) > kLargest_V; };
  const auto is_whole = [](double value) { return value == std::floor(value); };
  const bool is_constant =
      std::adjacent_find(values.begin(), values.end(), std::not_equal_to<>()) == values.end();
  return std::any_of(values.begin(), values.end(), is_large) ||
         (!is_constant && std::all_of(values.begin(), values.end(), is_whole));
}

// The unit of the clock, from the mean step between the first numbers of the lines.
std::optional<Hx711Format> clock_format(const std::vector<double>& ticks, double rate_Hz) {
  const double step = (ticks.back() - ticks.front()) / static_cast<double>(ticks.size() - 1);
  const auto is_about = [&](double expected) {
    return step > 0.3 * expected && step < 3.0 * expected;
  };
  if (is_about(1e6 / rate_Hz)) return Hx711Format::kMicrosCounts;
  if (is_about(1e3 / rate_Hz)) return Hx711Format::kMillisCounts;
  return std::nullopt;
}

}  // namespace

Hx711Format declared_hx711_format(const LoadCellConfig& config) {
  const auto format = hx711_format_from_word(config.line_format);
  if (!format) {
    throw RigError("load cell line_format '" + config.line_format +
                   "' is unknown; choose auto, counts, micros,counts, millis,counts or volts");
  }
  return *format;
}

std::optional<Hx711Format> learnt_hx711_format(const std::vector<ReceivedLine>& lines,
                                               double rate_Hz) {
  std::vector<double> ticks;
  std::vector<double> values;
  bool is_integer = true;
  bool is_plain = true;
  for (const ReceivedLine& line : lines) {
    const auto timed = parse_hx711_line(line.text, true);
    if (timed) ticks.push_back(*timed->ticks);
    const auto plain = parse_hx711_line(line.text, false);
    is_plain = is_plain && plain.has_value();
    is_integer = is_integer && plain && plain->is_integer;
    if (plain && plain->value) values.push_back(*plain->value);
  }
  if (ticks.size() == lines.size()) {
    if (const auto format = clock_format(ticks, rate_Hz)) return format;
  }
  if (!is_plain) return std::nullopt;
  return is_integer || are_counts(values) ? Hx711Format::kCounts : Hx711Format::kVolts;
}

}  // namespace viscard
