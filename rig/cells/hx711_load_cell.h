#pragma once

#include "rig/cells/arrival_clock.h"
#include "rig/cells/device_clock.h"
#include "rig/cells/hx711_format.h"
#include "rig/cells/line_shape.h"
#include "rig/cells/load_cell.h"

#include <optional>
#include <string>

namespace viscard {

// An HX711 (or any other) amplifier that sends text lines. Their format is declared in the rig file
// (line_format) or learnt from the first readings; banners and messages before them are skipped.
// The format is reported by an event "line_format".
class Hx711LoadCell final : public LoadCell {
 public:
  // patience: factor on the time that connect() waits for readings. Throws RigError on an unknown
  // line_format or unit.
  Hx711LoadCell(Transport& transport, const LoadCellConfig& config, const RigClock& clock,
                RecordSink sink, double patience = 1.0);

  void connect(const Pump& pump) override;
  void service() override;
  std::string reads_as() const override;
  std::string line_format() const override { return word_of(format_); }
  double made_at_s(const LoadSample& sample) const override;

  // Declared or learnt; kAuto before connect() has learnt it.
  Hx711Format format() const { return format_; }

 private:
  void take_line(const ReceivedLine& line);
  void learn(const ReceivedLine& line);
  void take_reading(const Hx711Line& reading, const std::string& text, double time_s);
  void take_text(const ReceivedLine& line);
  bool has_restarted(double time_s) const;
  void begin_again(const std::string& sign, double time_s);
  void start_clock(const ReceivedLine& line);
  bool take_clock(double ticks, double time_s);
  void take_arrival(double time_s);
  void doubt_last(double time_s);
  void take_step(double step_s, double time_s);
  LoadSample sample_of(const Hx711Line& reading, double time_s);

  LoadCellConfig config_;
  double patience_;
  Hx711Format format_;
  std::string declared_unit_;  // of numbers without a unit; empty: they are counts or volts
  bool is_past_first_line_ = false;
  Hx711Learner learner_;
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
