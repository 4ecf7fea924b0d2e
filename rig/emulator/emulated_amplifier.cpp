#include "rig/emulator/emulated_amplifier.h"

#include "models/maths/text_of_number.h"
#include "rig/protocols/binary_frame.h"
#include "rig/protocols/hx711_protocol.h"

#include <algorithm>
#include <cmath>

namespace viscard {

EmulatedAmplifier::EmulatedAmplifier(const EmulatedTruth& truth,
                                     const LoadCellCalibration& calibration, double volts_per_count,
                                     const AmplifierOptions& options)
    : rate_Hz_(truth.sample_rate_Hz),
      cell_(truth, calibration),
      volts_per_count_(volts_per_count),
      options_(options) {}

std::string EmulatedAmplifier::reset(double time_s) {
  reset_s_ = time_s;
  index_ = 0;
  paced_from_s_ = reset_s_ + options_.boot_s;
  paced_from_ = 0;
  return "HX711 ready" + options_.line_end;
}

double EmulatedAmplifier::next_sample_s() const {
  return paced_from_s_ + static_cast<double>(index_ - paced_from_ + 1) / rate_Hz_;
}

void EmulatedAmplifier::set_rate(double rate_Hz) {
  paced_from_s_ = next_sample_s() - 1.0 / rate_Hz_;
  paced_from_ = index_;
  rate_Hz_ = rate_Hz;
}

void EmulatedAmplifier::set_fault(RigFaultKind kind) {
  cell_.set_fault(kind);
  if (kind == RigFaultKind::kFastReadings) set_rate(3.0 * rate_Hz_);
  if (kind == RigFaultKind::kSlowReadings) set_rate(10.0);
}

std::string EmulatedAmplifier::convert(double force_N, bool is_cell_broken) {
  const double time_s = next_sample_s();
  const double volts = cell_.signal(force_N, time_s, noise_index_++);
  double counts = std::round(volts / volts_per_count_);
  counts = std::clamp(counts, kHx711Lowest, kHx711Highest);
  if (is_cell_broken || cell_.is_off_scale()) counts = kHx711Highest;
  ++index_;
  const bool is_glitch = options_.glitch_every > 0 && index_ % options_.glitch_every == 0;
  if (options_.format == AmplifierFormat::kFrames) return frame(counts, time_s);
  return options_.before + line(is_glitch ? 1048575.0 : counts, time_s) + options_.behind +
         options_.line_end;
}

std::string EmulatedAmplifier::frame(double counts, double time_s) const {
  const FrameFormat format(options_.frame);
  FrameFormat::Frame sent{.counts = counts, .seq = static_cast<std::uint32_t>(index_)};
  if (format.tick_s() > 0.0) sent.ticks = std::floor(1e-6 * micros_at(time_s) / format.tick_s());
  return format.bytes_of(sent);
}

std::uint32_t EmulatedAmplifier::micros_at(double time_s) const {
  const double since_s = (time_s - reset_s_) * (1.0 + 1e-6 * options_.clock_ppm);
  return static_cast<std::uint32_t>(options_.micros_at_reset +
                                    static_cast<std::uint64_t>(std::llround(since_s * 1e6)));
}

std::string EmulatedAmplifier::line(double counts, double time_s) const {
  const std::uint32_t micros = micros_at(time_s);
  std::string number = text_from_number(counts, 0);
  switch (options_.format) {
    case AmplifierFormat::kMicrosCounts:
      return std::to_string(micros) + "," + number;
    case AmplifierFormat::kMillisCounts:
      return std::to_string(micros / 1000) + "," + number;
    case AmplifierFormat::kReadingText:
      return "HX711 reading: " + number;
    case AmplifierFormat::kVolts:
      return text_from_number(counts * volts_per_count_, 7);
    case AmplifierFormat::kMeanText:
      return "one reading:\t" + number + ".0\t| average:\t" + number + ".0";
    case AmplifierFormat::kCounts:
    case AmplifierFormat::kFrames:
      break;
  }
  return number;
}

}  // namespace viscard
