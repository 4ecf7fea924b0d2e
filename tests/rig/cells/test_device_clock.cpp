#include "rig/cells/device_clock.h"
#include "rig/stages/move_tracker.h"

#include <catch2/catch.hpp>

namespace viscard {
namespace {

using Verdict = DeviceClock::Verdict;
constexpr double kPeriod_s = 0.0125;

}  // namespace

TEST_CASE("A 32-bit counter that wraps goes on growing", "[rig]") {
  DeviceClock clock(1e-6, 0.3);
  REQUIRE(clock.take(4294960000.0, 1.0, kPeriod_s) == Verdict::kGood);
  const double before_s = clock.time_s();
  REQUIRE(clock.take(5204.0, 1.0125, kPeriod_s) == Verdict::kGood);
  CHECK(clock.time_s() - before_s == Approx(0.0125).margin(1e-9));  // microsecond ticks, exact sums
}

TEST_CASE("The same device time twice is a duplicate", "[rig]") {
  DeviceClock clock(1e-6, 0.3);
  clock.take(1000.0, 0.0, kPeriod_s);
  CHECK(clock.take(1000.0, 0.0125, kPeriod_s) == Verdict::kDuplicate);
}

TEST_CASE("One garbled clock is left out, a second that agrees with it is a restart", "[rig]") {
  DeviceClock clock(1e-6, 0.3);
  clock.take(5000000.0, 0.0, kPeriod_s);
  CHECK(clock.take(501250.0, 0.0125, kPeriod_s) == Verdict::kSuspect);  // a digit lost
  CHECK(clock.take(5025000.0, 0.025, kPeriod_s) == Verdict::kGood);
  CHECK(clock.take(12500.0, 0.5, kPeriod_s) == Verdict::kSuspect);
  CHECK(clock.take(25000.0, 0.5125, kPeriod_s) == Verdict::kRestarted);
}

TEST_CASE("A gap that the host saw too is no restart, however long", "[rig]") {
  DeviceClock clock(1e-3, 0.3);
  clock.take(1000.0, 0.0, kPeriod_s);
  CHECK(clock.take(61000.0, 60.0, kPeriod_s) == Verdict::kGood);
  CHECK(clock.step_s() == Approx(60.0).margin(1e-9));
}

TEST_CASE("The delay between the clocks is the smallest one seen", "[rig]") {
  DeviceClock clock(1e-6, 0.3);
  const double delays_s[] = {0.012, 0.003, 0.050, 0.007};
  for (int i = 0; i < 4; ++i) {
    const double device_s = 1.0 + kPeriod_s * i;
    clock.take(device_s * 1e6, 100.0 + device_s + delays_s[i], kPeriod_s);
  }
  CHECK(clock.host_minus_device_s() == Approx(100.003).margin(1e-9));
}

TEST_CASE("Position reports narrow down when a move began", "[rig]") {
  // Written at 10 s, answered at 10.3 s, truly begun at 10.05 s.
  const StageMove move{10.0, 0.0, 1e-3, 0.5e-3, 0.2};
  StageMove truth = move;
  truth.start_time_s = 10.05;
  MoveTracker tracker(move, 0.8e-6);
  tracker.acknowledged(10.3);
  for (int i = 0; i < 20; ++i) {
    const double asked_s = 10.06 + 0.1 * i;
    tracker.reported(asked_s, asked_s + 0.008, position_m(truth, asked_s + 0.004));
  }
  const CommandedMove best = tracker.best(1e-3);
  CHECK(best.move.start_time_s <= 10.05);
  CHECK(best.move.start_time_s + best.start_uncertainty_s >= 10.05);
  // 8 ms between question and answer, and 2 x .8 um at .5 mm/s.
  CHECK(best.start_uncertainty_s <= 0.008 + 2 * 0.8e-6 / 0.5e-3 + 1e-6);
}

TEST_CASE("A report that contradicts the others does not move the start", "[rig]") {
  const StageMove move{0.0, 0.0, 1e-3, 0.5e-3, 0.2};
  MoveTracker tracker(move, 0.8e-6);
  tracker.acknowledged(0.01);
  tracker.reported(1.0, 1.01, 0.0);  // a late answer: it cannot still stand at the start
  const CommandedMove best = tracker.best(1e-3);
  CHECK(best.move.start_time_s == 0.0);
  CHECK(best.start_uncertainty_s == Approx(0.02).margin(1e-12));
}

}  // namespace viscard
