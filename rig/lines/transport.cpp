#include "rig/lines/transport.h"

#include <poll.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace viscard {

void wait_readable(const std::vector<const Transport*>& transports, const RigClock& clock,
                   double timeout_s) {
  if (clock.waits()) return clock.pass(timeout_s);
  std::array<pollfd, 8> entries{};
  nfds_t n = 0;
  for (const Transport* transport : transports) {
    if (n < entries.size()) entries[n++] = {transport->descriptor(), POLLIN, 0};
  }
  timespec timeout{};
  if (timeout_s > 0.0) {
    timeout.tv_sec = static_cast<time_t>(timeout_s);
    timeout.tv_nsec = static_cast<long>((timeout_s - std::floor(timeout_s)) * 1e9);
  }
  clock.expect_wait(std::max(0.0, timeout_s));
  ppoll(entries.data(), n, &timeout, nullptr);
}

}  // namespace viscard
