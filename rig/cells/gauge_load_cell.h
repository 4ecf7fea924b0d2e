#pragma once

#include "models/experiment/rig_config.h"
#include "rig/cells/load_cell.h"
#include "rig/lines/line_splitter.h"
#include "rig/lines/rig_clock.h"
#include "rig/protocols/gauge_protocols.h"

#include <optional>
#include <string>

namespace viscard {

// An instrument that is polled for each reading: a multimeter behind the amplifier, or a force
// gauge. Only one query is open at a time. If no answer arrives, the next query waits until the
// line has been quiet for a while, so that a late answer cannot be taken for the answer to it.
//
// A sample's device_time_s is the rig time of its query; the reading was made between that and its
// arrival.
class GaugeLoadCell final : public LoadCell {
 public:
  GaugeLoadCell(Transport& transport, const LoadCellConfig& config, const RigClock& clock,
                RecordSink sink);
  ~GaugeLoadCell() override;  // returns the instrument to control by its front panel

  Transport& transport() override { return transport_; }
  void connect(const Pump& pump) override;
  void service() override;
  const StreamCounts& counts() const override { return counts_; }
  double period_s() const override { return period_s_; }
  double last_arrival_s() const override { return last_arrival_s_; }
  double made_at_s(const LoadSample& sample) const override;

 private:
  void send(const std::string& words);
  void feed(const Chunk& chunk);
  void take_answer(const std::string& text, double time_s);
  void hand_out(const GaugeAnswer& answer, double time_s);
  void note_unreadable(const std::string& text, double time_s);
  void ask_if_due();
  std::optional<std::string> ask_text(const std::string& query, const Pump& pump);
  void wait_quiet(const Pump& pump, double wall_s);

  Transport& transport_;
  GaugeProtocol protocol_;
  const RigClock& clock_;
  RecordSink sink_;
  LineSplitter splitter_;
  std::string begun_;  // the first bytes of an answer without terminator
  double period_s_;

  bool is_connected_ = false;  // from here on readings are polled
  std::optional<std::string> text_answer_;
  bool awaits_text_ = false;
  std::optional<double> asked_s_;
  double quiet_since_s_ = 0.0;
  bool waits_for_quiet_ = false;
  int n_silent_ = 0;
  int n_refused_ = 0;
  std::optional<std::string> unit_;
  std::string identity_;
  double shortest_turn_s_ = 1e9;
  StreamCounts counts_;
  double last_arrival_s_ = 0.0;
};

}  // namespace viscard
