// A computer that is too busy to watch a real rig, or a program that is frozen. The rig is emulated on
// the wall clock by a thread of its own, and this thread sleeps in the middle of the run.
#include "rig/rig_check.h"
#include "tests/rig/rig_fixture.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <string>
#include <thread>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

constexpr double kNearSurface_m = 0.06e-3;

EmulatedRigOptions real_rig() {
  EmulatedRigOptions options = RigFixture::on_wall_clock(1.0);
  options.truth.surface_position_m = kNearSurface_m;
  return options;
}

TestPlan quick_plan_of_phases() {
  TestPlan plan = short_plan();
  plan.baseline_s = 0.5;
  plan.hold_s = 1.5;
  plan.recovery_s = 0.5;
  return plan;
}

void be_late(double wall_s) {
  std::this_thread::sleep_for(std::chrono::duration<double>(wall_s));
}

// Sleeps once, at the first reading above a force after a phase has begun.
void late_in_phase(RigFixture& rig, const std::string& phase, double least_N, double wall_s) {
  rig.on_progress = [phase, least_N, wall_s, is_done = false](const RunProgress& now) mutable {
    if (is_done || now.phase != phase || now.force_N < least_N) return;
    is_done = true;
    be_late(wall_s);
  };
}

}  // namespace

TEST_CASE("a computer that is late while the stage presses ends the run and is named",
          "[rig][pty]") {
  RigFixture rig(real_rig());
  late_in_phase(rig, "ramp", 0.05, 0.8);
  const RunOutcome outcome = rig.run(quick_plan_of_phases());
  INFO(outcome.reason);
  CHECK(outcome.status == "interrupted");
  CHECK_THAT(outcome.reason, Contains("this computer was late by 0.") && Contains("lifted by"));
  CHECK_THAT(outcome.reason,
             !Contains("modulus_guess") && !Contains("depth under") && !Contains("amplifier"));
  CHECK(outcome.n_late >= 1);
  CHECK(outcome.longest_late_s > 0.7);
  const auto events = rig.all<RunEvent>();
  CHECK(std::any_of(events.begin(), events.end(), [](const RunEvent& event) {
    return event.name == "computer_late" &&
           event.text.find("while the stage moved") != std::string::npos;
  }));
  CHECK_FALSE(rig.emulated.outcome().is_moving);
  CHECK(rig.emulated.outcome().final_position_m < kNearSurface_m);
}

TEST_CASE("a limit that is passed while the computer is late is not blamed on the specimen",
          "[rig][pty]") {
  EmulatedRigOptions options = real_rig();
  options.truth.material.E0_Pa *= 1.6;  // above the soft limit at the end of the ramp
  RigFixture rig(options);
  late_in_phase(rig, "ramp", 1.0, 0.8);
  const RunOutcome outcome = rig.run(quick_plan_of_phases());
  INFO(outcome.reason);
  CHECK(outcome.status != "finished");
  CHECK_THAT(outcome.reason, Contains("this computer was late by 0."));
  CHECK_THAT(outcome.reason, !Contains("modulus_guess") && !Contains("depth under"));
}

TEST_CASE("a computer that is late in a hold loses nothing and is reported", "[rig][pty]") {
  RigFixture rig(real_rig());
  late_in_phase(rig, "hold", 0.05, 0.8);
  const RunOutcome outcome = rig.run(quick_plan_of_phases());
  INFO(outcome.reason);
  REQUIRE(outcome.status == "finished");
  CHECK(outcome.stream.missing == 0);
  CHECK(outcome.n_late >= 1);
  CHECK(outcome.longest_late_s > 0.7);
}

TEST_CASE("no deadline of a driver ends while nobody listens", "[rig][pty]") {
  RigFixture rig(RigFixture::on_wall_clock(10.0));  // its stage stands still long before
  rig.stage.connect(rig.pump());
  rig.stage.begin_move(0.2e-3, 0.1e-3, "test");
  be_late(5.6);  // longer than a stage may stand still on its way
  const Pump pump = rig.pump();
  while (rig.stage.is_moving()) pump();
  CHECK(rig.stage.position_m() == Approx(0.2e-3).margin(1e-6));
}

TEST_CASE("a rig check on a late computer names the computer and judges no delay", "[rig][pty]") {
  RigFixture rig(real_rig());
  int n_records = 0;
  rig.on_record = [&](const RunRecord& record) {
    if (std::holds_alternative<LoadSample>(record) && ++n_records % 60 == 0) be_late(0.3);
  };
  const RigCheck check = check_rig(rig.stage, rig.load_cell, rig.config, rig.clock, 2.0);
  CHECK_FALSE(check.is_usable);
  CHECK(check.late_s > 0.2);
  std::string all;
  for (const std::string& text : check.advice) all += text + "\n";
  CHECK_THAT(all, Contains("this computer was late by 0."));
  CHECK_THAT(all, !Contains("latency_timer") && !Contains("expected_rate"));
}

}  // namespace viscard
