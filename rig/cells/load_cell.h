#pragma once

#include "models/experiment/run_record.h"
#include "rig/lines/record_sink.h"
#include "rig/lines/transport.h"

#include <cstdint>
#include <functional>
#include <string>

namespace viscard {

// Counts of a stream of readings. Times are rig time or the device's own.
struct StreamCounts {
  std::int64_t received = 0;
  std::int64_t missing = 0;    // from gaps of the device's clock (of the host's, if it has none)
  std::int64_t duplicate = 0;  // the same device time again: left out
  std::int64_t glitch = 0;
  std::int64_t saturated = 0;
  std::int64_t unreadable = 0;   // lines that could not be read
  std::int64_t implausible = 0;  // handed out, later marked by an event "implausible"
  double longest_gap_s = 0.0;
  double longest_gap_at_s = 0.0;  // host time at its end

  std::int64_t expected() const { return received + missing; }
};

// A load cell behind an amplifier that sends readings by itself, or an instrument that is polled.
// All calls throw PortHungUp, DeviceRestarted or RigError.
class LoadCell {
 public:
  virtual ~LoadCell() = default;
  LoadCell() = default;
  LoadCell(const LoadCell&) = delete;
  LoadCell& operator=(const LoadCell&) = delete;

  virtual Transport& transport() = 0;
  // Waits until readings arrive and the format of the lines is known.
  virtual void connect(const Pump& pump) = 0;
  // Reads what has arrived and passes each reading to the sink, then to the listener. Call often.
  virtual void service() = 0;
  void set_listener(std::function<void(const LoadSample&)> listener) {
    listener_ = std::move(listener);
  }

  virtual const StreamCounts& counts() const = 0;
  // The assumed unit of its numbers, "counts", "volts", "N", "g" ...; empty if the instrument's
  // protocol fixes it.
  virtual std::string reads_as() const { return {}; }
  // Measured time between readings, rig seconds.
  virtual double period_s() const = 0;
  // Rig time at which the newest reading arrived.
  virtual double last_arrival_s() const = 0;
  // Best estimate of the rig time at which a reading was made: the time of its arrival, or its
  // device time plus the smallest offset seen lately (a delay is never negative).
  virtual double made_at_s(const LoadSample& sample) const = 0;

 protected:
  std::function<void(const LoadSample&)> listener_;
};

}  // namespace viscard
