#include "rig/cells/hx711_load_cell.h"

#include "models/maths/text_of_number.h"
#include "rig/lines/rig_error.h"
#include "rig/protocols/gauge_protocols.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

constexpr double kFirstReading_wall_s = 15.0;  // banner and messages of a tare last up to 10 s
constexpr double kPeriodsToLearn = 20.0;
constexpr double kLateness_wall_s = 0.3;  // of a line, if the device or this machine stalls
constexpr double kJitter_wall_s = 0.1;    // of arrivals
constexpr double kGapPeriods = 1.5;
constexpr double kBurst = 0.5;  // of a period: readings closer together were delayed before

}  // namespace

Hx711LoadCell::Hx711LoadCell(Transport& transport, const LoadCellConfig& config,
                             const RigClock& clock, RecordSink sink, double patience)
    : LoadCell(transport, config, clock, std::move(sink)),
      config_(config),
      patience_(patience),
      format_(declared_hx711_format(config)),
      declared_unit_(config.unit),
      learner_(config),
      arrival_clock_(period_s_) {
  if (!config.unit.empty() && !newtons_per_unit(config.unit)) {
    throw RigError("unit '" + config.unit +
                   "' under [load_cell] of the rig file is unknown; choose N, mN, g, kg or lb");
  }
}

void Hx711LoadCell::connect(const Pump& pump) {
  const double deadline_s =
      clock_.awake_s() +
      patience_ * (kFirstReading_wall_s + kPeriodsToLearn * period_s_ / clock_.speed());
  while (!is_connected_ && clock_.awake_s() < deadline_s) pump();
  if (is_connected_) return;
  const std::string where = "'" + transport_.name() + "'";
  if (splitter_.n_bytes() == 0) {
    throw RigError("nothing came from the load cell on " + where +
                   ". Is this its port, and is the amplifier switched on?");
  }
  if (splitter_.unprintable_fraction() > 0.2) {
    throw RigError("the bytes from the load cell on " + where +
                   " are mostly unreadable: is the baud rate of " +
                   std::to_string(transport_.baud()) + " right?");
  }
  throw RigError("no line on " + where + " could be read as a reading; the last one was '" +
                 shown_bytes(learner_.newest_text()) +
                 "'. Set line_format in the rig file to counts, micros,counts, millis,counts or "
                 "volts");
}

void Hx711LoadCell::service() {
  const Chunk chunk = transport_.read_available();
  listened_at_s_ = chunk.time_s;
  if (!chunk.bytes.empty()) {
    sink_(RawBytes{Device::kLoadCell, false, chunk.time_s, chunk.bytes});
    splitter_.feed(chunk.bytes, chunk.time_s, 10.0 / transport_.baud());
  }
  while (const auto line = splitter_.next()) take_line(*line);
}

void Hx711LoadCell::take_line(const ReceivedLine& line) {
  // The first line may be the second half of one.
  if (!std::exchange(is_past_first_line_, true) || trimmed(line.text).empty()) return;
  if (is_hx711_fault(line.text)) {
    throw RigError("the amplifier on '" + transport_.name() + "' reports '" +
                   shown_bytes(line.text) + "'. Check the wires between it and its HX711");
  }
  if (!is_connected_) return learn(line);
  const auto reading = parse_hx711_line(line.text, has_clock(format_));
  // A new unit, or "ovf", has another shape but is no garbled line; both are handled below.
  const bool is_judged = reading && reading->value && reading->unit == unit_;
  if (reading && (!is_judged || shape_.fits(line.text))) {
    take_reading(*reading, line.text, line.time_s);
  } else {
    take_text(line);
  }
}

void Hx711LoadCell::learn(const ReceivedLine& line) {
  const auto format = learner_.take(line);
  if (!format) return;
  format_ = *format;
  if (has_clock(format_)) {
    start_clock(line);
  } else if (counts_.received > 0) {
    n_skipped_ += std::llround((line.time_s - last_arrival_s_) / period_s_);
  }
  last_arrival_s_ = line.time_s;
  is_connected_ = true;
  sink_(RunEvent{line.time_s, "line_format", word_of(format_),
                 "The lines of the load cell, such as '" + shown_bytes(line.text) +
                     "', are read as " + word_of(format_)});
}

// The clock starts with the last of the lines, so that a restart right after them is noticed. After
// a restart it continues the old one: the least delay stays the same.
void Hx711LoadCell::start_clock(const ReceivedLine& line) {
  DeviceClock started(format_ == Hx711Format::kMicrosCounts ? 1e-6 : 1e-3,
                      clock_.from_wall_s(kLateness_wall_s));
  if (device_clock_) started.start_at(line.time_s - device_clock_->host_minus_device_s());
  const auto last = parse_hx711_line(line.text, true);
  if (last) started.take(*last->ticks, line.time_s, period_s_);
  device_clock_ = std::move(started);
}

