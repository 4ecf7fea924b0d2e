#include "rig/cells/mark10_stream.h"

#include "models/maths/text_of_number.h"
#include "rig/lines/rig_error.h"
#include "rig/protocols/gauge_protocols.h"

#include <utility>

namespace viscard {
namespace {

constexpr double kRefusal_wall_s = 0.15;  // an error comes within that time after its command
constexpr double kFirstLine_wall_s = 2.0;

}  // namespace

void check_mark10_words(const LoadCellConfig& config) {
  checked_gauge_unit(config.unit);
}

Mark10Stream::Mark10Stream(Transport& transport, const LoadCellConfig& config,
                           const RigClock& clock, RecordSink sink)
    : StreamLoadCell(transport, config, clock, std::move(sink)),
      declared_unit_(checked_gauge_unit(config.unit)),
      rate_Hz_(mark10_stream_rate_Hz(config.expected_rate_Hz)) {
  period_s_ = 1.0 / rate_Hz_;
}

Mark10Stream::~Mark10Stream() {
  try {
    transport_.write(mark10_stream_command(0));
  } catch (...) {
    // The gauge is gone.
  }
}

void Mark10Stream::connect(const Pump& pump) {
  is_streaming_ = false;
  // It may still transmit for a program that has ended, and then the first answer is half a line.
  ask(mark10_stream_command(0), false, pump);
  ask("CUR\r", true, pump);
  ask("OPOL0\r", false, pump);  // older firmware does not know it and always sends the sign
  ask("FULL\r", false, pump);
  shape_ = LineShape();
  is_streaming_ = true;
  ask(mark10_stream_command(rate_Hz_), true, pump);
  if (await_readings(pump, kFirstLine_wall_s, true)) return;
  throw RigError("the force gauge on '" + transport_.name() +
                 "' sent no readings after the command " +
                 std::string(trimmed(mark10_stream_command(rate_Hz_))) +
                 ". Poll it: set driver = \"mark10\" under [load_cell] of the rig file");
}

// Sends a command and waits for its refusal; nothing answers a command that was accepted.
void Mark10Stream::ask(const std::string& command, bool is_required, const Pump& pump) {
  refusal_.clear();
  send(command);
  wait(pump, kRefusal_wall_s);
  if (refusal_.empty() || !is_required) return;
  throw RigError("the force gauge on '" + transport_.name() + "' refuses the command " +
                 std::string(trimmed(command)) + " ('" + refusal_ +
                 "'): it has no continuous mode. Poll it: set driver = \"mark10\" under "
                 "[load_cell] of the rig file");
}

void Mark10Stream::service() {
  const Chunk chunk = receive();
  if (!chunk.bytes.empty()) {
    splitter_.feed(chunk.bytes, chunk.time_s, 10.0 / transport_.baud());
  }
  while (const auto line = splitter_.next()) take_line(*line);
}

void Mark10Stream::take_line(const ReceivedLine& line) {
  if (trimmed(line.text).empty() || is_other_line(line)) return;
  const auto reading = parse_mark10_reading(line.text, declared_unit_);
  if (reading && !reading->error.empty() && !is_connected_) {
    refusal_ = shown_bytes(reading->error);
    return;
  }
  if (!is_streaming_) return;
  const bool is_good =
      reading && reading->error.empty() && (reading->unit != unit_ || shape_.fits(line.text));
  if (!is_good) {
    if (is_connected_) take_text(line);
    return;
  }
  if (!is_connected_) {
    last_arrival_s_ = line.time_s;
    is_connected_ = true;
    return;  // the first line may be the second half of one
  }
  if (!accept({{}, reading->unit, line.text}, line.time_s)) return;
  LoadSample sample;
  sample.force_N = reading->force_N;
  hand_out_at(sample, line.time_s);
}

void Mark10Stream::forget() {
  shape_ = LineShape();
}

}  // namespace viscard
