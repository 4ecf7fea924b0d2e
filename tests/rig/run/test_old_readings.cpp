// Lines that carry less than the amplifier sends: the readings become older and older.
#include "rig/cells/arrival_clock.h"
#include "rig/cells/device_clock.h"
#include "rig/rig_check.h"
#include "rig/run/run_session.h"
#include "tests/rig/rig_fixture.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

constexpr double kPeriod_s = 0.0125;
constexpr double kTenth_N = 0.1 * 0.250 * 9.80665;  // of the cell

EmulatedRigOptions slow_rig(bool has_clock) {
  EmulatedRigOptions options = RigFixture::options();
  options.truth.surface_position_m = 0.06e-3;
  if (!has_clock) {
    options.config.load_cell.line_format = "counts";
    options.amplifier.format = AmplifierFormat::kReadingText;  // 22 bytes
  }
  return options;
}

LineFaults line_of(double bytes_per_s) {
  LineFaults faults;
  faults.cell.to_host_B_s = bytes_per_s;
  return faults;
}

bool is_at_rest_and_lifted(const RigFixture& rig) {
  const EmulatedOutcome bench = rig.emulated.outcome();
  return !bench.is_moving && bench.final_position_m < 0.06e-3;
}

// Simulates readings made every kPeriod_s that arrive `arrival_s` apart; the true and the measured
// lag of the last one.
template <class Take>
double true_lag_s(int n, double arrival_s, const Take& take) {
  double made_s = 0.0, host_s = 0.0;
  for (int i = 0; i < n; ++i) {
    made_s += kPeriod_s;
    host_s = std::max(made_s, host_s + arrival_s);
    take(made_s, host_s);
  }
  return host_s - made_s;
}

}  // namespace

TEST_CASE("a device's clock shows how far its line has fallen behind, for longer than its window",
          "[rig]") {
  DeviceClock clock(1e-6, 0.3);
  double made_s = 0.0, host_s = 0.0;
  const double lag_s = true_lag_s(8000, 1.14 * kPeriod_s, [&](double made, double host) {
    made_s = made;
    host_s = host;
    clock.take(made * 1e6, host, kPeriod_s);
  });
  CHECK(lag_s == Approx(14.0).epsilon(0.01));
  // 0.6 % of 100 s may be the clock's own error.
  CHECK(host_s - (clock.time_s() + clock.host_minus_device_s()) == Approx(lag_s).margin(0.7));
  CHECK(made_s == Approx(100.0).epsilon(1e-9));
}

TEST_CASE("a garbled time of a device's clock makes no later reading old", "[rig]") {
  DeviceClock clock(1e-6, 0.3);
  for (int i = 1; i <= 100; ++i) clock.take(i * kPeriod_s * 1e6, i * kPeriod_s, kPeriod_s);
  clock.take((101 * kPeriod_s + 0.4) * 1e6, 101 * kPeriod_s, kPeriod_s);
  clock.take(102 * kPeriod_s * 1e6, 102 * kPeriod_s, kPeriod_s);
  CHECK(clock.time_s() + clock.host_minus_device_s() == Approx(102 * kPeriod_s).margin(1e-3));
}

TEST_CASE("without a clock the number of readings shows how far their line has fallen behind",
          "[rig]") {
  ArrivalClock slowed(kPeriod_s);
  double host_s = 0.0;
  for (int i = 0; i < 400; ++i) slowed.take(1.0, host_s += 1.05 * kPeriod_s);
  CHECK(slowed.lag_s() == Approx(0.0).margin(0.01));  // a converter that is 5 % slow
  for (int i = 0; i < 100; ++i) slowed.take(1.0, host_s += 2.1 * kPeriod_s);
  CHECK(slowed.lag_s() == Approx(100 * 1.05 * kPeriod_s).epsilon(0.1));
  ArrivalClock from_the_beginning(kPeriod_s);
  host_s = 0.0;
  for (int i = 0; i < 1000; ++i) from_the_beginning.take(1.0, host_s += 1.3 * kPeriod_s);
  CHECK(from_the_beginning.lag_s() > 1.5);  // slower than any converter: 0.2 of 12 s
  ArrivalClock bursty(kPeriod_s);
  for (int i = 0; i < 1000; ++i) bursty.take(1.0, kPeriod_s * (i - i % 4 + 4));
  CHECK(bursty.lag_s() < 5 * kPeriod_s);
}

TEST_CASE("a lagging line never lets an approach press the cell", "[rig][pty]") {
  const bool has_clock = GENERATE(true, false);
  // As much slower than 80 lines/s as 960 bytes/s are than 1.1 kB/s.
  RigFixture rig(slow_rig(has_clock), line_of(has_clock ? 960.0 : 1500.0));
  TestPlan plan = short_plan();
  plan.approach_speed_m_s = 0.1e-3;
  plan.baseline_s = 10.0;
  const RunOutcome outcome = rig.run(plan);
  INFO(outcome.reason);
  CHECK(outcome.status == "interrupted");
  CHECK_THAT(outcome.reason, Contains(" s old ") && Contains("viscard rig check"));
  CHECK(rig.emulated.outcome().peak_force_N < plan.contact_force_N + kTenth_N);
  CHECK(is_at_rest_and_lifted(rig));
}

