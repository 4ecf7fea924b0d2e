#include "rig/cells/frame_load_cell.h"

#include "rig/lines/rig_error.h"
#include "rig/lines/who_answers.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

constexpr double kFirstFrame_wall_s = 15.0;  // banner and calibration of a board last up to 10 s
constexpr int kFramesToConnect = 6;
constexpr double kTextShare = 0.9;  // of printable bytes in a banner

FrameFormat format_from(const LoadCellConfig& config) {
  try {
    return FrameFormat(config.frame);
  } catch (const std::invalid_argument& error) {
    throw RigError(error.what());
  }
}

// A board's banner is text; the rest of a garbled frame is not.
bool is_text(const std::string& bytes) {
  const auto n = std::count_if(bytes.begin(), bytes.end(), [](unsigned char c) {
    return std::isprint(c) != 0 || std::isspace(c) != 0;
  });
  return static_cast<double>(n) >= kTextShare * static_cast<double>(bytes.size());
}

}  // namespace

void check_frame_words(const LoadCellConfig& config) {
  format_from(config);
}

FrameLoadCell::FrameLoadCell(Transport& transport, const LoadCellConfig& config,
                             const RigClock& clock, RecordSink sink)
    : StreamLoadCell(transport, config, clock, std::move(sink)),
      description_(config.frame),
      format_(format_from(config)),
      frames_(format_) {}

void FrameLoadCell::connect(const Pump& pump) {
  if (await_readings(pump, kFirstFrame_wall_s, false)) return;
  const std::string known = who_answers({frames_.skipped()});
  throw RigError(
      "no frame of '" + description_ + "' is in the bytes that came on '" + transport_.name() +
      "'; the newest are '" + shown_bytes(frames_.skipped()) + "'. " +
      (known.empty() ? "Check frame and baud under [load_cell] of the rig file" : known));
}

void FrameLoadCell::service() {
  const Chunk chunk = receive();
  if (!chunk.bytes.empty()) {
    frames_.feed(chunk.bytes, chunk.time_s, 10.0 / transport_.baud());
  }
  while (const auto received = frames_.next()) take_frame(*received);
}

void FrameLoadCell::take_frame(const ReceivedFrame& received) {
  const FrameFormat::Frame& frame = received.frame;
  if (!is_connected_) {
    if (++n_good_ < kFramesToConnect) return;
    if (format_.tick_s() > 0.0) start_clock(format_.tick_s(), frame.ticks, received.time_s);
    last_arrival_s_ = received.time_s;
    last_seq_ = frame.seq;
    is_connected_ = true;
    return;
  }
  if (!received.skipped.empty()) take_skipped(received);
  if (!is_connected_) return;  // the board has restarted
  const auto n_lost = frames_lost(frame);
  if (n_lost && *n_lost < 0) {
    ++counts_.duplicate;
    return;
  }
  if (!accept({frame.ticks, "", "", n_lost}, received.time_s)) return;
  LoadSample sample;
  sample.counts = frame.counts;
  sample.is_saturated = frame.counts >= format_.highest() || frame.counts <= format_.lowest();
  hand_out_at(sample, received.time_s);
}

void FrameLoadCell::take_skipped(const ReceivedFrame& received) {
  if (is_text(received.skipped)) {
    take_text({received.skipped, received.time_s});
  } else {
    note_unreadable(received.skipped, received.time_s);
  }
}

// Frames between the newest one and this one, by their numbers; -1 for the same frame again, nothing
// without numbers.
std::optional<std::int64_t> FrameLoadCell::frames_lost(const FrameFormat::Frame& frame) {
  if (!frame.seq) return std::nullopt;
  const auto before = std::exchange(last_seq_, frame.seq);
  if (!before) return std::nullopt;
  return static_cast<std::int64_t>(format_.seq_step(*before, *frame.seq)) - 1;
}

void FrameLoadCell::forget() {
  n_good_ = 0;
  last_seq_.reset();
}

}  // namespace viscard
