// Any bytes from a controller are understood, ignored, or refused by one RigError: by every parser on
// every line, and by the driver in the middle of a move. The first byte sets the size of the pieces
// in which they arrive.
#include "rig/lines/rig_error.h"
#include "rig/stages/grbl_stage.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

namespace {

using namespace viscard;

class FuzzedPort final : public Transport {
 public:
  std::string name() const override { return "fuzz"; }
  int baud() const override { return 115200; }
  int descriptor() const override { return -1; }
  Chunk read_available() override {
    Chunk chunk{0.0, std::string(left.substr(0, piece))};
    left.remove_prefix(chunk.bytes.size());
    return chunk;
  }
  void write(std::string_view bytes, double) override { n_written += bytes.size(); }

  std::string_view left;
  std::size_t piece = 1;
  std::size_t n_written = 0;
};

void parse_every_line(std::string_view text) {
  LineSplitter splitter;
  splitter.feed(text, 0.0);
  while (const auto line = splitter.next()) {
    (void)parse_grbl_error(line->text);
    (void)parse_grbl_alarm(line->text);
    (void)parse_grbl_welcome(line->text);
    (void)parse_grbl_setting(line->text);
    (void)parse_grbl_message(line->text);
    (void)is_grbl_push(line->text);
    const auto status = parse_grbl_status(line->text);
    if (!status) continue;
    for (const double mm : status->machine_mm) {
      if (!std::isfinite(mm)) std::abort();
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  parse_every_line(text);
  FuzzedPort port;
  static constexpr std::string_view kStart =
      "Grbl 1.1h ['$' for help]\r\n<Idle|MPos:0.000,0.000,0.000>\r\n"
      "$102=3200.000\r\n$112=600.000\r\n$122=200.000\r\nok\r\n";
  const RigClock clock;
  GrblStage stage(port, StageConfig{}, clock, [](const RunRecord&) {});
  port.left = kStart;
  port.piece = kStart.size();
  try {
    stage.service();
  } catch (const RigError&) {
    std::abort();
  }
  port.left = text;
  port.piece = 1u + data[0];
  bool has_moved = false;
  while (!port.left.empty()) {
    try {
      if (!has_moved) stage.begin_move(0.1e-3, 1e-3, "fuzz");
      has_moved = true;
      stage.service();
    } catch (const RigError&) {
    } catch (const std::invalid_argument&) {  // these settings make no valid move
      return 0;
    }
    if (!std::isfinite(stage.position_m())) std::abort();
  }
  return 0;
}
