#pragma once

#include "models/experiment/emulated_specimen.h"
#include "rig/emulator/delayed_bytes.h"
#include "rig/emulator/emulated_cell.h"

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>

namespace viscard {

// Behaviour of real instruments that a driver must cope with. Times on the emulated clock.
struct GaugeHabits {
  int lose_answer_every = 0;  // every n-th question gets no answer
  int late_answer_every = 0;  // every n-th answer is late by late_s
  double late_s = 0.0;
  bool echoes = false;         // sends every byte back
  bool hides_unit = false;     // Mark-10: unit switched off in its menu
  std::string unit = "N";      // Mark-10, Sauter
  int changes_unit_after = 0;  // Mark-10: its unit changes after so many readings; 0: never
  // Mark-10 in continuous mode.
  bool has_no_stream = false;      // series 3 and 4: AOUT is an illegal command
  bool is_left_streaming = false;  // a program before has started it
  bool shows_peak = false;         // its display shows the peak until CUR is sent
  double stops_after_s = 0.0;      // falls silent so long after it has begun, as when switched off
  bool has_no_zero = false;        // series 3 and 4: Z is an illegal command
  bool refuses_setup = false;      // SCPI: there is an error in its queue after the setup
};

// A multimeter behind the amplifier, or a force gauge, that answers queries
// (rig/protocols/gauge_protocols.h), where one reading takes 1/sample_rate of the truth; or that sends
// readings by itself after a command.
class EmulatedGauge {
 public:
  // driver: of [load_cell] in the rig file.
  EmulatedGauge(const EmulatedTruth& truth, const LoadCellCalibration& calibration,
                const std::string& driver, const GaugeHabits& habits);

  void receive(std::string_view bytes, double time_s);
  // Time at which the next reading is made; infinity without an open query or a stream.
  double next_sample_s() const;
  // Makes the next reading with the force that acts then.
  void convert(double force_N, bool is_cell_broken);
  // From now on the cell or the instrument is broken in that way.
  void set_fault(RigFaultKind kind);
  std::string take_output(double time_s) { return answers_.take_due(time_s); }

 private:
  // A reading as the instrument shows it.
  struct Shown {
    double volts = 0.0;
    double force = 0.0;  // in its unit
    std::string unit;    // empty if it is not sent
    bool is_overload = false;
  };
  struct Instrument;
  static const Instrument& instrument_of(const std::string& driver);
  static std::string mark10_text(const Shown& shown);
  void take_command(const std::string& command, double time_s);
  bool take_stream_command(const std::string& command, double time_s);
  void begin_stream(double rate_Hz, double time_s);
  double next_of_stream_s() const;
  std::string text_of(double shown, bool is_overload) const;

  double rate_Hz_;
  EmulatedCell cell_;
  const Instrument& instrument_;
  GaugeHabits habits_;
  std::string begun_;
  std::deque<double> due_s_;
  double stream_Hz_ = 0.0;  // 0: it sends nothing by itself
  double stream_begun_s_ = 0.0;
  std::int64_t n_streamed_ = 0;
  double peak_ = 0.0;
  bool is_zeroing_ = false;
  double zero_ = 0.0;  // of its readings
  DelayedBytes answers_;
  std::int64_t n_readings_ = 0;
};

}  // namespace viscard
