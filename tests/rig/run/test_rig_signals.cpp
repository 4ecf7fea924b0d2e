// Whole runs on a rig whose signals arrive but do not measure, or whose stage counts but does not
// move.
#include "tests/rig/rig_fixture.h"

#include <catch2/catch.hpp>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

EmulatedRigOptions rig_with(const std::string& fault) {
  EmulatedRigOptions options = RigFixture::options();
  options.truth.surface_position_m = 0.4e-3;
  options.truth.overload_N = 100.0;  // a broken cell would hide how far the force went
  options.fault = rig_fault_from_text(fault);
  return options;
}

TestPlan creep_plan(double force_N) {
  TestPlan plan = short_plan();
  plan.protocol = "creep";
  plan.creep.force_N = force_N;
  plan.creep.ramp_s = 1.0;
  plan.creep.hold_s = 4.0;
  return plan;
}

struct FaultedRun {
  RunOutcome outcome;
  EmulatedOutcome bench;
  std::string said;  // reason and doubts
};

FaultedRun run_with(const EmulatedRigOptions& options, const TestPlan& plan = short_plan()) {
  RigFixture rig(options);
  rig.sink = [&rig](const RunRecord& record) {
    rig.records.push_back(record);
    const auto* event = std::get_if<RunEvent>(&record);
    if (event != nullptr && event->name == "phase") rig.emulated.enter_phase(event->value);
  };
  FaultedRun run;
  run.outcome = rig.run(plan);
  run.bench = rig.emulated.outcome();
  run.said = run.outcome.reason;
  for (const std::string& doubt : run.outcome.doubts) run.said += " | " + doubt;
  return run;
}

}  // namespace

TEST_CASE("a signal that is dead from the start lets nothing move", "[rig][pty]") {
  const auto [fault, word] =
      GENERATE(std::pair<std::string, std::string>{"frozen", "frozen"},
               std::pair<std::string, std::string>{"zeros", "exactly 0"},
               std::pair<std::string, std::string>{"open-wire", "open wire"},
               std::pair<std::string, std::string>{"fast-readings", "240.0 readings/s"},
               std::pair<std::string, std::string>{"slow-readings", "10.0 readings/s"});
  const FaultedRun run = run_with(rig_with(fault));
  INFO(fault << ": " << run.said);
  CHECK(run.outcome.status != "finished");
  CHECK_THAT(run.said, Contains(word));
  CHECK_THAT(run.said, Contains("not moved"));
  CHECK(run.bench.final_position_m == 0.0);
}

TEST_CASE("a signal that dies in the approach stops the stage before the cell is loaded",
          "[rig][pty]") {
  const auto [fault, word] = GENERATE(
      std::pair<std::string, std::string>{"frozen@approach+0.4", "frozen"},
      std::pair<std::string, std::string>{"zeros@approach+0.4", "frozen"},
      std::pair<std::string, std::string>{"open-wire@approach+0.4", "open wire"},
      std::pair<std::string, std::string>{"drifting-wire@approach+0.4", "wire"},
      std::pair<std::string, std::string>{"fast-readings@approach+0.4", "rate"},
      std::pair<std::string, std::string>{"slow-readings@approach+0.4", "rate has dropped"});
  const FaultedRun run = run_with(rig_with(fault));
  INFO(fault << ": " << run.said);
  CHECK(run.outcome.status != "finished");
  CHECK_THAT(run.said, Contains(word));
  CHECK_THAT(run.said, !Contains("compression_is_positive") && !Contains("approach speed"));
  CHECK(run.bench.peak_force_N < 0.3);
}

TEST_CASE("a signal that dies in the ramp stops the stage within a tenth of the capacity",
          "[rig][pty]") {
  const auto [fault, word] =
      GENERATE(std::pair<std::string, std::string>{"frozen@ramp+0.4", "frozen"},
               std::pair<std::string, std::string>{"zeros@ramp+0.4", "frozen"},
               std::pair<std::string, std::string>{"saturation@ramp+0.2", "frozen"},
               std::pair<std::string, std::string>{"open-wire@ramp+0.4", "open wire"});
  // The force at the time of the fault: a ramp of 1 s to 1.3 N; the clip is at 0.61 N.
  const double force_N = fault[0] == 's' ? 0.62 : 0.5;
  const FaultedRun run = run_with(rig_with(fault));
  INFO(fault << ": " << run.said);
  CHECK(run.outcome.status != "finished");
  CHECK_THAT(run.said, Contains(word));
  CHECK(run.bench.peak_force_N < force_N + 0.1 * 2.4517);
  CHECK(run.bench.final_position_m < 0.4e-3);
}

