#include "rig/lines/host_lateness.h"

#include <catch2/catch.hpp>

namespace viscard {

TEST_CASE("a look at the clock is late by what the wait before it does not explain", "[rig]") {
  HostLateness host;
  host.look(100.0);
  host.expect_wait(0.005);
  host.look(100.006);
  CHECK(host.total_s() == 0.0);
  host.expect_wait(0.005);
  host.look(100.061);
  CHECK(host.total_s() == Approx(0.050).epsilon(1e-6));
  CHECK(host.n_long() ==
        0);  // a usual delay of a scheduler: no deadline ends by it, nothing is reported
  host.expect_wait(0.005);
  host.look(100.866);
  CHECK(host.total_s() == Approx(0.850).epsilon(1e-6));
  CHECK(host.n_long() == 1);
  CHECK(host.newest_long_s() == Approx(0.8).epsilon(1e-6));
  host.look(100.870);
  CHECK(host.recent_s(0.5) == Approx(0.8).epsilon(1e-6));
  for (int i = 0; i < 100; ++i) host.look(100.870 + 0.005 * i);
  CHECK(host.recent_s(0.4) == 0.0);
  CHECK(host.recent_s(2.0) == Approx(0.8).epsilon(1e-6));
}

}  // namespace viscard
