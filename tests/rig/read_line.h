#pragma once

#include "rig/lines/line_splitter.h"
#include "rig/lines/rig_clock.h"
#include "rig/lines/transport.h"

#include <optional>

namespace viscard {

// Waits up to timeout_s of wall time for one whole line; further bytes stay in the splitter for the
// next call. Returns nothing when the time is over. Throws PortHungUp.
inline std::optional<ReceivedLine> read_line(Transport& transport, LineSplitter& splitter,
                                             double timeout_s) {
  const RigClock clock;
  const double deadline_s = monotonic_s() + timeout_s;
  while (true) {
    if (auto line = splitter.next()) return line;
    const double left_s = deadline_s - monotonic_s();
    if (left_s <= 0.0) return std::nullopt;
    wait_readable({&transport}, clock, left_s);
    const Chunk chunk = transport.read_available();
    splitter.feed(chunk.bytes, chunk.time_s, 10.0 / transport.baud());
  }
}

}  // namespace viscard
