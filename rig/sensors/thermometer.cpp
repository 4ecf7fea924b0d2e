#include "rig/sensors/thermometer.h"

#include "models/maths/text_of_number.h"
#include "rig/lines/rig_error.h"
#include "rig/protocols/temperature_text.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace viscard {
namespace {

constexpr double kJump_K = 2.0;            // between neighbours; a room changes more slowly
constexpr double kAnswerPeriods = 2.0;     // an unanswered question is given up after these
constexpr double kShortestAnswer_s = 2.0;  // a converter may take a second
constexpr double kWrite_s = 0.002;         // the force is not watched meanwhile

}  // namespace

void check_thermometer_words(const ThermometerConfig& config) {
  if (!has_thermometer(config)) return;
  const bool is_known =
      config.driver == "text" || config.driver == "scpi" || config.driver == "load-cell";
  if (!is_known) {
    throw RigError("driver '" + config.driver +
                   "' under [thermometer] of the rig file is unknown; known are none, text, scpi, "
                   "load-cell");
  }
  if (is_temperature_unit(config.unit)) return;
  throw RigError("unit '" + config.unit +
                 "' under [thermometer] of the rig file is unknown; choose degC, degF or K");
}

Thermometer::Thermometer(std::unique_ptr<Transport> line, const std::string& trouble,
                         const ThermometerConfig& config, const RigClock& clock, RecordSink sink)
    : line_(std::move(line)),
      config_(config),
      clock_(clock),
      sink_(std::move(sink)),
      baud_(config.baud),
      name_(is_shared() ? "the port of the load cell" : config.port) {
  if (!trouble.empty()) note_trouble("missing", trouble, clock_.now_s());
}

std::optional<double> Thermometer::newest_C() const {
  return readings_C_.empty() ? std::nullopt : std::optional(readings_C_.back());
}

void Thermometer::note_trouble(const std::string& value, const std::string& text, double time_s) {
  trouble_ = text;
  sink_(RunEvent{time_s, "thermometer", value, text + ". The run goes on without it"});
}

// Errors of the sink are not the thermometer's: they pass.
void Thermometer::service() {
  const double now_s = clock_.now_s();
  if (!begun_s_) begun_s_ = newest_s_ = now_s;
  if (line_) {
    const Chunk chunk = received();
    if (!chunk.bytes.empty()) {
      sink_(RawBytes{Device::kThermometer, false, chunk.time_s, chunk.bytes});
      splitter_.feed(chunk.bytes, chunk.time_s, 10.0 / baud_);
    }
    while (const auto line = splitter_.next()) take_line(*line);
  }
  if (line_) ask_if_due(now_s);
  watch_silence(now_s);
}

Chunk Thermometer::received() {
  std::string lost;
  try {
    return line_->read_available();
  } catch (const RigError& error) {
    lost = error.what();
  }
  line_.reset();
  note_trouble("lost", lost, clock_.now_s());
  return {};
}

void Thermometer::ask_if_due(double now_s) {
  if (config_.driver != "scpi") return;
  const double patience_s = std::max(kShortestAnswer_s, kAnswerPeriods * config_.period_s);
  if (asked_s_ && now_s - *asked_s_ < patience_s) return;
  if (!asked_s_ && !readings_C_.empty() && now_s - newest_s_ < config_.period_s) return;
  asked_s_ = now_s;
  const std::string words = config_.query + "\n";
  try {
    line_->write(words, kWrite_s);
  } catch (const RigError&) {
    return;  // a line that is gone is noticed when it is read; one that takes no bytes falls silent
  }
  sink_(RawBytes{Device::kThermometer, true, now_s, words});
}

void Thermometer::watch_silence(double now_s) {
  const double silence_s = now_s - newest_s_;
  longest_silence_s_ = std::max(longest_silence_s_, silence_s);
  if (is_silent_ || silence_s < silent_after_s(config_) || (!line_ && !is_shared())) return;
  is_silent_ = true;
  note_trouble("silent",
               "the thermometer on " + name_ + " has sent no temperature for " +
                   text_from_number(silence_s, 0) + " s",
               now_s);
}

bool Thermometer::take_shared_line(const ReceivedLine& line) {
  if (!names_temperature(line.text)) return false;
  is_past_first_line_ = true;
  take_line(line);
  return true;
}

void Thermometer::take_line(const ReceivedLine& line) {
  const std::string_view text = trimmed(line.text);
  if (text.empty() || text == trimmed(config_.query)) return;  // the echo of an adapter
  // The first line of one that sends by itself may be the second half of one.
  const bool is_whole = std::exchange(is_past_first_line_, true) || config_.driver == "scpi";
  if (!is_whole) return;
  asked_s_.reset();
  if (const auto temperature_C = temperature_C_from_text(text, config_.unit)) {
    take_reading(*temperature_C, line.time_s);
    return;
  }
  note_unreadable(shown_bytes(text, 80), "A line of the thermometer is no temperature",
                  line.time_s);
}

// Another device on this port would send many such lines; the first ones show what is wrong.
void Thermometer::note_unreadable(const std::string& value, const std::string& text,
                                  double time_s) {
  constexpr std::size_t kMostEvents = 20;
  if (++n_unreadable_ <= kMostEvents) {
    sink_(RunEvent{time_s, "thermometer_unreadable", value, text});
  }
}

void Thermometer::take_reading(double temperature_C, double time_s) {
  const auto agrees = [&](double other_C) { return std::abs(temperature_C - other_C) <= kJump_K; };
  if (readings_C_.empty() || !agrees(readings_C_.back())) {
    if (!jumped_C_ || !agrees(*jumped_C_)) {
      if (jumped_C_) ++n_unreadable_;
      jumped_C_ = temperature_C;
      jumped_s_ = time_s;
      return;
    }
    hand_out(*jumped_C_, jumped_s_);
  } else if (jumped_C_) {
    note_unreadable(text_from_number(*jumped_C_, 3),
                    "A temperature that its neighbours contradict was left out", time_s);
  }
  jumped_C_.reset();
  hand_out(temperature_C, time_s);
}

void Thermometer::hand_out(double temperature_C, double time_s) {
  longest_silence_s_ = std::max(longest_silence_s_, time_s - newest_s_);
  newest_s_ = time_s;
  readings_C_.push_back(temperature_C);
  sink_(TemperatureSample{time_s, temperature_C});
  if (!is_silent_) return;
  is_silent_ = false;
  trouble_.clear();
  sink_(RunEvent{time_s, "thermometer", "back", "The thermometer sends temperatures again"});
}

}  // namespace viscard
