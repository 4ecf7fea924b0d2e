// Readings that arrive but do not measure, and what tells them from those of a converter.
#include "rig/emulator/demo_rig.h"
#include "rig/run/life_watch.h"
#include "rig/run/rest_findings.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

namespace viscard {
namespace {

using Catch::Matchers::Contains;
using Trouble = LifeWatch::Trouble;

constexpr double kPeriod_s = 0.0125;

// Readings of a converter at rest: normal noise, rounded to whole digits.
class Readings {
 public:
  Readings(unsigned seed, double noise, double offset = 13000.0)
      : random_(seed), normal_(offset, noise) {}
  double next() { return std::round(normal_(random_)); }
  double time_s() { return kPeriod_s * n_++; }

 private:
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
  int n_ = 0;
};

LifeWatch watching(Readings& readings, int n = 80) {
  LifeWatch watch;
  for (int i = 0; i < n; ++i) watch.take(readings.next(), readings.time_s());
  watch.begin_watch(true);
  return watch;
}

RestReadings rest_of(const LifeWatch& watch) {
  return {.force_N = 0.02, .noise_N = 0.5e-3, .rate_Hz = 80.0, .life = watch.signs()};
}

std::string first_finding(const RestReadings& seen, const RigConfig& rig = demo_rig()) {
  const auto found = findings_at_rest(seen, rig);
  return found.empty() ? "" : found.front().text;
}

}  // namespace

TEST_CASE("noise of any size above a third of a digit raises no alarm in a million readings",
          "[rig]") {
  const double noise = GENERATE(0.35, 0.6, 1.0, 3.0, 300.0);
  Readings readings(7, noise);
  LifeWatch watch = watching(readings);
  int n_alarms = 0;
  for (int i = 0; i < 200'000; ++i) {
    watch.take(readings.next(), readings.time_s());
    n_alarms += watch.judged(true, 0) == Trouble::kNone ? 0 : 1;
  }
  INFO(noise);
  CHECK(n_alarms == 0);
}

TEST_CASE("a frozen signal is noticed within eight readings where noise makes no two equal",
          "[rig]") {
  Readings readings(3, 300.0);
  LifeWatch watch = watching(readings);
  const double last = readings.next();
  int n = 0;
  while (watch.judged(false, 0) == Trouble::kNone && n < 100) {
    watch.take(last, readings.time_s());
    ++n;
  }
  CHECK(watch.judged(false, 0) == Trouble::kEqual);
  CHECK(n <= 9);
  CHECK(n > 4);
}

TEST_CASE("a coarse digit needs a longer stretch of equal readings before it counts as frozen",
          "[rig]") {
  Readings readings(3, 0.5);
  LifeWatch watch = watching(readings, 200);
  int n = 0;
  while (watch.judged(false, 0) == Trouble::kNone && n < 300) {
    watch.take(13000.0, readings.time_s());
    ++n;
  }
  CHECK(watch.judged(false, 0) == Trouble::kEqual);
  CHECK(n > 20);
  CHECK(n < 120);
}

TEST_CASE("noise that vanishes without standing still, or grows many times, is noticed", "[rig]") {
  Readings readings(5, 300.0), toggles(6, 0.6), wild(7, 6000.0);
  LifeWatch quiet = watching(readings);
  LifeWatch grown = quiet;
  for (int i = 0; i < 40; ++i) quiet.take(toggles.next(), readings.time_s());
  CHECK(quiet.judged(false, 0) == Trouble::kQuiet);
  for (int i = 0; i < 40; ++i) grown.take(wild.next(), 2.0 + kPeriod_s * i);
  CHECK(grown.judged(true, 0) == Trouble::kWild);
  CHECK(grown.judged(false, 0) == Trouble::kNone);  // moves bend the force too
}

TEST_CASE("a rate that jumps or drops is noticed from the device's clock", "[rig]") {
  Readings readings(5, 300.0);
  LifeWatch fast = watching(readings);
  LifeWatch slow = fast;
  for (int i = 1; i <= 40; ++i) {
    fast.take(readings.next(), 1.0 + kPeriod_s * i / 3.0);
    slow.take(readings.next(), 1.0 + 0.1 * i);
  }
  CHECK(fast.judged(false, 0) == Trouble::kFast);
  CHECK(slow.judged(false, 0) == Trouble::kSlow);
}

TEST_CASE("readings at rest that no converter makes are refused, each with its cause", "[rig]") {
  LifeWatch watch;
  SECTION("noise of a converter is accepted") {
    Readings readings(1, 300.0);
    watch = watching(readings);
    CHECK(first_finding(rest_of(watch)).empty());
    CHECK(is_proven_by_noise(rest_of(watch)));
  }
  SECTION("one number") {
    for (int i = 0; i < 80; ++i) watch.take(13021.0, kPeriod_s * i);
    CHECK_THAT(first_finding(rest_of(watch)), Contains("the same number") && Contains("frozen"));
  }
  SECTION("zeros") {
    for (int i = 0; i < 80; ++i) watch.take(0.0, kPeriod_s * i);
    CHECK_THAT(first_finding(rest_of(watch)), Contains("exactly 0"));
  }
  SECTION("zeros between readings") {
    Readings readings(1, 300.0);
    for (int i = 0; i < 80; ++i) watch.take(i % 3 == 0 ? 0.0 : readings.next(), kPeriod_s * i);
    CHECK_THAT(first_finding(rest_of(watch)), Contains("exactly 0"));
  }
  SECTION("the end of the range") {
    Readings readings(1, 300.0);
    for (int i = 0; i < 80; ++i)
      i % 4 == 0 ? watch.take_at_end() : watch.take(readings.next(), kPeriod_s * i);
    CHECK_THAT(first_finding(rest_of(watch)),
               Contains("end of the converter's range") && Contains("open"));
  }
  SECTION("each reading sent eight times") {
    Readings readings(1, 300.0);
    double value = 0.0;
    for (int i = 0; i < 160; ++i) {
      if (i % 8 == 0) value = readings.next();
      watch.take(value, kPeriod_s * i);
    }
    CHECK_THAT(first_finding(rest_of(watch)),
               Contains("repeats each reading") && Contains("/s are new ones"));
    CHECK_FALSE(is_proven_by_noise(rest_of(watch)));
  }
  SECTION("a tared gauge that shows 0 is not refused, but proves nothing") {
    RigConfig rig = demo_rig();
    rig.load_cell.driver = "sauter";
    rig.calibration.volts_per_newton = 1.0;
    for (int i = 0; i < 80; ++i) watch.take(0.0, kPeriod_s * i);
    CHECK(first_finding(rest_of(watch), rig).empty());
    CHECK_FALSE(is_proven_by_noise(rest_of(watch)));
  }
}

TEST_CASE("rate, noise, drift and force at rest have one list of limits", "[rig]") {
  Readings readings(1, 300.0);
  const RestReadings good = rest_of(watching(readings));
  RestReadings seen = good;
  SECTION("9 times too fast") {
    seen.rate_Hz = 720.0;
    CHECK_THAT(first_finding(seen), Contains("720.0 readings/s") && Contains("expected_rate"));
  }
  SECTION("a quarter too slow") {
    seen.rate_Hz = 60.0;
    CHECK_THAT(first_finding(seen), Contains("60.0 readings/s"));
  }
  SECTION("noise of 148 % of the capacity") {
    seen.noise_N = 1.48 * demo_rig().calibration.capacity_N;
    CHECK_THAT(first_finding(seen), Contains("148 % of the capacity"));
  }
  SECTION("a drift") {
    seen.drift = {0.05, 1e-3};
    CHECK_THAT(first_finding(seen), Contains("drifts by 50.0 mN/s"));
  }
  SECTION("12 % of the capacity") {
    seen.force_N = 0.12 * demo_rig().calibration.capacity_N;
    CHECK_THAT(first_finding(seen), Contains("before anything was touched"));
  }
  CHECK(first_finding(good).empty());
}

TEST_CASE("settings of an erased memory are no stage", "[rig]") {
  const StageDynamics good{3200e3, 0.2, 10e-3, 0.0};
  CHECK(findings_of_stage(good).empty());
  StageDynamics erased = good;
  erased.steps_per_m = 2147484e3;
  REQUIRE(findings_of_stage(erased).size() == 1);
  CHECK_THAT(findings_of_stage(erased)[0].text, Contains("2147484") && Contains("steps/mm"));
}

}  // namespace viscard