TEST_CASE("a signal that dies in the hold ends the run, lifted, with the cause", "[rig][pty]") {
  const std::string fault =
      GENERATE("frozen@hold+0.5", "zeros@hold+0.5", "saturation@hold+0.5", "open-wire@hold+0.5",
               "slow-readings@hold+0.5", "fast-readings@hold+0.5");
  const FaultedRun run = run_with(rig_with(fault));
  INFO(fault << ": " << run.said);
  CHECK(run.outcome.status != "finished");
  CHECK_THAT(run.said, Contains("frozen") || Contains("open wire") || Contains("rate"));
  CHECK(run.bench.final_position_m < 0.4e-3);
}

TEST_CASE("a motor that stands while its controller counts on is noticed by the force",
          "[rig][pty]") {
  const std::string phase = GENERATE("ramp+0.3", "hold+1.0", "recovery+0.5", "retract");
  const FaultedRun run = run_with(rig_with("dead-motor@" + phase));
  INFO(phase << ": " << run.said);
  CHECK(run.outcome.status == "interrupted");
  CHECK_THAT(run.said, Contains("motor"));
  CHECK_THAT(run.said, Contains("count"));
  if (phase != "ramp+0.3") CHECK_THAT(run.said, Contains("by hand"));
  CHECK(run.outcome.code ==
        (phase == "ramp+0.3" || phase == "hold+1.0" ? "no-response" : "not-lifted"));
}

TEST_CASE("a motor that stands from the start touches nothing, and the motor is named",
          "[rig][pty]") {
  TestPlan plan = short_plan();
  plan.approach_limit_m = 1e-3;
  const FaultedRun run = run_with(rig_with("dead-motor"), plan);
  CHECK(run.outcome.status == "interrupted");
  CHECK_THAT(run.said, Contains("motor is dead") && Contains("by its count, which is in doubt"));
  CHECK(run.bench.peak_force_N == 0.0);
}

TEST_CASE("a motor that dies after a third of the ramp is noticed within the ramp", "[rig][pty]") {
  TestPlan plan = short_plan();
  plan.ramp_s = 2.0;
  const FaultedRun run = run_with(rig_with("dead-motor@ramp+0.7"), plan);
  INFO(run.said);
  CHECK(run.outcome.code == "no-response");
  CHECK(run.outcome.phase == "ramp");
  CHECK_THAT(run.said, Contains("pressed on by") && Contains("motor does not turn"));
}

TEST_CASE("a motor that dies in the approach leaves a small force, and the run says so",
          "[rig][pty]") {
  // At 20 um/s: below the contact threshold of 20 mN, and after it, before the punch presses further to try the touch.
  const auto [after_s, word] =
      GENERATE(std::pair<std::string, std::string>{"8.25", "motor is dead"},
               std::pair<std::string, std::string>{"8.6", "motor does not turn"});
  EmulatedRigOptions options = rig_with("dead-motor@approach+" + after_s);
  options.truth.surface_position_m = 0.06e-3;
  TestPlan plan = short_plan();
  plan.approach_speed_m_s = 0.02e-3;
  plan.contact_force_N = 0.02;
  plan.approach_limit_m = 0.4e-3;
  const FaultedRun run = run_with(options, plan);
  INFO(after_s << " s: " << run.said);
  CHECK(run.outcome.status == "interrupted");
  CHECK(run.outcome.phase == "approach");
  CHECK(run.bench.peak_force_N < 0.05);
  CHECK_THAT(run.outcome.reason, Contains(word) && Contains("THE PUNCH MAY STILL PRESS") &&
                                     Contains("by hand") &&
                                     Contains("by its count, which is in doubt") &&
                                     !Contains("This is no contact") && !Contains("NOT LIFTED"));
  CHECK(run.bench.final_position_m > options.truth.surface_position_m);
}

