#pragma once

#include "models/experiment/run_record.h"
#include "rig/lines/record_sink.h"
#include "rig/lines/rig_clock.h"
#include "rig/run/spike_watch.h"

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace viscard {

// Marks readings that their neighbours contradict, in value or in the time of the device's clock,
// by an event "implausible" with the index of the reading. A marked reading stays in the record as
// it was received.
class ReadingMarks {
 public:
  ReadingMarks(const RigClock& clock, const RecordSink& sink) : clock_(clock), sink_(sink) {}

  // value: counts or force of the reading, nothing if it is doubtful; period_s: time between
  // readings.
  void take(const LoadSample& sample, std::optional<double> value, double period_s);
  // Call after the last reading: judges the ones that have too few neighbours after them.
  void finish();

  int n_marked() const { return static_cast<int>(marked_.size()); }

 private:
  void mark_all(const std::vector<std::int64_t>& values, const std::vector<std::int64_t>& times);
  void mark(std::int64_t index, const std::string& why);

  const RigClock& clock_;
  const RecordSink& sink_;
  SpikeWatch values_;
  std::optional<SpikeWatch> times_;  // only if the device sends its own time
  double first_period_s_ = 0.0;      // period at the first reading
  std::set<std::int64_t> marked_;    // indices
};

}  // namespace viscard
