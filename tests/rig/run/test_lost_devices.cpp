// Runs whose cables are pulled or whose program stalls, through real pseudo-terminals.
#include "tests/rig/rig_fixture.h"

#include <catch2/catch.hpp>
#include <unistd.h>

#include <string>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

}  // namespace

TEST_CASE("a cable pulled in any phase ends the run and keeps all records before it",
          "[rig][pty]") {
  const std::string phase =
      GENERATE("tare", "approach", "baseline", "ramp", "hold", "unload", "recovery", "retract");
  const bool is_stage = GENERATE(false, true);
  RigFixture rig(RigFixture::options());
  when_phase(rig, phase, [&] {
    is_stage ? rig.emulated.cause(Incident::kPullStageCable)
             : rig.emulated.cause(Incident::kPullLoadCellCable);
  });
  const RunOutcome outcome = rig.run(short_plan());
  INFO(phase << (is_stage ? ", stage: " : ", load cell: ") << outcome.reason);
  CHECK(outcome.status == "interrupted");
  CHECK_THAT(outcome.reason, Contains("is gone") || Contains("took no more bytes"));
  CHECK(rig.has_event("phase", phase));
  CHECK(rig.has_event("interrupted", "reason"));
  if (is_stage && phase == "tare") {
    CHECK_THAT(outcome.reason, !Contains("by hand"));  // the stage had not moved
  } else if (is_stage) {
    CHECK_THAT(outcome.reason, Contains("by hand"));
  } else {
    CHECK_FALSE(rig.emulated.outcome().is_moving);
    CHECK(rig.emulated.outcome().final_position_m < demo_truth(10.0, 7).surface_position_m);
  }
}

TEST_CASE("a stage whose port comes back lifts the punch as far as it had pressed", "[rig][pty]") {
  const std::string phase = GENERATE("approach", "ramp", "hold", "unload");
  const bool resets = GENERATE(true, false);  // a board that restarts when its port is opened
  EmulatedRigOptions options = RigFixture::options();
  options.truth.surface_position_m = 0.06e-3;
  options.resets_on_open = resets;
  options.fault = rig_fault_from_text("stage-port-back@" + phase);
  RigFixture rig(options);
  when_phase(rig, phase, [&] { rig.emulated.enter_phase(phase); });
  const RunOutcome outcome = rig.run(short_plan());
  INFO(phase << ": " << outcome.reason);
  CHECK(outcome.status == "interrupted");
  CHECK_THAT(outcome.reason, !Contains("by hand") && !Contains("BY HAND"));
  // A board that restarts counts from where it stands.
  CHECK_THAT(outcome.reason, !Contains("above the contact") && !Contains("where it started"));
  if (phase != "approach") {
    CHECK_THAT(outcome.reason, Contains("lifted by 0.") && Contains("position is not known"));
  }
  CHECK_FALSE(rig.emulated.outcome().is_moving);
  CHECK(rig.emulated.outcome().final_position_m < options.truth.surface_position_m);
  CHECK(rig.emulated.outcome().final_position_m > -1e-3);  // no further than it had come
}

TEST_CASE("a stall of this program changes no reading and stops nothing", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::on_wall_clock(2.0);
  options.truth.surface_position_m = 0.1e-3;
  RigFixture rig(options);
  int n_progress = 0;
  rig.on_progress = [&](const RunProgress&) {
    if (++n_progress % 5 == 0) ::usleep(300'000);  // as SIGSTOP and SIGCONT would
  };
  TestPlan plan = short_plan();
  plan.approach_speed_m_s = 0.5e-3;
  plan.baseline_s = 0.2;
  plan.hold_s = 0.5;
  plan.recovery_s = 0.0;
  const RunOutcome outcome = rig.run(plan);
  INFO(outcome.reason);
  CHECK(outcome.status == "finished");
  CHECK(outcome.stream.missing == 0);
  CHECK(n_progress > 8);
}

TEST_CASE("a load cell that dies in a hold is noticed within 2 s", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.truth.surface_position_m = 0.06e-3;
  RigFixture rig(options);
  when_phase(rig, "hold", [&rig] { rig.emulated.cause(Incident::kSilenceLoadCell); });
  TestPlan plan = short_plan();
  plan.hold_s = 20.0;
  const RunOutcome outcome = rig.run(plan);
  INFO(outcome.reason);
  CHECK(outcome.status == "interrupted");
  CHECK_THAT(outcome.reason, Contains("fell silent while the stage stood still"));
  CHECK_FALSE(rig.has_event("stage_alarm", "3"));  // a stage at rest needs no reset
  // Of time spent listening; on a busy machine that is more of the wall's.
  std::string noticed;
  for (const RunEvent& event : rig.all<RunEvent>()) {
    if (event.name == "limit" && event.value == "silent") noticed = event.text;
  }
  CHECK_THAT(noticed, Contains("at rest, which may be 1.5"));
  CHECK_FALSE(rig.emulated.outcome().is_moving);
}

}  // namespace viscard
