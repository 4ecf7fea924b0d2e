#include "rig/emulator/emulated_amplifier.h"

#include "rig/hx711_protocol.h"
#include "rig/text_number.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

// A number of 64 well-mixed bits from any other (Steele, Lea & Flood, OOPSLA 2014: SplitMix64).
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

// One normal deviate per (seed, index), by Box and Muller, so that no scheduling can change it.
double normal_deviate(std::uint64_t seed, std::uint64_t index) {
  const std::uint64_t key = mixed(seed) ^ (2 * index);
  constexpr double kScale = 1.0 / 9007199254740992.0;  // 2^-53
  const double u = (static_cast<double>(mixed(key) >> 11) + 0.5) * kScale;
  const double v = static_cast<double>(mixed(key + 1) >> 11) * kScale;
  return std::sqrt(-2.0 * std::log(u)) * std::cos(6.283185307179586 * v);
}

}  // namespace

EmulatedAmplifier::EmulatedAmplifier(const EmulatedTruth& truth,
                                     const LoadCellCalibration& calibration, double volts_per_count,
                                     const AmplifierOptions& options)
    : truth_(truth),
      calibration_(calibration),
      volts_per_count_(volts_per_count),
      options_(options) {}

std::string EmulatedAmplifier::reset(double time_s) {
  reset_s_ = time_s;
  index_ = 0;
  return "HX711 ready" + options_.line_end;
}

double EmulatedAmplifier::next_sample_s() const {
  return reset_s_ + options_.boot_s + static_cast<double>(index_ + 1) / truth_.sample_rate_Hz;
}

double EmulatedAmplifier::reading_N(double force_N, double time_s) const {
  const double drifted_N = force_N * (1.0 + truth_.drift_relative_per_s * time_s);
  return drifted_N + truth_.force_offset_N +
         truth_.force_noise_N *
             normal_deviate(truth_.seed, static_cast<std::uint64_t>(noise_index_));
}

std::string EmulatedAmplifier::convert(double force_N, bool is_cell_broken) {
  const double time_s = next_sample_s();
  const double volts = volts_from_force_N(calibration_, reading_N(force_N, time_s));
  double counts = std::round(volts / volts_per_count_);
  counts = std::clamp(counts, kHx711Lowest, kHx711Highest);
  if (is_cell_broken) counts = kHx711Highest;
  ++index_;
  ++noise_index_;
  const bool is_glitch = options_.glitch_every > 0 && index_ % options_.glitch_every == 0;
  return line(is_glitch ? 1048575.0 : counts, time_s);
}

std::string EmulatedAmplifier::line(double counts, double time_s) const {
  const double since_s = (time_s - reset_s_) * (1.0 + 1e-6 * options_.clock_ppm);
  const auto micros = static_cast<std::uint32_t>(options_.micros_at_reset +
                                                 static_cast<std::uint64_t>(since_s * 1e6 + 0.5));
  const std::string number = text_from_number(counts, 0);
  switch (options_.format) {
    case AmplifierFormat::kMicrosCounts:
      return std::to_string(micros) + "," + number + options_.line_end;
    case AmplifierFormat::kMillisCounts:
      return std::to_string(micros / 1000) + "," + number + options_.line_end;
    case AmplifierFormat::kReadingText:
      return "HX711 reading: " + number + options_.line_end;
    case AmplifierFormat::kVolts:
      return text_from_number(counts * volts_per_count_, 7) + options_.line_end;
    case AmplifierFormat::kCounts:
      break;
  }
  return number + options_.line_end;
}

}  // namespace viscard
