// Any bytes from an amplifier are readings, noted, or refused by one RigError. The first byte chooses
// the format and the size of the pieces in which the rest arrives.
#include "rig/cells/hx711_load_cell.h"
#include "rig/lines/rig_error.h"

#include <array>
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
    now_s += 0.01;
    Chunk chunk{now_s, std::string(left.substr(0, piece))};
    left.remove_prefix(chunk.bytes.size());
    return chunk;
  }
  void write(std::string_view, double) override {}

  std::string_view left;
  std::size_t piece = 1;
  double now_s = 0.0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  static constexpr std::array<const char*, 5> kFormats{"auto", "counts", "micros,counts",
                                                       "millis,counts", "volts"};
  FuzzedPort port;
  port.left = std::string_view(reinterpret_cast<const char*>(data) + 1, size - 1);
  port.piece = 1u + data[0] / kFormats.size();
  LoadCellConfig config;
  config.line_format = kFormats[data[0] % kFormats.size()];
  const RigClock clock;
  std::int64_t next = 0;
  Hx711LoadCell cell(port, config, clock, [&next](const RunRecord& record) {
    const auto* sample = std::get_if<LoadSample>(&record);
    if (sample == nullptr) return;
    if (sample->index != next++) std::abort();
    for (const auto& value : {sample->counts, sample->volts, sample->device_time_s}) {
      if (value && !std::isfinite(*value)) std::abort();
    }
  });
  while (!port.left.empty()) {
    try {
      cell.service();
    } catch (const RigError&) {
    }
  }
  const StreamCounts& counts = cell.counts();
  if (counts.received != next || counts.missing < 0 || !(cell.period_s() > 0.0)) std::abort();
  return 0;
}
