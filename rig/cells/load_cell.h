#pragma once

#include "models/experiment/run_record.h"
#include "rig/lines/record_sink.h"
#include "rig/lines/transport.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace viscard {

// What has become of a stream of readings. Times are rig time or the device's own.
struct StreamCounts {
  std::int64_t received = 0;
  std::int64_t missing = 0;    // by gaps of the device's clock (or of the host's, if it has none)
  std::int64_t duplicate = 0;  // the same device time twice: not handed out
  std::int64_t glitch = 0;
  std::int64_t saturated = 0;
  std::int64_t unreadable = 0;   // lines that are no reading
  std::int64_t implausible = 0;  // handed out, and marked by an event "implausible" afterwards
  double longest_gap_s = 0.0;
  double longest_gap_at_s = 0.0;  // host time at its end

  std::int64_t expected() const { return received + missing; }
};

// A load cell behind an amplifier that sends readings of its own accord.
// All calls throw PortHungUp, DeviceRestarted or RigError.
class LoadCell {
 public:
  virtual ~LoadCell() = default;
  LoadCell() = default;
  LoadCell(const LoadCell&) = delete;
  LoadCell& operator=(const LoadCell&) = delete;

  virtual Transport& transport() = 0;
  // Waits until readings come and what its lines look like is known.
  virtual void connect(const Pump& pump) = 0;
  // Reads what has arrived and hands each reading to the sink and then to the listener.
  virtual void service() = 0;
  void set_listener(std::function<void(const LoadSample&)> listener) {
    listener_ = std::move(listener);
  }

  virtual const StreamCounts& counts() const = 0;
  // What its numbers are taken for: "counts", "volts", "N", "g" ...; empty where the instrument
  // leaves no doubt.
  virtual std::string reads_as() const { return {}; }
  // Time between readings as measured, s.
  virtual double period_s() const = 0;
  // Host time of the newest reading's arrival.
  virtual double last_arrival_s() const = 0;
  // Best estimate of the host time at which a reading was made: its arrival, or its device time on
  // the host's clock by the smallest delay seen lately (a delay is never negative).
  virtual double made_at_s(const LoadSample& sample) const = 0;

 protected:
  std::function<void(const LoadSample&)> listener_;
};

}  // namespace viscard