TEST_CASE("a punch that is not lifted by a dead motor has one reason, on coarse steps too",
          "[rig][pty]") {
  EmulatedRigOptions options = rig_with("dead-motor@retract");
  options.truth.steps_per_m = 250e3;
  options.truth.surface_position_m = GENERATE(0.4e-3, 0.4013e-3, 0.4027e-3);
  const FaultedRun run = run_with(options);
  INFO(run.said);
  CHECK(run.outcome.code == "not-lifted");
  CHECK_THAT(run.said, Contains("MAY STILL PRESS") && Contains("motor does not turn") &&
                           !Contains("NOT LIFTED") && !Contains("$20"));
}

TEST_CASE("a stage whose direction sticks presses once, and nothing lifts it any further",
          "[rig][pty]") {
  const std::string phase = GENERATE("approach+2.3", "hold", "recovery+0.5", "retract");
  const FaultedRun run = run_with(rig_with("direction-stuck@" + phase));
  INFO(phase << ": " << run.said << " " << run.bench.peak_force_N);
  // An unloading by 4 mm/s passes the force limit within one reading.
  CHECK(run.outcome.code == (phase == "hold" ? "force-limit" : "wrong-way"));
  CHECK_THAT(run.said, Contains("direction (DIR) wire") && Contains("THE PUNCH MAY PRESS") &&
                           Contains("by its count, which is in doubt") &&
                           !Contains("motor does not turn") && !Contains("FALL"));
  CHECK(run.bench.peak_force_N < demo_rig().calibration.capacity_N);
}

TEST_CASE("a creep whose steps away press ends before the force limit or soon after it",
          "[rig][pty]") {
  TestPlan plan = short_plan();
  plan.protocol = "creep";
  plan.creep.force_N = GENERATE(1.2, 1.8);
  plan.creep.ramp_s = 1.0;
  plan.creep.hold_s = 6.0;
  const FaultedRun run = run_with(rig_with("direction-stuck@ramp+0.9"), plan);
  INFO(run.said << " " << run.bench.peak_force_N);
  CHECK_THAT(run.said, Contains("direction (DIR) wire"));
  CHECK(run.bench.peak_force_N < demo_rig().calibration.capacity_N);
}

TEST_CASE("the lift after an interruption is stopped when it presses", "[rig][pty]") {
  RigFixture rig(rig_with("direction-stuck@hold"));
  when_phase(rig, "hold", [&rig] {
    rig.emulated.enter_phase("hold");
    rig.stop = true;
  });
  const RunOutcome outcome = rig.run(short_plan());
  INFO(outcome.reason);
  CHECK(outcome.code == "interrupted");
  CHECK_THAT(outcome.reason, Contains("direction (DIR) wire") && Contains("THE PUNCH MAY PRESS") &&
                                 !Contains("lifted by"));
  CHECK(rig.emulated.outcome().peak_force_N < demo_rig().calibration.capacity_N);
}

TEST_CASE("an unloading at once after a fast press is no move the wrong way", "[rig][pty]") {
  EmulatedRigOptions options = rig_with("direction-stuck@never");
  options.truth.sample_rate_Hz = options.config.load_cell.expected_rate_Hz = GENERATE(20.0, 80.0);
  TestPlan plan = short_plan();
  plan.approach_speed_m_s = 0.05e-3;
  plan.ramp_s = 0.6;
  plan.hold_s = 0.0;
  const FaultedRun run = run_with(options, plan);
  INFO(run.said);
  CHECK(run.outcome.status == "finished");
}

TEST_CASE("an axis that sinks after the lift is no finished run", "[rig][pty]") {
  const FaultedRun run = run_with(rig_with("sinks@baseline_after"));
  INFO(run.said << " " << run.bench.peak_force_N);
  CHECK(run.outcome.code == "not-lifted");
  CHECK_THAT(run.said, Contains("the punch was free, and now the force is") &&
                           Contains("the axis sinks") && Contains("by hand"));
}

TEST_CASE("a zero that drifts during a run is a doubt that says where the punch is", "[rig][pty]") {
  RigFixture rig(rig_with("dead-motor@never"));
  when_phase(rig, "hold", [&rig] { rig.emulated.hang_weight(0.1); });
  const RunOutcome outcome = rig.run(short_plan());
  INFO(outcome.reason);
  CHECK(outcome.status == "finished");
  REQUIRE_FALSE(outcome.doubts.empty());
  CHECK_THAT(outcome.doubts.front(),
             Contains("after the lift the force is 0.1") && Contains("above the contact"));
  CHECK(rig.has_event("doubt", "after_lift"));
}

