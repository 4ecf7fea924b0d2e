#pragma once

#include "models/experiment/rig_config.h"
#include "rig/lines/line_splitter.h"
#include "rig/lines/record_sink.h"
#include "rig/lines/rig_clock.h"
#include "rig/lines/transport.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

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
  LoadCell& operator=(LoadCell&&) = delete;  // neither copied nor moved

  Transport& transport() { return transport_; }
  // Waits until readings arrive and the format of the lines is known.
  virtual void connect(const Pump& pump) = 0;
  // True if the instrument can be asked to make the force that acts its zero.
  virtual bool has_own_zero() const { return false; }
  // Asks it: its readings count from there, also after this program. Throws RigError if it refuses.
  virtual void set_zero(const Pump& /*pump*/) {}
  // True for an instrument that sends by itself: its readings can fall behind on a slow line.
  virtual bool sends_by_itself() const { return false; }
  // While restarts are accepted, the driver learns a restarted device again instead of throwing
  // DeviceRestarted; connect() waits until that is done. Boards reset when their port is opened,
  // and may do so late.
  void accept_restarts(bool is_accepted) { accepts_restarts_ = is_accepted; }
  std::int64_t n_restarts() const { return n_restarts_; }
  // Reads what has arrived and passes each reading to the sink, then to the listener. Call often.
  virtual void service() = 0;
  // The function that is called with each reading.
  void set_listener(std::function<void(const LoadSample&)> listener) {
    listener_ = std::move(listener);
  }

  // A thermometer on the same port: the function returns true for a line of the thermometer, which
  // then is not a line of the load cell. Only instruments that send lines by themselves call it.
  void set_other_lines(std::function<bool(const ReceivedLine&)> take) {
    takes_other_ = std::move(take);
  }

  const StreamCounts& counts() const { return counts_; }
  // The assumed unit of its numbers, "counts", "volts", "N", "g" ...; empty if the instrument's
  // protocol fixes it.
  virtual std::string reads_as() const { return {}; }
  // The format of its lines as a rig file names it; empty if the instrument's protocol fixes it.
  virtual std::string line_format() const { return {}; }
  // True if the readings carry the time of the device's own clock.
  virtual bool has_own_clock() const { return false; }
  // True if each reading carries a checksum.
  virtual bool has_check() const { return false; }
  // Measured time between readings, rig seconds.
  double period_s() const { return period_s_; }
  // Rig time at which the newest reading arrived.
  double last_arrival_s() const { return last_arrival_s_; }
  // Rig time at which bytes were last looked for. Everything sent before a pause of this program has
  // been read by then, so the age of the newest reading counts up to this time.
  double listened_at_s() const { return listened_at_s_; }
  // Of everything received.
  virtual std::size_t n_bytes() const { return splitter_.n_bytes(); }
  // Best estimate of the rig time at which a reading was made: its device time plus the smallest
  // recent offset (a delay is never negative). Without a device clock: the time of its arrival,
  // less the delay of the stream.
  virtual double made_at_s(const LoadSample& sample) const = 0;

 protected:
  LoadCell(Transport& transport, const LoadCellConfig& config, const RigClock& clock,
           RecordSink sink);

  // True for a line that the function for other lines takes.
  bool is_other_line(const ReceivedLine& line) const { return takes_other_ && takes_other_(line); }
  // Writes words to the instrument and records them.
  void send(const std::string& words);
  // Serves the devices for that wall time.
  void wait(const Pump& pump, double wall_s) const;
  // For a line that is no reading.
  void note_unreadable(const std::string& text, double time_s);
  // True if the unit is that of the readings before. A reading with another unit is left out, because
  // its unit may be garbled; throws RigError at the third one in a row with the same other unit.
  bool has_known_unit(const std::string& unit, const std::string& text, double time_s);
  // Keeps the longest gap. A step above least_s between readings is reported as missing readings;
  // returns their number.
  std::int64_t note_gap(double step_s, double least_s, double time_s);
  // What has arrived since the last call, recorded as raw bytes.
  Chunk receive();
  // Numbers and counts the sample and passes it to the sink, then to the listener.
  void hand_out(LoadSample& sample);

  Transport& transport_;
  const RigClock& clock_;
  RecordSink sink_;
  std::function<void(const LoadSample&)> listener_;
  std::function<bool(const ReceivedLine&)> takes_other_;
  LineSplitter splitter_;
  bool is_connected_ = false;
  bool accepts_restarts_ = false;
  std::int64_t n_restarts_ = 0;
  // Skips the numbers of readings that a restart has cost, so that the numbers of a stream without
  // a clock still count its time.
  std::int64_t n_skipped_ = 0;
  double period_s_;
  std::string unit_;  // as sent with the readings; may be empty
  std::string other_unit_;
  int n_other_unit_ = 0;
  StreamCounts counts_;
  double last_arrival_s_ = 0.0;
  double listened_at_s_ = 0.0;
};

}  // namespace viscard
