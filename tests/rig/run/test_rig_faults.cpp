// Runs on a rig that is set up wrongly, and what they report.
#include "rig/open_devices.h"
#include "tests/rig/rig_fixture.h"

#include <catch2/catch.hpp>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

}  // namespace

TEST_CASE(
    "a load cell of the wrong sign stops the approach at the touch, and the reason names the key",
    "[rig][pty]") {
  RigFixture rig(RigFixture::options());
  rig.config.load_cell.compression_is_positive = false;
  const RunOutcome outcome = rig.run(short_plan());
  CHECK(outcome.status == "interrupted");
  CHECK_THAT(outcome.reason, Contains("compression_is_positive = true"));
  const EmulatedOutcome bench = rig.emulated.outcome();
  // Contact force 0.015 N, a jog of 25 um and 8.8 N/mm: far from the limit of 1.96 N.
  CHECK(bench.peak_force_N > 0.005);
  CHECK(bench.peak_force_N < 0.4);
  CHECK_FALSE(bench.is_moving);
  CHECK(bench.final_position_m < demo_truth(10.0, 7).surface_position_m);
}

TEST_CASE("readings far slower than in the rig file end the run before the approach",
          "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.truth.sample_rate_Hz = 10.0;
  options.config.load_cell.expected_rate_Hz = 80.0;
  RigFixture rig(options);
  TestPlan plan = short_plan();
  plan.baseline_s = 2.0;
  const RunOutcome outcome = rig.run(plan);
  CHECK(outcome.status == "interrupted");
  CHECK_THAT(outcome.reason,
             Contains("10.0 readings/s") && Contains("expected_rate in the rig file is 80.0 Hz"));
  CHECK(rig.has_event("phase", "tare"));
  CHECK_FALSE(rig.has_event("phase", "approach"));
  CHECK(rig.emulated.outcome().final_position_m == 0.0);
}

TEST_CASE("a punch that presses before the run is lifted, and the advice is not about the ramp",
          "[rig][pty]") {
  const bool is_beyond_limit = GENERATE(true, false);
  EmulatedRigOptions options = RigFixture::options();
  options.truth.surface_position_m = is_beyond_limit ? -0.48e-3 : -0.2e-3;
  options.truth.overload_N = 100.0;
  RigFixture rig(options);
  const RunOutcome outcome = rig.run(short_plan());
  INFO(outcome.reason);
  CHECK(outcome.status == (is_beyond_limit ? "stopped" : "interrupted"));
  CHECK_THAT(outcome.reason,
             Contains(is_beyond_limit ? "already pressing" : "before anything was touched"));
  CHECK_THAT(outcome.reason, Contains("lifted by 0.5"));
  CHECK_THAT(outcome.reason, !Contains("[ramp]") && !Contains("FALL") && !Contains("by hand"));
  CHECK(outcome.code == "pressing");
  CHECK(rig.emulated.outcome().final_position_m < -0.4e-3);
  CHECK_FALSE(rig.all<LoadSample>().empty());
}

TEST_CASE("a light press before the run is felt by a lift of 0.1 mm, and the punch is lifted",
          "[rig][pty]") {
  // 5.8 N/mm: 10 um press with 58 mN, 2.4 % of the capacity. That would be tared away.
  EmulatedRigOptions options = RigFixture::options();
  options.truth.surface_position_m = -10e-6;
  RigFixture rig(options);
  const RunOutcome outcome = rig.run(short_plan());
  INFO(outcome.reason);
  CHECK(outcome.status == "interrupted");
  CHECK_THAT(outcome.reason, Contains("already pressing") && Contains("lifted by 0.500 mm") &&
                                 Contains("--lift") && !Contains("FALL") &&
                                 !Contains("not lifted"));
  CHECK(rig.has_event("phase", "tare"));
  CHECK_FALSE(rig.has_event("phase", "approach"));
  CHECK(rig.emulated.outcome().final_position_m == Approx(-0.5e-3).margin(1e-6));
  CHECK(rig.emulated.outcome().peak_force_N < 0.08);
  CHECK_FALSE(outcome.has_begun);
}

