#pragma once

#include "rig/cells/hx711_format.h"
#include "rig/cells/line_shape.h"
#include "rig/cells/stream_load_cell.h"

#include <optional>
#include <string>

namespace viscard {

// An HX711, or another converter behind a board that sends text lines. Their format is declared in
// the rig file (line_format) or learnt from the first readings; banners and messages before them
// are skipped. The format is reported by an event "line_format".
class Hx711LoadCell final : public StreamLoadCell {
 public:
  // patience: factor on the time that connect() waits for readings. Throws RigError on an unknown
  // line_format or unit.
  Hx711LoadCell(Transport& transport, const LoadCellConfig& config, const RigClock& clock,
                RecordSink sink, double patience = 1.0);

  void connect(const Pump& pump) override;
  void service() override;
  std::string reads_as() const override;
  std::string line_format() const override { return word_of(format_); }

  // Declared or learnt; kAuto before connect() has learnt it.
  Hx711Format format() const { return format_; }

 private:
  void take_line(const ReceivedLine& whole);
  void learn(const ReceivedLine& line);
  void take_reading(const Hx711Line& reading, const std::string& text, double time_s);
  void forget() override;
  LoadSample sample_of(const Hx711Line& reading);

  LoadCellConfig config_;
  double patience_;
  Hx711Format format_;
  std::string declared_unit_;  // of numbers without a unit; empty: they are counts or volts
  bool is_past_first_line_ = false;
  std::optional<LineColumns> columns_;  // of lines with several
  Hx711Learner learner_;
  std::optional<double> previous_counts_;
  LineShape shape_;
};

}  // namespace viscard
