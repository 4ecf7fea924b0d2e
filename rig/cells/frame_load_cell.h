#pragma once

#include "rig/cells/stream_load_cell.h"
#include "rig/protocols/binary_frame.h"

#include <cstdint>
#include <optional>

namespace viscard {

// A converter whose board sends binary frames. The rig file describes them (load_cell.frame;
// rig/protocols/binary_frame.h has the fields and its sources). A frame that fails its check is left
// out and counted as unreadable; with seq the frames that are lost are known exactly.
class FrameLoadCell final : public StreamLoadCell {
 public:
  // Throws RigError on a description that is wrong.
  FrameLoadCell(Transport& transport, const LoadCellConfig& config, const RigClock& clock,
                RecordSink sink);

  void connect(const Pump& pump) override;
  void service() override;
  std::string reads_as() const override { return "counts"; }
  std::string line_format() const override { return "frames of " + description_; }
  bool has_check() const override { return format_.has_check(); }
  std::size_t n_bytes() const override { return frames_.n_bytes(); }

 private:
  void take_frame(const ReceivedFrame& received);
  void take_skipped(const ReceivedFrame& received);
  std::optional<std::int64_t> frames_lost(const FrameFormat::Frame& frame);
  void forget() override;

  std::string description_;
  FrameFormat format_;
  FrameSplitter frames_;
  int n_good_ = 0;  // before the connection
  std::optional<std::uint32_t> last_seq_;
};

// Throws RigError if the description of the frame is wrong.
void check_frame_words(const LoadCellConfig& config);

}  // namespace viscard
