#include "rig/cells/load_cell.h"

#include "models/maths/text_of_number.h"
#include "rig/lines/rig_error.h"

#include <cmath>
#include <utility>

namespace viscard {

LoadCell::LoadCell(Transport& transport, const LoadCellConfig& config, const RigClock& clock,
                   RecordSink sink)
    : transport_(transport),
      clock_(clock),
      sink_(std::move(sink)),
      period_s_(1.0 / config.expected_rate_Hz) {}

void LoadCell::send(const std::string& words) {
  sink_(RawBytes{Device::kLoadCell, true, clock_.now_s(), words});
  transport_.write(words);
}

void LoadCell::wait(const Pump& pump, double wall_s) const {
  const double until_s = clock_.awake_s() + wall_s;
  while (clock_.awake_s() < until_s) pump();
}

void LoadCell::note_unreadable(const std::string& text, double time_s) {
  ++counts_.unreadable;
  sink_(RunEvent{time_s, "load_cell_unreadable", shown_bytes(text, 80),
                 "A line from the load cell is no reading"});
}

bool LoadCell::has_known_unit(const std::string& unit, const std::string& text, double time_s) {
  constexpr int kToChange = 3;
  if (counts_.received == 0 || unit == unit_) {
    unit_ = unit;
    n_other_unit_ = 0;
    return true;
  }
  n_other_unit_ = unit == other_unit_ ? n_other_unit_ + 1 : 1;
  other_unit_ = unit;
  if (n_other_unit_ >= kToChange) {
    throw RigError("the load cell changed its unit from '" + unit_ + "' to '" + unit +
                   "' in the middle of the run. Set it back, then start the run again");
  }
  note_unreadable(text, time_s);
  return false;
}

std::int64_t LoadCell::note_gap(double step_s, double least_s, double time_s) {
  if (step_s > counts_.longest_gap_s) {
    counts_.longest_gap_s = step_s;
    counts_.longest_gap_at_s = time_s;
  }
  if (step_s <= least_s) return 0;
  const auto n_missing = static_cast<std::int64_t>(std::llround(step_s / period_s_)) - 1;
  counts_.missing += n_missing;
  sink_(RunEvent{
      time_s, "gap", text_from_number(step_s, 6),
      counted(static_cast<std::size_t>(n_missing), "reading") + " of the load cell missing"});
  return n_missing;
}

Chunk LoadCell::receive() {
  Chunk chunk = transport_.read_available();
  listened_at_s_ = chunk.time_s;
  if (!chunk.bytes.empty()) {
    sink_(RawBytes{Device::kLoadCell, false, chunk.time_s, chunk.bytes});
  }
  return chunk;
}

void LoadCell::hand_out(LoadSample& sample) {
  sample.index = n_skipped_ + counts_.received++;
  last_arrival_s_ = sample.host_time_s;
  counts_.saturated += sample.is_saturated ? 1 : 0;
  counts_.glitch += sample.is_glitch ? 1 : 0;
  sink_(sample);
  if (listener_) listener_(sample);
}

}  // namespace viscard
