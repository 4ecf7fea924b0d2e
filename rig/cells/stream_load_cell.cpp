#include "rig/cells/stream_load_cell.h"

#include "models/maths/text_of_number.h"
#include "rig/lines/rig_error.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace viscard {
namespace {

constexpr double kLateness_wall_s = 0.3;  // of a line, if the device or this machine stalls
constexpr double kJitter_wall_s = 0.1;    // of arrivals
constexpr double kGapPeriods = 1.5;
constexpr double kBurst = 0.5;  // of a period: readings closer together were delayed before

}  // namespace

StreamLoadCell::StreamLoadCell(Transport& transport, const LoadCellConfig& config,
                               const RigClock& clock, RecordSink sink)
    : LoadCell(transport, config, clock, std::move(sink)),
      expected_period_s_(period_s_),
      arrival_clock_(period_s_) {}

bool StreamLoadCell::await_readings(const Pump& pump, double wall_s, bool is_text) {
  const double deadline_s = clock_.awake_s() + wall_s;
  while (!is_connected_ && clock_.awake_s() < deadline_s) pump();
  if (is_connected_) return true;
  const std::string where = "'" + transport_.name() + "'";
  if (n_bytes() == 0) {
    throw RigError("nothing came from the load cell on " + where +
                   ". Is this its port (not swapped with that of the stage), and is the "
                   "amplifier switched on?");
  }
  if (is_text && splitter_.unprintable_fraction() > 0.2) {
    throw RigError("the bytes from the load cell on " + where +
                   " are mostly unreadable: " + transport_.question());
  }
  return false;
}

void StreamLoadCell::start_clock(double tick_s, const std::optional<double>& ticks, double time_s) {
  DeviceClock started(tick_s, clock_.from_wall_s(kLateness_wall_s));
  if (device_clock_) started.start_at(time_s - device_clock_->host_minus_device_s());
  if (ticks) started.take(*ticks, time_s, period_s_);
  device_clock_ = std::move(started);
}

void StreamLoadCell::take_text(const ReceivedLine& line) {
  const auto n_letters = std::count_if(line.text.begin(), line.text.end(),
                                       [](unsigned char c) { return std::isalpha(c) != 0; });
  if (n_letters >= 4) {
    banner_ = shown_bytes(line.text, 40);
    if (has_restarted(line.time_s)) return begin_again("'" + banner_ + "'", line.time_s);
  }
  note_unreadable(line.text, line.time_s);
}

// A banner means a restart if there is a pause before it (the amplifier was switched off) or after
// it (it starts its converter and takes its tare).
bool StreamLoadCell::has_restarted(double time_s) const {
  const double pause_s = clock_.from_wall_s(0.3) + 10 * period_s_;
  return !banner_.empty() && time_s - last_arrival_s_ > pause_s;
}

void StreamLoadCell::begin_again(const std::string& sign, double time_s) {
  banner_.clear();
  if (!accepts_restarts_) {
    throw DeviceRestarted("the load cell's amplifier restarted in the middle of the run (" + sign +
                          "); its tare is gone. Check its supply, then start the run again");
  }
  ++n_restarts_;
  is_connected_ = false;
  n_owed_ = n_late_ = last_missing_ = 0;
  arrival_clock_ = ArrivalClock(expected_period_s_);
  n_periods_ = counts_.received + counts_.missing + counts_.unreadable;
  forget();
  sink_(RunEvent{time_s, "load_cell_restarted", "",
                 "The load cell's amplifier restarted (" + sign +
                     ") before the tare was done: its lines are learnt anew"});
}

bool StreamLoadCell::accept(const Sent& sent, double time_s) {
  if (has_restarted(time_s)) {
    begin_again("'" + banner_ + "'", time_s);
    return false;
  }
  banner_.clear();
  if (!has_known_unit(sent.unit, sent.text, time_s)) return false;
  if (sent.ticks && device_clock_) {
    if (!take_clock(*sent.ticks, time_s)) return false;
  } else if (sent.n_lost) {
    take_loss(*sent.n_lost, time_s);
  } else if (counts_.received > 0) {
    take_arrival(time_s);
  }
  if (!device_clock_) {
    const std::int64_t n_periods = counts_.received + counts_.missing + counts_.unreadable;
    arrival_clock_.take(static_cast<double>(n_periods - std::exchange(n_periods_, n_periods)),
                        time_s);
  }
  return true;
}