TEST_CASE("a line that slows down in the approach ends it at the deadline of a reading",
          "[rig][pty]") {
  const bool has_clock = GENERATE(true, false);
  EmulatedRigOptions options = slow_rig(has_clock);
  options.truth.surface_position_m = 0.2e-3;
  RigFixture rig(options, line_of(0.0));
  when_phase(rig, "approach", [&rig] { rig.cell_proxy->slow_to(300.0); });
  TestPlan plan = short_plan();
  plan.approach_speed_m_s = 0.1e-3;
  const RunOutcome outcome = rig.run(plan);
  INFO(outcome.reason);
  CHECK(outcome.status == "interrupted");
  CHECK_THAT(outcome.reason, Contains(" s old "));
  CHECK(rig.emulated.outcome().peak_force_N < plan.contact_force_N + kTenth_N);
}

TEST_CASE("a link that slows down in the ramp never lets it press beyond its limit", "[rig][pty]") {
  const bool has_clock = GENERATE(true, false);
  const double stiffer = GENERATE(1.0, 2.4);  // than guessed
  EmulatedRigOptions options = slow_rig(has_clock);
  options.truth.material.E0_Pa = 0.9e6 * stiffer;
  options.config.safety.warn_fraction = 0.35;
  options.config.safety.soft_fraction = 1.0 / (0.250 * 9.80665);  // 1 N
  options.config.safety.hard_fraction = 1.0;
  RigFixture rig(options, line_of(0.0));
  when_phase(rig, "ramp", [&rig] { rig.cell_proxy->slow_to(600.0); });
  TestPlan plan = short_plan();
  Specimen specimen = demo_specimen(10.0);
  specimen.modulus_guess_Pa = 0.9e6;
  const RunOutcome outcome = rig.run(plan, specimen);
  INFO(outcome.reason);
  CHECK(outcome.status != "finished");
  CHECK(rig.has_event("phase", "ramp"));
  CHECK(rig.emulated.outcome().peak_force_N < 1.0 + kTenth_N);
  CHECK(is_at_rest_and_lifted(rig));
  CHECK_THAT(outcome.reason, !Contains("DOES NOT FALL"));
}

TEST_CASE("readings too rare for a move are used in steps", "[rig][pty]") {
  RigFixture rig(RigFixture::options());
  RunControl control;
  control.clock = &rig.clock;
  RunSession session(rig.stage, rig.load_cell, rig.config, rig.sink, control);
  session.connect();
  session.tare(0.3);
  session.expect_stiffness(1e6);
  session.move(0.1e-3, 0.5e-3, "test", 0.01);  // 500 N/s: a period brings 6 N
  std::vector<double> ends_s;
  for (const CommandedMove& move : rig.all<CommandedMove>()) {
    CHECK(std::abs(move.move.to_m - move.move.from_m) < 26e-6);
    ends_s.push_back(move.move.start_time_s + duration_s(move.move));
  }
  REQUIRE(ends_s.size() == 4);
  CHECK(session.stage().position_m() == Approx(0.1e-3).margin(1e-6));
  for (std::size_t i = 1; i < ends_s.size(); ++i) {
    const auto moves = rig.all<CommandedMove>();
    const auto samples = rig.all<LoadSample>();
    CHECK(std::any_of(samples.begin(), samples.end(), [&](const LoadSample& sample) {
      const double made_s = rig.load_cell.made_at_s(sample);
      return made_s > ends_s[i - 1] && sample.host_time_s < moves[i].move.start_time_s + 0.02;
    }));
  }
}

TEST_CASE(
    "a rig check refuses a line that carries less than is sent, and names the rate that would do",
    "[rig][pty]") {
  const auto advice_of = [](RigFixture& rig) {
    const RigCheck check = check_rig(rig.stage, rig.load_cell, rig.config, rig.clock, 4.0);
    CHECK_FALSE(check.is_usable);
    std::string all;
    for (const std::string& text : check.advice) all += text + "\n";
    return all;
  };
  SECTION("by the clock of the device") {
    RigFixture rig(slow_rig(true), line_of(960.0));
    CHECK_THAT(advice_of(rig), Contains("fall behind by 0.") && Contains("19200 baud"));
  }
  SECTION("by the number of its readings") {
    RigFixture rig(slow_rig(false), line_of(1500.0));
    CHECK_THAT(advice_of(rig), Contains("expected_rate") && Contains("38400 baud"));
  }
  SECTION("by the baud rate of the rig file") {
    RigFixture rig(slow_rig(true));
    rig.config.load_cell.baud = 9600;  // a pseudo-terminal carries any rate
    CHECK_THAT(advice_of(rig), Contains("9600 baud carry 960") && Contains("to 19200 baud"));
  }
}

}  // namespace viscard
