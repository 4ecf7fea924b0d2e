#include "rig/run/force_guard.h"

#include <catch2/catch.hpp>

namespace viscard {
namespace {

constexpr double kPeriod_s = 0.0125;

ForceGuard guard_of_1_N() {
  return ForceGuard(SafetyConfig{}, 1.0);
}

}  // namespace

TEST_CASE("the force guard warns once, then stops gently, then at once", "[rig]") {
  ForceGuard guard = guard_of_1_N();
  CHECK(guard.take(0.69, false, 0.0, kPeriod_s) == GuardAction::kNone);
  CHECK(guard.take(0.71, false, 0.1, kPeriod_s) == GuardAction::kWarn);
  CHECK(guard.take(0.72, false, 0.2, kPeriod_s) == GuardAction::kNone);
  CHECK(guard.take(0.81, false, 0.3, kPeriod_s) == GuardAction::kSoftStop);
  CHECK(guard.take(0.96, false, 0.4, kPeriod_s) == GuardAction::kHardStop);
}

TEST_CASE("one reading above the hard limit is enough, and tension counts too", "[rig]") {
  ForceGuard push = guard_of_1_N();
  CHECK(push.take(0.951, false, 0.0, kPeriod_s) == GuardAction::kHardStop);
  ForceGuard pull = guard_of_1_N();
  CHECK(pull.take(-0.951, false, 0.0, kPeriod_s) == GuardAction::kHardStop);
}

TEST_CASE("a force that still rises two readings after the gentle stop is stopped at once",
          "[rig]") {
  ForceGuard guard = guard_of_1_N();
  REQUIRE(guard.take(0.81, false, 0.0, kPeriod_s) == GuardAction::kSoftStop);
  CHECK(guard.take(0.83, false, 0.0125, kPeriod_s) == GuardAction::kNone);
  CHECK(guard.take(0.85, false, 0.025, kPeriod_s) == GuardAction::kHardStop);
  ForceGuard steady = guard_of_1_N();
  REQUIRE(steady.take(0.81, false, 0.0, kPeriod_s) == GuardAction::kSoftStop);
  for (int i = 1; i < 20; ++i) {
    CHECK(steady.take(0.812, false, i * kPeriod_s, kPeriod_s) == GuardAction::kNone);
  }
}

TEST_CASE("at rest one reading above a limit waits for the next", "[rig]") {
  const double garbled_N = GENERATE(0.9, 8.0);  // above the soft, above the hard limit
  ForceGuard guard = guard_of_1_N();
  double time_s = 0.0;
  const auto take = [&](double force_N) {
    return guard.take(force_N, false, time_s += kPeriod_s, kPeriod_s, false);
  };
  for (int i = 0; i < 3; ++i) {
    CHECK(take(garbled_N) == GuardAction::kNone);
    CHECK(take(0.4) == GuardAction::kNone);
  }
  CHECK(take(0.99) == GuardAction::kNone);
  CHECK(take(0.99) == GuardAction::kHardStop);
  ForceGuard moving = guard_of_1_N();
  CHECK(moving.take(8.0, false, 0.0, kPeriod_s, true) == GuardAction::kHardStop);
}

TEST_CASE("a doubtful reading is forgiven only if the next one is good", "[rig]") {
  ForceGuard forgiven = guard_of_1_N();
  CHECK(forgiven.take(9.9, true, 0.0, kPeriod_s) == GuardAction::kNone);
  CHECK(forgiven.take(0.1, false, 0.0125, kPeriod_s) == GuardAction::kNone);
  CHECK(forgiven.silent_until(1.0) == GuardAction::kNone);
  ForceGuard twice = guard_of_1_N();
  twice.take(9.9, true, 0.0, kPeriod_s);
  CHECK(twice.take(9.9, true, 0.0125, kPeriod_s) == GuardAction::kHardStop);
  ForceGuard silent = guard_of_1_N();
  silent.take(9.9, true, 0.0, kPeriod_s);
  CHECK(silent.silent_until(0.02) == GuardAction::kNone);
  CHECK(silent.silent_until(0.03) == GuardAction::kHardStop);
}

}  // namespace viscard