void StreamLoadCell::hand_out_at(LoadSample& sample, double time_s) {
  sample.host_time_s = time_s;
  if (device_clock_) sample.device_time_s = device_clock_->time_s();
  hand_out(sample);
}

// For a stream of numbered readings: the missing ones are known, even if the others arrive late.
void StreamLoadCell::take_loss(std::int64_t n_lost, double time_s) {
  note_gap(time_s - last_arrival_s_, 1e300, time_s);
  if (n_lost == 0) return;
  counts_.missing += n_lost;
  sink_(RunEvent{time_s, "gap", std::to_string(n_lost),
                 counted(static_cast<std::size_t>(n_lost), "reading") +
                     " of the load cell missing, by their numbers"});
}

// For a stream without a clock. Readings that arrive in a burst after a gap were not missing but
// delayed, by the machine, the adapter or the amplifier's own buffer.
void StreamLoadCell::take_arrival(double time_s) {
  const double step_s = time_s - last_arrival_s_;
  if (n_owed_ > 0 && step_s < kBurst * period_s_) {
    --n_owed_;
    --counts_.missing;
    ++n_late_;
    return;
  }
  if (n_late_ > 0) {
    sink_(RunEvent{time_s, "late", std::to_string(n_late_),
                   std::to_string(n_late_) +
                       " readings reported missing were only delayed: they came in a burst"});
  }
  n_late_ = 0;
  take_step(step_s, time_s);
  n_owed_ = last_missing_;
}

bool StreamLoadCell::take_clock(double ticks, double time_s) {
  switch (device_clock_->take(ticks, time_s, period_s_)) {
    case DeviceClock::Verdict::kDuplicate:
      ++counts_.duplicate;
      return false;
    case DeviceClock::Verdict::kSuspect:
      ++counts_.unreadable;
      sink_(RunEvent{time_s, "load_cell_unreadable", text_from_number(ticks, 0),
                     "A reading whose clock does not fit was left out"});
      return false;
    case DeviceClock::Verdict::kRestarted:
      begin_again("its clock began anew", time_s);
      return false;
    case DeviceClock::Verdict::kLastWasBad:
      doubt_last(time_s);
      break;
    case DeviceClock::Verdict::kGood:
      break;
  }
  const double step_s = device_clock_->step_s();
  if (counts_.received > 0) take_step(step_s, time_s);
  // The converter's oscillator is off by several percent, so the measured period is tracked.
  if (step_s > 0.7 * period_s_ && step_s < 1.3 * period_s_)
    period_s_ += 0.02 * (step_s - period_s_);
  return true;
}

// The time of the previous reading was garbled so that it seemed to follow a gap.
void StreamLoadCell::doubt_last(double time_s) {
  const std::int64_t index = counts_.received - 1;
  ++counts_.implausible;
  counts_.missing -= last_missing_;
  sink_(RunEvent{time_s, "implausible", std::to_string(index),
                 "Reading " + std::to_string(index) +
                     " of the load cell came with a time that the next one contradicts"});
}

void StreamLoadCell::take_step(double step_s, double time_s) {
  // Without a device clock a late line looks like a lost one, so only a long silence counts.
  const double least_s =
      device_clock_ ? kGapPeriods * period_s_
                    : std::max(kGapPeriods * period_s_, 3 * period_s_ + clock_.from_wall_s(0.1));
  last_missing_ = note_gap(step_s, least_s, time_s);
}

double StreamLoadCell::made_at_s(const LoadSample& sample) const {
  if (!sample.device_time_s || !device_clock_) {
    // Smaller delays are the jitter of arrivals.
    const double lag_s = arrival_clock_.lag_s();
    return sample.host_time_s - (lag_s > clock_.from_wall_s(kJitter_wall_s) ? lag_s : 0.0);
  }
  return *sample.device_time_s + device_clock_->host_minus_device_s();
}

}  // namespace viscard
