#include "rig/cells/hx711_load_cell.h"

#include "models/maths/text_of_number.h"
#include "rig/lines/rig_error.h"
#include "rig/lines/who_answers.h"
#include "rig/protocols/gauge_protocols.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

constexpr double kFirstReading_wall_s = 15.0;  // banner and messages of a tare last up to 10 s
constexpr double kPeriodsToLearn = 20.0;

}  // namespace

Hx711LoadCell::Hx711LoadCell(Transport& transport, const LoadCellConfig& config,
                             const RigClock& clock, RecordSink sink, double patience)
    : StreamLoadCell(transport, config, clock, std::move(sink)),
      config_(config),
      patience_(patience),
      format_(declared_hx711_format(config)),
      declared_unit_(config.unit),
      columns_(declared_columns(config)),
      learner_(config) {
  if (!config.unit.empty() && !newtons_per_unit(config.unit)) {
    throw RigError("unit '" + config.unit +
                   "' under [load_cell] of the rig file is unknown; choose N, mN, g, kg or lb");
  }
}

void Hx711LoadCell::connect(const Pump& pump) {
  const double wall_s =
      patience_ * (kFirstReading_wall_s + kPeriodsToLearn * period_s_ / clock_.speed());
  if (await_readings(pump, wall_s, true)) return;
  const std::string known = who_answers({learner_.newest_text()});
  throw RigError(
      "no line on '" + transport_.name() + "' could be read as a reading; the last one was '" +
      shown_bytes(learner_.newest_text()) + "'. " +
      (known.empty() ? "Set line_format in the rig file to counts, micros,counts, millis,counts "
                       "or volts, or name the columns, such as -,counts"
                     : known));
}

void Hx711LoadCell::service() {
  const Chunk chunk = receive();
  if (!chunk.bytes.empty()) {
    splitter_.feed(chunk.bytes, chunk.time_s, 10.0 / transport_.baud());
  }
  while (const auto line = splitter_.next()) take_line(*line);
}

// Of a line with several columns only those of interest are read.
void Hx711LoadCell::take_line(const ReceivedLine& whole) {
  ReceivedLine line = whole;
  if (columns_) line.text = picked_columns(line.text, *columns_).value_or(line.text);
  // The first line may be the second half of one.
  if (!std::exchange(is_past_first_line_, true) || trimmed(line.text).empty()) return;
  if (is_other_line(line)) return;
  if (is_hx711_fault(line.text)) {
    throw RigError("the amplifier on '" + transport_.name() + "' reports '" +
                   shown_bytes(line.text) + "'. Check the wires between it and its converter");
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
    const auto last = parse_hx711_line(line.text, true);
    start_clock(format_ == Hx711Format::kMicrosCounts ? 1e-6 : 1e-3,
                last ? last->ticks : std::nullopt, line.time_s);
  } else if (counts_.received > 0) {
    n_skipped_ += std::llround((line.time_s - last_arrival_s_) / period_s_);
  }
  last_arrival_s_ = line.time_s;
  is_connected_ = true;
  sink_(RunEvent{line.time_s, "line_format", word_of(format_),
                 "The lines of the load cell, such as '" + shown_bytes(line.text) +
                     "', are read as " + word_of(format_)});
}

void Hx711LoadCell::forget() {
  learner_ = Hx711Learner(config_);
  shape_ = LineShape();
  previous_counts_.reset();
}

void Hx711LoadCell::take_reading(const Hx711Line& reading, const std::string& text, double time_s) {
  if (!accept({reading.ticks, reading.unit, text}, time_s)) return;
  LoadSample sample = sample_of(reading);
  hand_out_at(sample, time_s);
}

LoadSample Hx711LoadCell::sample_of(const Hx711Line& reading) {
  LoadSample sample;
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
    // Only an HX711 is read by a clock that an interrupt can stretch.
    sample.is_glitch =
        config_.driver == "hx711" && is_hx711_glitch(*sample.counts, previous_counts_);
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

}  // namespace viscard
