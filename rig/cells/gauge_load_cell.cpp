#include "rig/cells/gauge_load_cell.h"

#include "models/maths/text_of_number.h"
#include "rig/lines/rig_error.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace viscard {
namespace {

constexpr double kAnswer_wall_s = 0.5;  // longest wait for a reading at the declared rate
constexpr double kQuiet_wall_s = 0.15;  // without a byte: late answers have arrived by then
constexpr double kPause_wall_s = 0.05;  // between lines of the setup, without flow control
constexpr double kText_wall_s = 2.0;    // for identity and errors, even during a self-test
constexpr int kFirstTries = 6;
constexpr int kMostSilent = 10;
constexpr int kMostRefused = 5;
constexpr double kGapInPeriods = 2.5;  // answers jitter more than a stream

struct GaugeDriver {
  const char* name;
  GaugeProtocol (*protocol)(const LoadCellConfig&);
};

// One row per value of driver under [load_cell] that is polled.
constexpr GaugeDriver kDrivers[] = {
    {"scpi", [](const LoadCellConfig& config) { return scpi_protocol(config.dialect); }},
    {"mark10", [](const LoadCellConfig& config) { return mark10_protocol(config.unit); }},
    {"sauter", [](const LoadCellConfig& config) { return sauter_protocol(config.unit); }},
    {"mt-sics", [](const LoadCellConfig& config) { return mt_sics_protocol(config.unit); }},
    {"sartorius", [](const LoadCellConfig& config) { return sartorius_protocol(config.unit); }}};

GaugeProtocol gauge_protocol(const LoadCellConfig& config) {
  for (const GaugeDriver& driver : kDrivers) {
    if (config.driver == driver.name) return driver.protocol(config);
  }
  throw RigError("driver '" + config.driver +
                 "' under [load_cell] of the rig file names no instrument that is polled");
}

}  // namespace

void check_gauge_words(const LoadCellConfig& config) {
  gauge_protocol(config);
}

GaugeLoadCell::GaugeLoadCell(Transport& transport, const LoadCellConfig& config,
                             const RigClock& clock, RecordSink sink)
    : LoadCell(transport, config, clock, std::move(sink)), protocol_(gauge_protocol(config)) {}

GaugeLoadCell::~GaugeLoadCell() {
  if (protocol_.closing.empty()) return;
  try {
    transport_.write(protocol_.closing);
  } catch (...) {
    // The instrument is gone.
  }
}

// One question whose answer is a line of text; nothing if none comes.
std::optional<std::string> GaugeLoadCell::ask_text(const std::string& query, const Pump& pump) {
  text_answer_.reset();
  awaits_text_ = true;
  send(query);
  const double until_s = clock_.awake_s() + kText_wall_s;
  while (!text_answer_ && clock_.awake_s() < until_s) pump();
  awaits_text_ = false;
  return text_answer_;
}

void GaugeLoadCell::connect(const Pump& pump) {
  for (const std::string& words : protocol_.opening) {
    send(words);
    wait(pump, kPause_wall_s);
  }
  if (!protocol_.identity_query.empty()) {
    identity_ = ask_text(protocol_.identity_query, pump).value_or("");
  }
  if (!protocol_.error_query.empty()) {
    const auto text = ask_text(protocol_.error_query, pump);
    const auto error = text ? parse_scpi_error(*text) : std::nullopt;
    if (error && error->code != 0) {
      throw RigError("the instrument on '" + transport_.name() +
                     "' rejected its setup: " + error->text + " (" + std::to_string(error->code) +
                     "). Set another dialect under [load_cell] of the rig file");
    }
  }
  wait(pump, kQuiet_wall_s);
  is_connected_ = true;
  const double until_s = clock_.awake_s() + kFirstTries * (kAnswer_wall_s + kQuiet_wall_s);
  while (counts_.received == 0 && clock_.awake_s() < until_s) pump();
  if (counts_.received > 0) return;
  is_connected_ = false;
  const bool is_noise = splitter_.n_bytes() > 5 && splitter_.unprintable_fraction() > 0.2;
  const std::string words = identity_.empty() ? "" : " (it calls itself '" + identity_ + "')";
  throw RigError("no reading came from the " + protocol_.name + " instrument on '" +
                 transport_.name() + "'" + words + ". " +
                 (is_noise
                      ? "The bytes received are mostly unreadable: is framing right, and " +
                            transport_.question()
                      : "Is this its port, is it switched on, is its interface set to it, and " +
                            transport_.question()));
}

// Precondition: connected.
void GaugeLoadCell::set_zero(const Pump& pump) {
  is_connected_ = false;  // nothing is asked, and the answer to an open question is dropped
  asked_s_.reset();
  wait(pump, kAnswer_wall_s);
  is_zeroing_ = true;
  const auto answer = ask_text(protocol_.zero, pump);
  is_zeroing_ = false;
  is_connected_ = true;
  const auto& expected = protocol_.zeroed;
  const bool is_set = expected.empty() ? !answer
                                       : answer && std::any_of(expected.begin(), expected.end(),
                                                               [&](const std::string& begin) {
                                                                 return answer->starts_with(begin);
                                                               });
  if (is_set) return;
  throw RigError("the " + protocol_.name + " instrument on '" + transport_.name() +
                 "' has not set its zero" +
                 (answer ? ": it answered '" + *answer + "'" : ", it did not answer") +
                 ". Press its own zero key");
}

