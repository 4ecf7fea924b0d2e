#pragma once

#include "models/experiment/rig_config.h"
#include "rig/cells/device_clock.h"
#include "rig/cells/line_shape.h"
#include "rig/cells/load_cell.h"
#include "rig/lines/line_splitter.h"
#include "rig/lines/rig_clock.h"
#include "rig/protocols/hx711_protocol.h"

#include <optional>
#include <string>
#include <vector>

namespace viscard {

// An HX711 (or any other) amplifier that sends text lines. Their format is declared in the rig file
// (line_format) or learnt from the first readings; banners and messages before them are skipped.
class Hx711LoadCell final : public LoadCell {
 public:
  // patience: factor on the time that connect() waits for readings. Throws RigError on an unknown
  // line_format or unit.
  Hx711LoadCell(Transport& transport, const LoadCellConfig& config, const RigClock& clock,
                RecordSink sink, double patience = 1.0);

  Transport& transport() override { return transport_; }
  void connect(const Pump& pump) override;
  void service() override;
  const StreamCounts& counts() const override { return counts_; }
  std::string reads_as() const override;
  double period_s() const override { return period_s_; }
  double last_arrival_s() const override { return last_arrival_s_; }
  double made_at_s(const LoadSample& sample) const override;

  // Declared or learnt; kAuto before connect() has learnt it.
  Hx711Format format() const { return format_; }

 private:
  void take_line(const ReceivedLine& line);
  void learn(const ReceivedLine& line);
  void take_reading(const Hx711Line& reading, double time_s);
  void take_text(const ReceivedLine& line);
  void throw_if_restarted(double time_s) const;
  bool take_clock(double ticks, double time_s);
  void take_arrival(double time_s);
  void doubt_last(double time_s);
  void note_gap(double step_s, double time_s);
  void hand_out(const Hx711Line& reading, double time_s);
  bool has_clock() const {
    return format_ == Hx711Format::kMicrosCounts || format_ == Hx711Format::kMillisCounts;
  }

  Transport& transport_;
  const RigClock& clock_;
  RecordSink sink_;
  double patience_;
  LineSplitter splitter_;
  Hx711Format format_;
  double period_s_;
  std::string declared_unit_;  // of numbers without a unit; empty: they are counts or volts
  bool is_connected_ = false;
  bool is_past_first_line_ = false;
  std::vector<ReceivedLine> first_lines_;
  std::optional<DeviceClock> device_clock_;
  std::optional<double> previous_counts_;
  std::string unit_;
  LineShape shape_;
  std::string banner_;  // text that arrived since the last reading
  StreamCounts counts_;
  std::int64_t last_missing_ = 0;         // in the gap before the newest reading
  std::int64_t n_owed_ = 0, n_late_ = 0;  // of the newest gap: still missing, and arrived late
  double last_arrival_s_ = 0.0;
};

}  // namespace viscard
