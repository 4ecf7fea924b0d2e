#pragma once

#include "rig/cells/load_cell.h"
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

  void connect(const Pump& pump) override;
  void service() override;
  bool has_own_zero() const override { return !protocol_.zero.empty(); }
  void set_zero(const Pump& pump) override;
  double made_at_s(const LoadSample& sample) const override;

 private:
  void feed(const Chunk& chunk);
  bool may_answer_zero(const std::string& text) const;
  void take_answer(const std::string& text, double time_s);
  void take_reading(const GaugeAnswer& answer, double time_s);
  void ask_if_due(double now_s);
  std::optional<std::string> ask_text(const std::string& query, const Pump& pump);

  GaugeProtocol protocol_;
  std::string begun_;  // the first bytes of an answer without terminator
  std::optional<std::string> text_answer_;
  bool awaits_text_ = false;
  bool is_zeroing_ = false;  // the text is the answer to the command for zero
  std::optional<double> asked_s_;
  double quiet_since_s_ = 0.0;
  bool waits_for_quiet_ = false;
  int n_silent_ = 0;
  int n_refused_ = 0;
  std::string identity_;
  double shortest_turn_s_ = 1e9;
};

// Throws RigError if the driver, dialect or unit of a polled instrument is unknown.
void check_gauge_words(const LoadCellConfig& config);

}  // namespace viscard