TEST_CASE("a zero that jumps between touch and ramp ends the run before it presses", "[rig][pty]") {
  RigFixture rig(rig_with("dead-motor@never"));
  when_phase(rig, "baseline", [&rig] { rig.emulated.hang_weight(-0.6); });
  const bool is_creep = GENERATE(false, true);
  TestPlan plan = short_plan();
  if (is_creep) plan = creep_plan(1.0);
  const RunOutcome outcome = rig.run(plan);
  INFO(outcome.reason);
  CHECK(outcome.status == "interrupted");
  CHECK(outcome.phase == "baseline");
  CHECK_THAT(outcome.reason, Contains("the zero jumped by -0.6") && !Contains("STILL PRESS") &&
                                 !Contains("DOES NOT FALL"));
  CHECK(rig.emulated.outcome().peak_force_N < 0.3);
}

// Balances filter their readings, and converters settle over some of them.
TEST_CASE(
    "a cell whose filter is slow is not taken for a stage that goes the wrong way, nor for play",
    "[rig][pty]") {
  TestPlan plan = short_plan();
  const std::string protocol = GENERATE(as<std::string>(), "ramp-hold", "levels", "cycles");
  plan.protocol = protocol;
  plan.cycles = {.count = 2, .depth_m = 0.1e-3, .ramp_s = 0.5, .hold_s = 0.5, .rest_s = 1.0};
  plan.levels = {{0.05e-3, 0.5, 0.0}, {0.1e-3, 0.5, 0.0}, {0.04e-3, 0.1, 1.0}};
  const FaultedRun run = run_with(rig_with("filtered"), plan);
  INFO(protocol << ": " << run.said);
  CHECK(run.outcome.status == "finished");
  CHECK_THAT(run.said, !Contains("moves away") && !Contains("lost motion") &&
                           !Contains("no specimen does") && !Contains("softer than the touch"));
}

TEST_CASE("a press that a person ends is lifted though a slow filter still shows its rise",
          "[rig][pty]") {
  RigFixture rig(rig_with("filtered"));
  rig.on_record = [&](const RunRecord& record) {
    const auto* event = std::get_if<RunEvent>(&record);
    if (event == nullptr || event->name != "phase") return;
    rig.emulated.enter_phase(event->value);
    if (event->value == "hold") rig.stop = true;
  };
  TestPlan plan = short_plan();
  plan.ramp_s = 0.3;
  plan.retract_speed_m_s = 0.1e-3;  // so slow that the readings rise before they fall
  const RunOutcome outcome = rig.run(plan);
  INFO(outcome.reason);
  CHECK(outcome.status == "interrupted");
  CHECK_THAT(outcome.reason, Contains("lifted by") && !Contains("MAY PRESS"));
  CHECK(rig.emulated.outcome().final_position_m < 0.4e-3);  // the surface
}

TEST_CASE("a press that does not fit the touch, a force that goes in a hold, and play are doubts",
          "[rig][pty]") {
  const auto [fault, word] =
      GENERATE(std::pair<std::string, std::string>{"half-gain@baseline+0.5", "far softer"},
               std::pair<std::string, std::string>{"no-excitation@hold+1.5", "jumped by -"},
               std::pair<std::string, std::string>{"half-gain@hold+1.5", "jumped by -"},
               std::pair<std::string, std::string>{"play", "lost motion on reversal"});
  const FaultedRun run = run_with(rig_with(fault));
  INFO(fault << ": " << run.said);
  CHECK(run.outcome.status == "finished");
  CHECK_THAT(run.said, Contains(word) && !Contains("lost steps while it pressed"));
}