TEST_CASE("with a lift at the start a run after a crash goes on from a free punch", "[rig][pty]") {
  // 0.3 mm press with 1.7 N: the force of a crashed hold, below the soft limit. 0.48 mm press with
  // more than the hard limit.
  const bool is_beyond_limit = GENERATE(true, false);
  const double surface_m = is_beyond_limit ? -0.48e-3 : -0.3e-3;
  EmulatedRigOptions options = RigFixture::options();
  options.truth.surface_position_m = surface_m;
  options.truth.overload_N = 100.0;
  RigFixture rig(options);
  rig.lifts_at_start = true;
  const RunOutcome outcome = rig.run(short_plan());
  INFO(outcome.reason);
  CHECK(outcome.status == "finished");
  CHECK(rig.has_event("doubt", "pressed_before"));
  REQUIRE(outcome.contact_position_m);
  CHECK(*outcome.contact_position_m == Approx(surface_m).margin(20e-6));
  CHECK(outcome.peak_force_N > 1.4);
}

TEST_CASE("what presses on the cell without the punch is named, and nothing is pressed",
          "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  RigFixture rig(options);
  rig.emulated.hang_weight(0.3);  // above 10 % of 2.45 N
  const RunOutcome outcome = rig.run(short_plan());
  INFO(outcome.reason);
  CHECK(outcome.status == "interrupted");
  CHECK_THAT(outcome.reason, Contains("does not fall") && Contains("zero_volts"));
  CHECK_FALSE(rig.has_event("phase", "approach"));
  CHECK(rig.emulated.outcome().peak_force_N == 0.0);
}

TEST_CASE("a stage that moves the wrong way is noticed by the lift before the tare", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.truth.surface_position_m = 30e-6;  // the wrong way: reached by the second jog
  RigFixture rig(options);
  RigConfig wrong = rig.config;
  wrong.stage.toward_specimen = -wrong.stage.toward_specimen;
  GrblStage stage(rig.stage_line, wrong.stage, rig.clock, rig.sink);
  const RunOutcome outcome = run_indentation(stage, rig.load_cell, wrong, short_plan(),
                                             demo_specimen(10.0), rig.sink, {.clock = &rig.clock});
  INFO(outcome.reason);
  CHECK(outcome.status == "interrupted");
  CHECK_THAT(outcome.reason, Contains("force rose") && Contains("toward_specimen = -1"));
  CHECK(rig.emulated.outcome().peak_force_N < 0.3);
  CHECK(rig.emulated.outcome().final_position_m == Approx(0.0).margin(2e-6));
}

TEST_CASE("a force that cannot be read after the lift is not reported as unchanged", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  RigFixture rig(options);
  when_phase(rig, "hold", [&rig] {
    rig.emulated.cause(Incident::kSilenceLoadCell);
    rig.stop = true;
  });
  const RunOutcome outcome = rig.run(short_plan());
  CHECK(outcome.status == "interrupted");
  CHECK_THAT(outcome.reason, Contains("cannot be seen") && !Contains("FALL"));
}

TEST_CASE("an amplifier without a clock that restarts in the hold ends the run", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.config.load_cell.line_format = "auto";
  options.amplifier.format = AmplifierFormat::kCounts;
  options.amplifier.boot_s = 0.8;  // after its banner
  RigFixture rig(options);
  when_phase(rig, "hold", [&rig] { rig.emulated.cause(Incident::kRestartLoadCell); });
  TestPlan plan = short_plan();
  plan.hold_s = 8.0;
  const RunOutcome outcome = rig.run(plan);
  CHECK(outcome.status == "interrupted");
  CHECK_THAT(outcome.reason, Contains("restarted") && Contains("HX711 ready"));
}

