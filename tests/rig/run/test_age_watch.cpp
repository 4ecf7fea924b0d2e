#include "rig/run/age_watch.h"

#include <catch2/catch.hpp>

namespace viscard {
namespace {

constexpr double kPeriod_s = 0.0125;
constexpr double kCapacity_N = 2.0;  // of which 5 % may be pressed beyond a limit unseen: 0.1 N

// Readings of a force that grows by rate_N_s and ends at force_N.
AgeWatch watch_at(double force_N, double rate_N_s, double least_s = 0.0) {
  AgeWatch watch(kCapacity_N, least_s);
  for (int i = 9; i >= 0; --i) watch.take(force_N - rate_N_s * i * kPeriod_s, 1.0 - i * kPeriod_s);
  return watch;
}

}  // namespace

TEST_CASE("the age allowed is the force left over its rate, at most 0.25 s", "[rig]") {
  AgeWatch watch = watch_at(0.6, 0.0);
  watch.begin_move(1.0, 4.0);  // stiffness times speed
  CHECK(watch.allowed_s(kPeriod_s) == Approx(0.5 / 4.0).epsilon(1e-9));
  watch.begin_move(1.0, 0.1);
  CHECK(watch.allowed_s(kPeriod_s) == Approx(0.25).epsilon(1e-12));
  watch.begin_move(1.0, 0.0);  // a rig of unknown stiffness
  CHECK(watch.allowed_s(kPeriod_s) == Approx(0.25).epsilon(1e-12));
}

TEST_CASE("a force that grows faster than assumed shortens the age allowed", "[rig]") {
  AgeWatch watch = watch_at(0.6, 5.0);
  watch.begin_move(1.0, 1.0);
  // The medians of three readings lag by one period.
  CHECK(watch.allowed_s(kPeriod_s) == Approx((0.5 + 5.0 * kPeriod_s) / 5.0).epsilon(1e-9));
}

TEST_CASE("one garbled reading does not change the age allowed by much", "[rig]") {
  AgeWatch watch = watch_at(0.2, 0.0);
  watch.begin_move(1.0, 4.0);
  const double allowed_s = watch.allowed_s(kPeriod_s);
  watch.take(1.9, 1.0 + kPeriod_s);
  CHECK(watch.allowed_s(kPeriod_s) == Approx(allowed_s).epsilon(1e-9));
}

TEST_CASE("no age is asked for that a reading cannot have", "[rig]") {
  AgeWatch watch = watch_at(1.2, 0.0);
  watch.begin_move(1.0, 4.0);
  CHECK(watch.allowed_s(kPeriod_s) == Approx(2 * kPeriod_s + 0.025).epsilon(1e-9));
  AgeWatch emulated = watch_at(1.2, 0.0, 2.0);
  emulated.begin_move(1.0, 4.0);
  CHECK(emulated.allowed_s(kPeriod_s) == Approx(2.0).epsilon(1e-12));
}

TEST_CASE("readings rarer than the force allows are used in steps", "[rig]") {
  AgeWatch watch = watch_at(0.0, 0.0);
  watch.begin_move(1.0, 20.0);  // 1.1 N in 55 ms
  CHECK_FALSE(watch.needs_steps(0.050));
  CHECK(watch.needs_steps(0.060));
  watch.begin_move(1.0, 0.0);
  CHECK_FALSE(watch.needs_steps(0.24));
  CHECK(watch.needs_steps(0.26));
}

}  // namespace viscard