TEST_CASE("a force far above the expected one is a doubt, and a lower guess alone is not",
          "[rig][pty]") {
  const double share = GENERATE(0.5, 0.8);
  RigFixture rig(rig_with("dead-motor@never"));
  Specimen specimen = demo_specimen(10.0);
  specimen.modulus_guess_Pa *= share;
  const RunOutcome outcome = rig.run(short_plan(), specimen);
  INFO(share << outcome.reason);
  CHECK(outcome.status == "finished");
  CHECK(outcome.doubts.empty() == (share > 0.6));
  CHECK(rig.has_event("doubt", "force_high") == (share < 0.6));
}

TEST_CASE("a creep test whose gain halves before it presses ends with that cause", "[rig][pty]") {
  const FaultedRun run = run_with(rig_with("half-gain@baseline+0.5"), creep_plan(1.0));
  INFO(run.said);
  CHECK(run.outcome.status == "interrupted");
  CHECK(run.outcome.phase == "ramp");
  CHECK_THAT(run.said, Contains("gain of the load cell"));
  CHECK(run.bench.peak_force_N < 2.0);
}

TEST_CASE("a load cell whose readings show no noise is not brought to the specimen unproven",
          "[rig][pty]") {
  EmulatedRigOptions options = rig_with("dead-motor@never");
  options.truth.force_noise_N = 0.0;
  options.config.load_cell.volts_per_count *= 4096.0;  // 12 bits: a digit of 7 mN
  options.config.load_cell.span_V = 10.0;
  TestPlan plan = short_plan();
  plan.contact_force_N = 0.03;
  SECTION("without a surface it ends and asks for a touch") {
    const FaultedRun run = run_with(options, plan);
    INFO(run.said);
    CHECK(run.outcome.code == "cell-dead");
    CHECK_THAT(run.said, Contains("finger or a weight") && Contains("rig touch"));
    CHECK(run.bench.peak_force_N == 0.0);
  }
  SECTION("with a stated surface it goes there, and the answer is the proof") {
    plan.surface_m = 0.4e-3;
    plan.surface_margin_m = 60e-6;
    const FaultedRun run = run_with(options, plan);
    INFO(run.said);
    CHECK(run.outcome.status == "finished");
  }
  SECTION("a frozen one goes no further than the margin") {
    plan.surface_m = 0.4e-3;
    options.fault = rig_fault_from_text("frozen");
    const FaultedRun run = run_with(options, plan);
    INFO(run.said);
    CHECK(run.outcome.code == "cell-dead");
    CHECK_THAT(run.said, Contains("beyond the stated surface"));
    CHECK(run.bench.peak_force_N < 0.5);  // 50 um at 8.8 N/mm
  }
  SECTION("a day on which it answered is a proof") {
    options.config.load_cell.answered_on = "2026-11-28";
    const FaultedRun run = run_with(options, plan);
    INFO(run.said);
    CHECK(run.outcome.status == "finished");
  }
}

TEST_CASE(
    "a controller that stands still for half a second in a ramp is a doubt with time and phase",
    "[rig][pty]") {
  const bool is_in_contact = GENERATE(true, false);
  EmulatedRigOptions options = RigFixture::options();
  options.fault =
      rig_fault_from_text(is_in_contact ? "stage-stall@ramp+0.2" : "stage-stall@approach");
  const FaultedRun run = run_with(options);
  INFO(run.said);
  REQUIRE(run.outcome.status == "finished");
  REQUIRE(run.outcome.doubts.empty() == !is_in_contact);
  if (!is_in_contact) return;
  CHECK_THAT(run.said, Contains("stood still") && Contains("in the phase 'ramp'") &&
                           (Contains("the stage fell 0.4") || Contains("the stage fell 0.5")));
}

TEST_CASE("the words of the faults are read, and an unknown one is refused", "[rig]") {
  const RigFault fault = rig_fault_from_text("frozen@hold+0.5");
  CHECK(fault.kind == RigFaultKind::kFrozen);
  CHECK(fault.phase == "hold");
  CHECK(fault.after_s == 0.5);
  for (const std::string& name : rig_fault_names()) {
    CHECK(name_of(rig_fault_from_text(name).kind) == name);
  }
  CHECK_THROWS_WITH(rig_fault_from_text("freezing"), Contains("known are frozen"));
  CHECK_THROWS_WITH(rig_fault_from_text("frozen@hold+x"), Contains("number of seconds"));
  CHECK_THROWS_WITH(rig_fault_from_text("frozen@"), Contains("a phase"));
}

}  // namespace viscard