// Text in the middle of a run is the banner of a restart if the readings pause, otherwise garbage.
void Hx711LoadCell::take_text(const ReceivedLine& line) {
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
bool Hx711LoadCell::has_restarted(double time_s) const {
  const double pause_s = clock_.from_wall_s(0.3) + 10 * period_s_;
  return !banner_.empty() && time_s - last_arrival_s_ > pause_s;
}

// Learns the lines anew if nothing has been measured yet; otherwise the run must end.
void Hx711LoadCell::begin_again(const std::string& sign, double time_s) {
  banner_.clear();
  if (!accepts_restarts_) {
    throw DeviceRestarted("the load cell's amplifier restarted in the middle of the run (" + sign +
                          "); its tare is gone. Check its supply, then start the run again");
  }
  ++n_restarts_;
  is_connected_ = false;
  learner_ = Hx711Learner(config_);
  shape_ = LineShape();
  previous_counts_.reset();
  n_owed_ = n_late_ = last_missing_ = 0;
  arrival_clock_ = ArrivalClock(1.0 / config_.expected_rate_Hz);
  n_periods_ = counts_.received + counts_.missing + counts_.unreadable;
  sink_(RunEvent{time_s, "load_cell_restarted", "",
                 "The load cell's amplifier restarted (" + sign +
                     ") before the tare was done: its lines are learnt anew"});
}

void Hx711LoadCell::take_reading(const Hx711Line& reading, const std::string& text, double time_s) {
  if (has_restarted(time_s)) return begin_again("'" + banner_ + "'", time_s);
  banner_.clear();
  if (!has_known_unit(reading.unit, text, time_s)) return;
  if (reading.ticks && device_clock_) {
    if (!take_clock(*reading.ticks, time_s)) return;
  } else if (counts_.received > 0) {
    take_arrival(time_s);
  }
  if (!device_clock_) {
    const std::int64_t n_periods = counts_.received + counts_.missing + counts_.unreadable;
    arrival_clock_.take(static_cast<double>(n_periods - std::exchange(n_periods_, n_periods)),
                        time_s);
  }
  LoadSample sample = sample_of(reading, time_s);
  hand_out(sample);
}

// For a stream without a clock. Readings that arrive in a burst after a gap were not missing but
// delayed, by the machine, the adapter or the amplifier's own buffer.
void Hx711LoadCell::take_arrival(double time_s) {
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

// False if the line must be left out.
bool Hx711LoadCell::take_clock(double ticks, double time_s) {
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
void Hx711LoadCell::doubt_last(double time_s) {
  const std::int64_t index = counts_.received - 1;
  ++counts_.implausible;
  counts_.missing -= last_missing_;
  sink_(RunEvent{time_s, "implausible", std::to_string(index),
                 "Reading " + std::to_string(index) +
                     " of the load cell came with a time that the next one contradicts"});
}

void Hx711LoadCell::take_step(double step_s, double time_s) {
  // Without a device clock a late line looks like a lost one, so only a long silence counts.
  const double least_s =
      device_clock_ ? kGapPeriods * period_s_
                    : std::max(kGapPeriods * period_s_, 3 * period_s_ + clock_.from_wall_s(0.1));
  last_missing_ = note_gap(step_s, least_s, time_s);
}

LoadSample Hx711LoadCell::sample_of(const Hx711Line& reading, double time_s) {
  LoadSample sample;
  sample.host_time_s = time_s;
  if (device_clock_) sample.device_time_s = device_clock_->time_s();
  const std::string& unit = reading.unit.empty() ? declared_unit_ : reading.unit;
  if (!unit.empty()) {
    if (reading.value) sample.force_N = *reading.value * newtons_per_unit(unit).value_or(1.0);
  } else if (format_ == Hx711Format::kVolts) {
    sample.volts = reading.value;
  } else {
    sample.counts = reading.value;
  }
  if (sample.counts) {
    sample.is_saturated = is_hx711_saturated(*sample.counts);
    sample.is_glitch = is_hx711_glitch(*sample.counts, previous_counts_);
    if (!sample.is_glitch) previous_counts_ = sample.counts;
  } else if (!sample.volts && !sample.force_N) {
    sample.is_saturated = true;  // "ovf", "inf": the device itself reports no reading
  }
  return sample;
}

std::string Hx711LoadCell::reads_as() const {
  const std::string& unit = unit_.empty() ? declared_unit_ : unit_;
  if (!unit.empty()) return unit;
  return format_ == Hx711Format::kVolts ? "volts" : "counts";
}

double Hx711LoadCell::made_at_s(const LoadSample& sample) const {
  if (!sample.device_time_s || !device_clock_) {
    // Smaller delays are the jitter of arrivals.
    const double lag_s = arrival_clock_.lag_s();
    return sample.host_time_s - (lag_s > clock_.from_wall_s(kJitter_wall_s) ? lag_s : 0.0);
  }
  return *sample.device_time_s + device_clock_->host_minus_device_s();
}

}  // namespace viscard
