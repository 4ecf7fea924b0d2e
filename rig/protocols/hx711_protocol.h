#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace viscard {

// Reads text lines of an HX711 amplifier, or another 24-bit converter, behind a small processor;
// knows no port. Sources: HX711 data sheet (Avia Semiconductor); bogde/HX711 examples and issues 83,
// 216, 242; OpenScale guide (SparkFun); examples of SparkFun_Qwiic_Scale_NAU7802 ("Reading: 12345"),
// Adafruit_NAU7802 ("Read 12345"), of an ADS1232 library in the words of bogde/HX711, and of
// adienakhmad/ADS1256 (volts with ten decimals).

// 24-bit two's complement; the ends of the range mean that the converter is saturated.
inline constexpr double kHx711Highest = 8388607.0;
inline constexpr double kHx711Lowest = -8388608.0;

enum class Hx711Format { kAuto, kCounts, kMicrosCounts, kMillisCounts, kVolts };

// "auto", "counts", "micros,counts", "millis,counts" or "volts"; nothing for another word.
std::optional<Hx711Format> hx711_format_from_word(std::string_view word);
// The word of a rig file for a format.
const char* word_of(Hx711Format format);
// True if its lines begin with the processor's clock.
inline bool has_clock(Hx711Format format) {
  return format == Hx711Format::kMicrosCounts || format == Hx711Format::kMillisCounts;
}

struct Hx711Line {
  std::optional<double> ticks;  // the processor's clock in its own unit, if the line has one
  std::optional<double> value;  // nothing for "nan", "inf" and "ovf"
  bool is_integer = false;      // the value was written without a decimal point
  std::string unit;             // "g", "kg", "lbs", "N", or empty
};

// A line with a reading, or nothing for banners, prompts and garbage. With has_clock the line is
// "time,number" or "time,number,unit,...". Otherwise it is a number, "name: number" or "name:
// number | average: number" (the first one is taken) or "Read number", and a decimal comma is accepted.
std::optional<Hx711Line> parse_hx711_line(std::string_view line, bool has_clock);

// True for "HX711 not found.", "Scale not detected." (SparkFun, NAU7802), "Failed to find NAU7802"
// (Adafruit) and the like.
bool is_hx711_fault(std::string_view line);

// True for codes of a conversion that was read too slowly: its low bits are 1, so the code is
// 2^n - 1 or -1. A true reading can have such a code too, so it counts only if it jumps from the
// previous reading.
bool is_hx711_glitch(double counts, std::optional<double> previous_counts);

inline bool is_hx711_saturated(double counts) {
  return counts >= kHx711Highest || counts <= kHx711Lowest;
}

}  // namespace viscard
