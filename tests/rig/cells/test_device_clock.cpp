#include "rig/cells/device_clock.h"

#include <catch2/catch.hpp>

namespace viscard {
namespace {

using Verdict = DeviceClock::Verdict;
constexpr double kPeriod_s = 0.0125;

}  // namespace

TEST_CASE("the time of a 32-bit counter grows beyond its wrap", "[rig]") {
  DeviceClock clock(1e-6, 0.3);
  REQUIRE(clock.take(4294960000.0, 1.0, kPeriod_s) == Verdict::kGood);
  const double before_s = clock.time_s();
  REQUIRE(clock.take(5204.0, 1.0125, kPeriod_s) == Verdict::kGood);
  CHECK(clock.time_s() - before_s == Approx(0.0125).margin(1e-9));  // microsecond ticks, exact sums
}

TEST_CASE("the same device time twice is a duplicate", "[rig]") {
  DeviceClock clock(1e-6, 0.3);
  clock.take(1000.0, 0.0, kPeriod_s);
  CHECK(clock.take(1000.0, 0.0125, kPeriod_s) == Verdict::kDuplicate);
}

TEST_CASE("one garbled time is left out, but a second one that agrees with it is a restart",
          "[rig]") {
  DeviceClock clock(1e-6, 0.3);
  clock.take(5000000.0, 0.0, kPeriod_s);
  CHECK(clock.take(501250.0, 0.0125, kPeriod_s) == Verdict::kSuspect);  // a digit lost
  CHECK(clock.take(5025000.0, 0.025, kPeriod_s) == Verdict::kGood);
  CHECK(clock.take(12500.0, 0.5, kPeriod_s) == Verdict::kSuspect);
  CHECK(clock.take(25000.0, 0.5125, kPeriod_s) == Verdict::kRestarted);
}

TEST_CASE("a gap that the host has seen too is no restart, however long", "[rig]") {
  DeviceClock clock(1e-3, 0.3);
  clock.take(1000.0, 0.0, kPeriod_s);
  CHECK(clock.take(61000.0, 60.0, kPeriod_s) == Verdict::kGood);
  CHECK(clock.step_s() == Approx(60.0).margin(1e-9));
}

TEST_CASE("the offset between the clocks is the smallest one seen", "[rig]") {
  DeviceClock clock(1e-6, 0.3);
  const double delays_s[] = {0.012, 0.003, 0.050, 0.007};
  for (int i = 0; i < 4; ++i) {
    const double device_s = 1.0 + kPeriod_s * i;
    clock.take(device_s * 1e6, 100.0 + device_s + delays_s[i], kPeriod_s);
  }
  CHECK(clock.host_minus_device_s() == Approx(100.003).margin(1e-9));
}

TEST_CASE("a time garbled forward is found by the next reading", "[rig]") {
  DeviceClock clock(1e-6, 0.3);
  const auto take = [&](double ticks, int n) {
    return clock.take(ticks, n * kPeriod_s, kPeriod_s);
  };
  for (int i = 0; i < 5; ++i) REQUIRE(take(1e6 + 12500.0 * i, i) == Verdict::kGood);
  const double before_s = clock.time_s();
  REQUIRE(take(1e6 + 12500.0 * 5 + 200000.0, 5) == Verdict::kGood);  // not detected yet
  CHECK(take(1e6 + 12500.0 * 6, 6) == Verdict::kLastWasBad);
  CHECK(clock.time_s() - before_s == Approx(2 * kPeriod_s).margin(1e-9));
  CHECK(take(1e6 + 12500.0 * 7, 7) == Verdict::kGood);
}

TEST_CASE("a part of the stream received twice is duplicates, not a restart", "[rig]") {
  DeviceClock clock(1e-6, 0.3);
  for (int i = 0; i < 20; ++i) clock.take(1e6 + 12500.0 * i, i * kPeriod_s, kPeriod_s);
  for (int i = 10; i < 20; ++i) {
    CHECK(clock.take(1e6 + 12500.0 * i, 20 * kPeriod_s, kPeriod_s) == Verdict::kDuplicate);
  }
  CHECK(clock.take(1e6 + 12500.0 * 20, 20.5 * kPeriod_s, kPeriod_s) == Verdict::kGood);
}

}  // namespace viscard
