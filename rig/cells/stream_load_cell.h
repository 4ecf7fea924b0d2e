#pragma once

#include "rig/cells/arrival_clock.h"
#include "rig/cells/device_clock.h"
#include "rig/cells/load_cell.h"

#include <cstdint>
#include <optional>
#include <string>

namespace viscard {

// The common part of all instruments that send readings by themselves: the times of the readings,
// with or without a clock of the device, and the missing readings between them. A driver parses
// what has arrived and calls accept() and hand_out_at() for each reading.
class StreamLoadCell : public LoadCell {
 public:
  bool sends_by_itself() const override { return true; }
  bool has_own_clock() const override { return device_clock_.has_value(); }
  double made_at_s(const LoadSample& sample) const override;

 protected:
  StreamLoadCell(Transport& transport, const LoadCellConfig& config, const RigClock& clock,
                 RecordSink sink);

  // Serves the devices until the driver has set is_connected_; returns false if that takes longer
  // than wall_s. Throws RigError if nothing comes, or (is_text) if it cannot be read as text.
  bool await_readings(const Pump& pump, double wall_s, bool is_text);
  // The device's clock starts with this reading, so that a restart right after it is noticed. After
  // a restart it continues the old one: the least delay stays the same.
  void start_clock(double tick_s, const std::optional<double>& ticks, double time_s);
  // A reading as it was sent.
  struct Sent {
    std::optional<double> ticks;  // the device's own time, if it sends one
    std::string unit;             // empty if it sends none
    std::string text;             // for the record of a reading that is left out
    // Number of readings lost before this one, if the readings carry numbers.
    std::optional<std::int64_t> n_lost = {};
  };
  // Judges unit and time of a reading; false if it must be left out.
  bool accept(const Sent& sent, double time_s);
  // Adds the times of the reading accepted last, then hands it out.
  void hand_out_at(LoadSample& sample, double time_s);
  // Text between readings is the banner of a restart if the readings pause, otherwise garbage.
  void take_text(const ReceivedLine& line);
  // Makes the instrument connect anew if nothing has been measured yet; otherwise throws
  // DeviceRestarted. sign: how the restart was noticed.
  void begin_again(const std::string& sign, double time_s);
  // What a driver has learnt since connect(); called by begin_again().
  virtual void forget() = 0;

 private:
  bool has_restarted(double time_s) const;
  bool take_clock(double ticks, double time_s);
  void take_arrival(double time_s);
  void take_loss(std::int64_t n_lost, double time_s);
  void doubt_last(double time_s);
  void take_step(double step_s, double time_s);

  double expected_period_s_;
  std::optional<DeviceClock> device_clock_;
  ArrivalClock arrival_clock_;            // if there is no device clock
  std::int64_t n_periods_ = 0;            // that arrival_clock_ has counted
  std::string banner_;                    // text that arrived since the last reading
  std::int64_t last_missing_ = 0;         // in the gap before the newest reading
  std::int64_t n_owed_ = 0, n_late_ = 0;  // of the newest gap: still missing, and arrived late
};

}  // namespace viscard
