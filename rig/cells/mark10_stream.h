#pragma once

#include "rig/cells/line_shape.h"
#include "rig/cells/stream_load_cell.h"

#include <string>

namespace viscard {

// A Mark-10 force gauge in its continuous mode: it sends so many readings a second by itself, which
// is faster than polling it. Source: Mark-10 Series 5, Series 7 and Model 7i user's guides, "Command
// Set / Gauge Control Language 2": AOUTn transmits n times a second (n = 1, 2, 5, 10, 25, 50, 125,
// 250; 1 means 50, for programs of older gauges; 0 stops), FULL and NUM send readings with and
// without unit, CUR shows the current reading instead of a peak, OPOL0 sends the sign. Series 3 and
// 4 answer "*10" (illegal command) and must be polled. For series BG and BGI, n has another meaning
// (every nth reading).
//
// The smallest rate of the gauge that is at least expected_rate is set. The destructor stops the
// transmission, so that a polling program finds the gauge as it was.
class Mark10Stream final : public StreamLoadCell {
 public:
  // Throws RigError on an unknown unit.
  Mark10Stream(Transport& transport, const LoadCellConfig& config, const RigClock& clock,
               RecordSink sink);
  ~Mark10Stream() override;

  void connect(const Pump& pump) override;
  void service() override;

 private:
  void ask(const std::string& command, bool is_required, const Pump& pump);
  void take_line(const ReceivedLine& line);
  void forget() override;

  std::string declared_unit_;
  int rate_Hz_;
  bool is_streaming_ = false;  // readings that arrive now belong to the run
  std::string refusal_;        // the newest error that the gauge has sent, such as "*10"
  LineShape shape_;
};

// Throws RigError if the unit under [load_cell] is unknown.
void check_mark10_words(const LoadCellConfig& config);

}  // namespace viscard
