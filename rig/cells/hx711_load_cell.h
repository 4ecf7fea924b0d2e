#pragma once

#include "rig/cells/arrival_clock.h"
#include "rig/cells/device_clock.h"
#include "rig/cells/line_shape.h"
#include "rig/cells/load_cell.h"
#include "rig/protocols/hx711_protocol.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// The line_format of a rig file. Throws RigError on an unknown word.
Hx711Format declared_hx711_format(const LoadCellConfig& config);

// The format that all of these lines have, or nothing if they have none in common. rate_Hz:
// expected rate of the readings, which shows the unit of a clock at the beginning of the line.
std::optional<Hx711Format> learnt_hx711_format(const std::vector<ReceivedLine>& lines,
                                               double rate_Hz);

// An HX711 (or any other) amplifier that sends text lines. Their format is declared in the rig file
// (line_format) or learnt from the first readings; banners and messages before them are skipped.
class Hx711LoadCell final : public LoadCell {
 public:
  // patience: factor on the time that connect() waits for readings. Throws RigError on an unknown
  // line_format or unit.
  Hx711LoadCell(Transport& transport, const LoadCellConfig& config, const RigClock& clock,
                RecordSink sink, double patience = 1.0);

  void connect(const Pump& pump) override;
  void service() override;
  std::string reads_as() const override;
  double made_at_s(const LoadSample& sample) const override;

  // Declared or learnt; kAuto before connect() has learnt it.
  Hx711Format format() const { return format_; }

 private:
  void take_line(const ReceivedLine& line);
  void learn(const ReceivedLine& line);
  void take_reading(const Hx711Line& reading, const std::string& text, double time_s);
  void take_text(const ReceivedLine& line);
  void throw_if_restarted(double time_s) const;
  bool take_clock(double ticks, double time_s);
  void take_arrival(double time_s);
  void doubt_last(double time_s);
  void take_step(double step_s, double time_s);
  LoadSample sample_of(const Hx711Line& reading, double time_s);
  bool has_clock() const {
    return format_ == Hx711Format::kMicrosCounts || format_ == Hx711Format::kMillisCounts;
  }

  double patience_;
  Hx711Format format_;
  std::string declared_unit_;  // of numbers without a unit; empty: they are counts or volts
  bool is_past_first_line_ = false;
  std::vector<ReceivedLine> first_lines_;
  std::optional<DeviceClock> device_clock_;
  ArrivalClock arrival_clock_;  // if there is no device clock
  std::int64_t n_periods_ = 0;  // that arrival_clock_ has counted
  std::optional<double> previous_counts_;
  LineShape shape_;
  std::string banner_;                    // text that arrived since the last reading
  std::int64_t last_missing_ = 0;         // in the gap before the newest reading
  std::int64_t n_owed_ = 0, n_late_ = 0;  // of the newest gap: still missing, and arrived late
};

}  // namespace viscard