void GaugeLoadCell::service() {
  const Chunk chunk = receive();
  if (!chunk.bytes.empty()) feed(chunk);
  if (is_connected_) ask_if_due(chunk.time_s);
}

void GaugeLoadCell::feed(const Chunk& chunk) {
  quiet_since_s_ = chunk.time_s;
  if (protocol_.fixed_length == 0) {
    splitter_.feed(chunk.bytes, chunk.time_s, 10.0 / transport_.baud());
    while (const auto line = splitter_.next()) {
      if (!trimmed(line->text).empty()) take_answer(line->text, line->time_s);
    }
    return;
  }
  begun_ += chunk.bytes;
  if (begun_.size() < protocol_.fixed_length) return;
  const std::string answer = std::exchange(begun_, "");
  // With more bytes than one answer has, the parser refuses them and waits for a quiet line.
  take_answer(answer, chunk.time_s);
}

// False for the late answer to a question for a reading, garbled or not, and for the echo of an
// adapter: an instrument that sends these alone has not answered the command.
bool GaugeLoadCell::may_answer_zero(const std::string& text) const {
  if (trimmed(text) == trimmed(protocol_.zero)) return false;
  std::string line(trimmed(text));
  for (char& c : line) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  const auto begins = [&](const std::string& begin) { return line.starts_with(begin); };
  return std::any_of(protocol_.zeroed.begin(), protocol_.zeroed.end(), begins) ||
         std::any_of(protocol_.zero_refused.begin(), protocol_.zero_refused.end(), begins);
}

void GaugeLoadCell::take_answer(const std::string& text, double time_s) {
  if (awaits_text_) {
    if (!is_zeroing_ || may_answer_zero(text)) text_answer_ = std::string(trimmed(text));
    return;
  }
  if (!is_connected_) return;
  if (trimmed(text) == trimmed(protocol_.query)) return;  // the echo of an adapter
  if (!asked_s_ || waits_for_quiet_) {
    ++counts_.duplicate;
    sink_(RunEvent{time_s, "load_cell_late", shown_bytes(text, 80),
                   "An answer of the load cell to no open question was left out"});
    return;
  }
  const auto answer = protocol_.parse(text);
  if (!answer) {
    asked_s_.reset();
    waits_for_quiet_ = true;
    return note_unreadable(text, time_s);
  }
  if (!answer->error.empty()) {
    asked_s_.reset();
    if (++n_refused_ >= kMostRefused) {
      throw RigError("the force gauge on '" + transport_.name() + "' refuses to answer: '" +
                     answer->error + "'. Set its interface as the rig file says");
    }
    return;
  }
  n_silent_ = n_refused_ = 0;
  if (!has_known_unit(answer->unit, text, time_s)) {
    asked_s_.reset();
    return;
  }
  take_reading(*answer, time_s);
}

void GaugeLoadCell::take_reading(const GaugeAnswer& answer, double time_s) {
  LoadSample sample;
  sample.host_time_s = time_s;
  sample.device_time_s = asked_s_;
  sample.volts = answer.volts;
  sample.force_N = answer.force_N;
  sample.is_saturated = answer.is_overload;
  shortest_turn_s_ = std::min(shortest_turn_s_, time_s - *asked_s_);
  asked_s_.reset();
  if (counts_.received > 0) {
    const double step_s = time_s - last_arrival_s_;
    const double least_s = kGapInPeriods * period_s_ + clock_.from_wall_s(0.1);
    if (note_gap(step_s, least_s, time_s) == 0) period_s_ += 0.05 * (step_s - period_s_);
  }
  hand_out(sample);
}

// now_s: when the line was read last.
void GaugeLoadCell::ask_if_due(double now_s) {
  if (waits_for_quiet_) {
    if (now_s - quiet_since_s_ < clock_.from_wall_s(kQuiet_wall_s)) return;
    waits_for_quiet_ = false;
    begun_.clear();
  }
  if (asked_s_) {
    const double longest_s = std::max(clock_.from_wall_s(kAnswer_wall_s), 5.0 * period_s_);
    if (now_s - *asked_s_ < longest_s) return;
    asked_s_.reset();
    waits_for_quiet_ = true;
    quiet_since_s_ = now_s;
    if (++n_silent_ >= kMostSilent) {
      throw RigError("the load cell on '" + transport_.name() +
                     "' has stopped answering. Check its cable and supply");
    }
    return;
  }
  asked_s_ = clock_.now_s();
  send(protocol_.query);
}

double GaugeLoadCell::made_at_s(const LoadSample& sample) const {
  return sample.device_time_s ? *sample.device_time_s + shortest_turn_s_ : sample.host_time_s;
}

}  // namespace viscard
