// The system clock steps (network time, daylight saving, a flat battery) during a run. This program
// replaces that clock by one that it can set; the monotonic clock is the real one.
#include "tests/rig/rig_fixture.h"

#include <catch2/catch.hpp>
#include <sys/syscall.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

#include <atomic>
#include <chrono>

namespace {
std::atomic<long> step_s{0};
}

extern "C" int clock_gettime(clockid_t clock, timespec* now) noexcept {
  const long failed = syscall(SYS_clock_gettime, clock, now);
  if (failed == 0 && clock == CLOCK_REALTIME) now->tv_sec += step_s;
  return static_cast<int>(failed);
}

namespace viscard {

TEST_CASE("a step of the system clock during a run changes no time stamp and loses nothing",
          "[rig][pty]") {
  const auto before = std::chrono::system_clock::now();
  step_s = 5000;
  REQUIRE(std::chrono::system_clock::now() - before >
          std::chrono::seconds(4000));  // the replaced clock
  RigFixture rig(RigFixture::on_wall_clock(20.0));
  rig.sink = [&rig](const RunRecord& record) {
    rig.records.push_back(record);
    const auto* event = std::get_if<RunEvent>(&record);
    if (event == nullptr || event->name != "phase") return;
    if (event->value == "ramp") step_s = -86400;
    if (event->value == "hold") step_s = 3600;
  };
  const RunOutcome outcome = rig.run(short_plan());
  INFO(outcome.reason);
  REQUIRE(outcome.status == "finished");
  CHECK(outcome.stream.missing == 0);
  double last_s = 0.0;
  for (const LoadSample& sample : rig.all<LoadSample>()) {
    REQUIRE(sample.host_time_s >= last_s);
    REQUIRE(sample.host_time_s < 120.0);
    last_s = sample.host_time_s;
  }
}

}  // namespace viscard