TEST_CASE("readings delayed by a stall are not counted as missing, even without a clock",
          "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::on_wall_clock(1.0);
  options.config.load_cell.line_format = "counts";
  options.amplifier.format = AmplifierFormat::kCounts;
  RigFixture rig(options);
  rig.load_cell.connect(rig.pump());
  const double deadline_s = monotonic_s() + 20.0;
  const auto until = [&](std::int64_t n) {
    const std::int64_t target = rig.load_cell.counts().received + n;
    while (rig.load_cell.counts().received < target && monotonic_s() < deadline_s) {
      wait_readable({&rig.cell_line}, rig.clock, 0.002);
      rig.load_cell.service();
    }
  };
  until(20);
  rig.emulated.stall(0.6);
  until(90);
  CHECK(rig.load_cell.counts().longest_gap_s > 0.5);
  CHECK(rig.load_cell.counts().missing <= 2);  // of 47 in the gap, whose ends are not sharp
}

TEST_CASE("counts printed with a decimal point are read as counts", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.config.load_cell.line_format = "auto";
  options.amplifier.format = AmplifierFormat::kMeanText;
  RigFixture rig(options);
  rig.load_cell.connect(rig.pump());
  CHECK(rig.load_cell.format() == Hx711Format::kCounts);
}

TEST_CASE("a lost answer leaves questions and answers in step", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.grbl.lose_status_every = 12;
  RigFixture rig(options);
  rig.stage.connect(rig.pump());
  // A report that may answer an older question has no latency; out of step, n stays below 12.
  const double deadline_s = rig.clock.awake_s() + 100.0;
  while (rig.stage.report_latency().n < 30 && rig.clock.awake_s() < deadline_s) rig.pump()();
  CHECK(rig.stage.report_latency().n == 30);
  CHECK(rig.stage.report_latency().n_lost == 2);
}

TEST_CASE("late answers are not counted as lost", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.grbl.status_delay_s = 0.35;
  RigFixture rig(options);
  rig.stage.connect(rig.pump());
  const double deadline_s = rig.clock.awake_s() + 7.5;
  while (rig.clock.awake_s() < deadline_s) rig.pump()();
  CHECK(rig.all<StageReport>().size() > 2);
  CHECK(rig.stage.report_latency().n_lost == 0);
}

TEST_CASE("an amplifier that restarts in the tare gives its zero afterwards", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.config.load_cell.line_format = "auto";
  options.amplifier.boot_s = 1.0;
  RigFixture rig(options);
  when_phase(rig, "tare", [&rig] { rig.emulated.cause(Incident::kRestartLoadCell); });
  const RunOutcome outcome = rig.run(short_plan());
  INFO(outcome.reason);
  CHECK(outcome.status == "finished");
  CHECK(outcome.line_format == "micros,counts");
  CHECK(rig.has_event("load_cell_restarted", ""));
  const std::vector<RunEvent> events = rig.all<RunEvent>();
  const auto restarted = std::find_if(events.begin(), events.end(), [](const RunEvent& event) {
    return event.name == "load_cell_restarted";
  });
  CHECK(std::any_of(restarted, events.end(),
                    [](const RunEvent& event) { return event.name == "tare"; }));
  CHECK(rig.has_event("line_format", "micros,counts"));
}

TEST_CASE("a missing port does not hide a wrong driver name", "[rig]") {
  RigConfig rig = demo_rig();
  rig.stage.port = "/dev/viscard-no-such-stage";
  rig.load_cell.port = "/dev/viscard-no-such-cell";
  const RigClock clock;
  CHECK_THROWS_WITH(open_ports(rig, clock), Contains("no-such-stage"));
  SECTION("stage") {
    rig.stage.driver = "grlb";
    CHECK_THROWS_WITH(open_ports(rig, clock), Contains("driver 'grlb' under [stage]"));
  }
  SECTION("load cell") {
    rig.load_cell.driver = "hx712";
    CHECK_THROWS_WITH(open_ports(rig, clock), Contains("driver 'hx712' under [load_cell]"));
  }
  SECTION("format") {
    rig.load_cell.line_format = "mikros";
    CHECK_THROWS_WITH(open_ports(rig, clock), Contains("'mikros' is unknown"));
  }
}

}  // namespace viscard
