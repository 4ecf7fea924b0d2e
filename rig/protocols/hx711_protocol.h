#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace viscard {

// Text lines of an HX711 amplifier behind a small processor, apart from any port. Sources: HX711
// data sheet (Avia Semiconductor); bogde/HX711 examples and issues 83, 216, 242; OpenScale guide
// (SparkFun).

// 24-bit two's complement: the ends of the range mean "saturated".
inline constexpr double kHx711Highest = 8388607.0;
inline constexpr double kHx711Lowest = -8388608.0;

enum class Hx711Format { kAuto, kCounts, kMicrosCounts, kMillisCounts, kVolts };

// "auto", "counts", "micros,counts", "millis,counts", "volts"; nothing for another word.
std::optional<Hx711Format> hx711_format_from_word(std::string_view word);

struct Hx711Line {
  std::optional<double> ticks;  // the processor's clock, in its own unit, if the line has one
  std::optional<double> value;  // none for "nan", "inf", "ovf": a reading that says it is none
  bool is_integer = false;      // value written without decimal point
  std::string unit;             // "g", "kg", "lbs", "N", or empty
};

// A line with a reading; nothing for banners, prompts and garbage. Accepts a plain number, "name:
// number", "name: number | average: number" (the first counts), "time,number",
// "time,number,unit,..." and a decimal comma where the format has no comma of its own (has_clock
// false).
std::optional<Hx711Line> parse_hx711_line(std::string_view line, bool has_clock);

// True for "HX711 not found." and the like.
bool is_hx711_fault(std::string_view line);

// Codes that a conversion read too slowly makes: the low bits read 1, so 2^n - 1 or -1. Such a
// number can also be a true reading, so it only counts when it jumps from the reading before.
bool is_hx711_glitch(double counts, std::optional<double> previous_counts);

inline bool is_hx711_saturated(double counts) {
  return counts >= kHx711Highest || counts <= kHx711Lowest;
}

}  // namespace viscard
