#pragma once

#include "models/experiment/emulated_specimen.h"
#include "rig/emulator/emulated_cell.h"

#include <cstdint>
#include <string>

namespace viscard {

// The line that an amplifier sends for each reading.
enum class AmplifierFormat {
  kMicrosCounts,
  kMillisCounts,
  kCounts,
  kReadingText,
  kVolts,
  kMeanText,
  kFrames  // binary, as `frame` describes
};

struct AmplifierOptions {
  AmplifierFormat format = AmplifierFormat::kMicrosCounts;
  std::string line_end = "\r\n";
  std::string before, behind;         // of the text line: a name, other columns
  std::string frame;                  // of kFrames; that of the rig file
  double clock_ppm = 0.0;             // by this much its clock runs fast
  double boot_s = 0.0;                // from reset to the first conversion
  std::uint32_t micros_at_reset = 0;  // a large value makes the counter wrap soon
  int glitch_every = 0;               // every n-th reading is an interrupted conversion; 0: none
};

// An HX711, or another converter, behind a small processor: 24-bit counts of the cell's voltage, one
// line or frame per conversion.
// The noise depends only on the seed and the number of the reading.
class EmulatedAmplifier {
 public:
  EmulatedAmplifier(const EmulatedTruth& truth, const LoadCellCalibration& calibration,
                    double volts_per_count, const AmplifierOptions& options);

  // Restarts and returns the banner; conversions follow from time_s + boot_s on.
  std::string reset(double time_s);
  // Emulated time of the next conversion.
  double next_sample_s() const;
  // Converts the force that acts now and returns the line.
  std::string convert(double force_N, bool is_cell_broken);
  // From now on the cell or the amplifier is broken in that way.
  void set_fault(RigFaultKind kind);

 private:
  std::uint32_t micros_at(double time_s) const;
  std::string frame(double counts, double time_s) const;
  std::string line(double counts, double time_s) const;  // without its end

  void set_rate(double rate_Hz);

  double rate_Hz_;
  EmulatedCell cell_;
  double volts_per_count_;
  AmplifierOptions options_;
  double reset_s_ = 0.0;
  double paced_from_s_ = 0.0;     // time of the reading before the rate was set
  std::int64_t paced_from_ = 0;   // its number
  std::int64_t index_ = 0;        // readings since the last reset
  std::int64_t noise_index_ = 0;  // readings since the start
};

}  // namespace viscard
