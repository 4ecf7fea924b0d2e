#include "models/contact/punch_contact.h"
#include "models/material/material.h"
#include "rig/open_devices.h"
#include "tests/rig/rig_fixture.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <thread>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

bool is_at_rest_and_lifted(const RigFixture& rig) {
  const EmulatedOutcome bench = rig.emulated.outcome();
  UNSCOPED_INFO("stands at " << bench.final_position_m << " m, moving: " << bench.is_moving);
  return !bench.is_moving && bench.final_position_m < demo_truth(10.0, 7).surface_position_m;
}

}  // namespace

TEST_CASE("a whole run reaches its depth, records every reading and leaves the specimen",
          "[rig][pty]") {
  RigFixture rig(RigFixture::options());
  const RunOutcome outcome = rig.run(short_plan());
  INFO(outcome.reason);
  REQUIRE(outcome.status == "finished");
  CHECK(is_at_rest_and_lifted(rig));
  // The live contact is known to a few um, and so is the depth.
  CHECK(outcome.achieved_depth_m == Approx(0.13e-3).margin(3e-6));
  const EmulatedOutcome bench = rig.emulated.outcome();
  CHECK(bench.peak_depth_m == Approx(0.13e-3).margin(6e-6));
  CHECK(*outcome.contact_position_m == Approx(demo_truth(10.0, 7).surface_position_m).margin(6e-6));
  CHECK(outcome.peak_force_N == Approx(bench.peak_force_N).margin(5 * 0.49e-3));  // 5 sigma
  CHECK(outcome.stream.missing == 0);
  CHECK(outcome.stream.unreadable == 0);
  CHECK(rig.all<LoadSample>().size() == static_cast<std::size_t>(outcome.stream.received));
  CHECK(rig.has_event("finished", ""));
  for (const char* phase : {"tare", "approach", "baseline", "ramp", "hold", "unload", "recovery",
                            "retract", "baseline_after"}) {
    INFO(phase);
    CHECK(rig.has_event("phase", phase));
  }
}

TEST_CASE("ramp and unloading are one move each, from gap to depth and back in contact",
          "[rig][pty]") {
  RigFixture rig(RigFixture::options());
  const TestPlan plan = short_plan();
  const RunOutcome outcome = rig.run(plan);
  REQUIRE(outcome.status == "finished");
  std::vector<CommandedMove> ramps, unloads;
  for (const CommandedMove& move : rig.all<CommandedMove>()) {
    if (move.purpose == "ramp") ramps.push_back(move);
    if (move.purpose == "unload") unloads.push_back(move);
    CHECK(move.start_uncertainty_s >= 0.0);
  }
  REQUIRE(ramps.size() == 1);
  REQUIRE(unloads.size() == 1);
  const double contact_m = *outcome.contact_position_m;
  const double step_m = 1.0 / 3200e3;
  const double travel_m = outcome.expected.stage_travel_m;
  CHECK(ramps[0].move.from_m == Approx(contact_m - plan.gap_m).margin(step_m));
  CHECK(ramps[0].move.to_m == Approx(contact_m + travel_m).margin(step_m));
  CHECK(ramps[0].move.speed_m_s == Approx(travel_m / plan.ramp_s).epsilon(1e-4));  // F, 3 decimals
  CHECK(unloads[0].move.to_m ==
        Approx(contact_m + plan.unload_to_fraction * travel_m).margin(step_m));
  // Still pressed after the unloading: readings of the recovery stay well above the noise.
  double recovery_from_s = 0.0, retract_from_s = 0.0;
  for (const RunEvent& event : rig.all<RunEvent>()) {
    if (event.value == "recovery") recovery_from_s = event.host_time_s;
    if (event.value == "retract") retract_from_s = event.host_time_s;
  }
  double least_N = 1e9;
  for (const LoadSample& sample : rig.all<LoadSample>()) {
    const double made_s = rig.load_cell.made_at_s(sample);
    if (made_s < recovery_from_s + 0.1 || made_s > retract_from_s - 0.1) continue;
    const double volts = *sample.counts * rig.config.load_cell.volts_per_count;
    least_N = std::min(least_N, force_N_from_volts(rig.config.calibration, volts) - 0.02);
  }
  CHECK(least_N > 0.05);
}

TEST_CASE("readings follow the physics at the times of the commanded moves", "[rig][pty]") {
  RigFixture rig(RigFixture::options());
  const RunOutcome outcome = rig.run(short_plan());
  REQUIRE(outcome.status == "finished");
  const EmulatedTruth truth = demo_truth(10.0, 7);
  // Long after the ramp only the depth matters: the relaxed stiffness in series with the frame.
  const auto moves = rig.all<CommandedMove>();
  const auto ramp = std::find_if(moves.begin(), moves.end(),
                                 [](const CommandedMove& move) { return move.purpose == "ramp"; });
  REQUIRE(ramp != moves.end());
  const double hold_s = ramp->move.start_time_s + duration_s(ramp->move);
  const double c_m = force_per_modulus_and_depth_m(truth.contact);
  double sum_N = 0.0, expected_N = 0.0;
  int n = 0;
  for (const LoadSample& sample : rig.all<LoadSample>()) {
    const double since_s = rig.load_cell.made_at_s(sample) - hold_s;
    if (since_s < 2.0 || since_s > 2.8) continue;
    const double volts = *sample.counts * rig.config.load_cell.volts_per_count;
    sum_N += force_N_from_volts(rig.config.calibration, volts) - truth.force_offset_N;
    const double modulus_Pa = relaxation_modulus_Pa(young_series(truth.material), since_s + 0.5);
    expected_N += (ramp->move.to_m - truth.surface_position_m) /
                  (1.0 / (c_m * modulus_Pa) + 1.0 / truth.frame_stiffness_N_m);
    ++n;
  }
  REQUIRE(n > 50);
  CHECK(sum_N / n == Approx(expected_N / n).epsilon(2e-3));  // relaxation during the ramp, roughly
}

TEST_CASE("a specimen far stiffer than guessed stops the stage before the cell is harmed",
          "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.truth.material.E0_Pa *= GENERATE(1.6, 20.0);
  options.truth.surface_position_m = 0.1e-3;
  RigFixture rig(options);
  TestPlan plan = short_plan();
  plan.approach_speed_m_s = 0.1e-3;
  const RunOutcome outcome = rig.run(plan);
  CHECK(outcome.status == "stopped");
  CHECK_THAT(outcome.reason, Contains("limit"));
  const EmulatedOutcome bench = rig.emulated.outcome();
  CHECK_FALSE(bench.is_cell_broken);
  CHECK(bench.peak_force_N < 2.4517);  // below the rating
  CHECK(is_at_rest_and_lifted(rig));
}

TEST_CASE("a limit first stops the stage gently; a reset follows only if the force still rises",
          "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.truth.material.E0_Pa *= 1.6;
  options.truth.surface_position_m = 0.1e-3;
  RigFixture rig(options);
  TestPlan plan = short_plan();
  plan.ramp_s = GENERATE(1.0, 60.0);
  const RunOutcome outcome = rig.run(plan);
  INFO(outcome.reason);
  CHECK(outcome.status == "stopped");
  CHECK(rig.has_event("limit", "soft"));
  CHECK(rig.has_event("limit", "hard") == rig.has_event("stage_alarm", "3"));
  // The ramp was stopped after a part of the depth.
  CHECK(outcome.achieved_depth_m > 0.02e-3);
  CHECK_THAT(outcome.reason, Contains("stopped and lifted by"));
  CHECK(is_at_rest_and_lifted(rig));
}

TEST_CASE("a run that is asked to stop stops the stage, lifts the punch and keeps its records",
          "[rig][pty]") {
  const std::string phase = GENERATE("approach", "ramp", "hold", "recovery");
  RigFixture rig(RigFixture::options());
  when_phase(rig, phase, [&rig] { rig.stop = true; });
  const RunOutcome outcome = rig.run(short_plan());
  INFO(phase << ": " << outcome.reason);
  CHECK(outcome.status == "interrupted");
  CHECK(is_at_rest_and_lifted(rig));
  // Before the contact is known the stage already stands above its start, and is only stopped.
  CHECK_THAT(outcome.reason,
             Contains(phase == "approach" ? "The stage was stopped: it stands" : "lifted by"));
  CHECK_THAT(outcome.reason,
             Contains(phase == "approach" ? "mm above where it started" : "mm above the contact"));
  CHECK(outcome.code == "interrupted");
  CHECK(outcome.phase == phase);
  CHECK(rig.has_event("interrupted", "reason"));
  CHECK(rig.all<LoadSample>().size() > 20);
}

TEST_CASE("a load cell that is lost or silent in the ramp stops the stage", "[rig][pty]") {
  RigFixture rig(RigFixture::options());
  TestPlan plan = short_plan();
  plan.ramp_s = 8.0;
  SECTION("cable pulled") {
    when_phase(rig, "ramp", [&rig] { rig.emulated.cause(Incident::kPullLoadCellCable); });
    const RunOutcome outcome = rig.run(plan);
    CHECK(outcome.status == "interrupted");
    CHECK_THAT(outcome.reason, Contains("is gone"));
  }
  SECTION("stream stalls") {
    when_phase(rig, "ramp", [&rig] { rig.emulated.cause(Incident::kSilenceLoadCell); });
    const RunOutcome outcome = rig.run(plan);
    CHECK(outcome.status == "interrupted");
    CHECK_THAT(outcome.reason, Contains("fell silent"));
  }
  SECTION("amplifier restarts") {
    when_phase(rig, "ramp", [&rig] { rig.emulated.cause(Incident::kRestartLoadCell); });
    const RunOutcome outcome = rig.run(plan);
    CHECK(outcome.status == "interrupted");
    CHECK_THAT(outcome.reason, Contains("restarted"));
  }
  CHECK(is_at_rest_and_lifted(rig));
}

TEST_CASE("a stage lost in the hold ends the run and the reason states that it cannot be lifted",
          "[rig][pty]") {
  RigFixture rig(RigFixture::options());
  when_phase(rig, "hold", [&rig] { rig.emulated.cause(Incident::kPullStageCable); });
  const RunOutcome outcome = rig.run(short_plan());
  CHECK(outcome.status == "interrupted");
  CHECK_THAT(outcome.reason, Contains("by hand"));
  CHECK(rig.all<LoadSample>().size() > 20);
}

TEST_CASE("a limit switch in any phase ends with the stage unlocked and the punch lifted",
          "[rig][pty]") {
  const std::string phase = GENERATE("approach", "ramp", "hold");
  RigFixture rig(RigFixture::options());
  when_phase(rig, phase, [&rig] { rig.emulated.cause(Incident::kHitLimitSwitch); });
  const RunOutcome outcome = rig.run(short_plan());
  INFO(phase << ": " << outcome.reason);
  CHECK(outcome.status == "interrupted");
  CHECK_THAT(outcome.reason, Contains("alarm 1") && Contains("The stage was stopped"));
  if (phase != "approach") {
    CHECK_THAT(outcome.reason, Contains("lifted by") && Contains("position is not known"));
  }
  CHECK(outcome.code == "stage-alarm");
  CHECK(is_at_rest_and_lifted(rig));
}

TEST_CASE("a sink that fails stops the run safely and is named in the reason", "[rig][pty]") {
  RigFixture rig(RigFixture::options());
  when_phase(rig, "hold", [] { throw std::runtime_error("disk full"); });
  const RunOutcome outcome = rig.run(short_plan());
  CHECK(outcome.status == "interrupted");
  CHECK_THAT(outcome.reason, Contains("disk full"));
  CHECK(is_at_rest_and_lifted(rig));
}

TEST_CASE("stalls of the emulated rig change no reading", "[rig][pty]") {
  RigFixture rig(
      RigFixture::on_wall_clock(10.0));  // a busy computer halves the rate of a faster one
  int n_progress = 0;
  rig.on_progress = [&](const RunProgress& progress) {
    CHECK(progress.fraction >= 0.0);
    CHECK(progress.fraction <= 1.0);
    if (++n_progress % 3 == 0) rig.emulated.stall(0.1);
  };
  TestPlan plan = short_plan();
  plan.hold_s = 20.0;
  const RunOutcome outcome = rig.run(plan);
  INFO(outcome.reason);
  REQUIRE(outcome.status == "finished");
  CHECK(n_progress > 3);
  CHECK(outcome.stream.missing == 0);
  CHECK_FALSE(rig.emulated.outcome().is_cell_broken);
  CHECK(rig.emulated.outcome().peak_force_N < 1.9614);  // the soft limit
  CHECK(outcome.achieved_depth_m == Approx(0.13e-3).margin(6e-6));
}

TEST_CASE("a host that is busy when the run ends still receives the readings made before",
          "[rig][pty]") {
  RigFixture rig(RigFixture::on_wall_clock(20.0));
  bool has_slept = false;
  rig.on_progress = [&](const RunProgress& progress) {
    if (has_slept || progress.phase != "baseline_after") return;
    has_slept = true;  // past the end of the phase; its lines fit into the port's buffer
    std::this_thread::sleep_for(std::chrono::milliseconds(160));
  };
  TestPlan plan = short_plan();
  plan.baseline_s = 3.0;  // 150 ms of wall time: progress is reported every 100 ms
  REQUIRE(rig.run(plan).status == "finished");
  REQUIRE(has_slept);
  double begun_s = 0.0;
  for (const RunEvent& event : rig.all<RunEvent>()) {
    if (event.name == "phase" && event.value == "baseline_after") begun_s = event.host_time_s;
  }
  const LoadSample last = rig.all<LoadSample>().back();
  // Two readings, and the smallest delay of a line.
  CHECK(rig.load_cell.made_at_s(last) > begun_s + plan.baseline_s - 0.1);
}

TEST_CASE("an approach that touches nothing within its limit is an error, and the stage goes back",
          "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.truth.surface_position_m = 8e-3;
  const bool has_answered = GENERATE(true, false);
  if (has_answered) options.config.load_cell.answered_on = "2026-11-28";
  RigFixture rig(options);
  TestPlan plan = short_plan();
  plan.approach_speed_m_s = 1e-3;
  plan.approach_limit_m = 0.5e-3;
  const RunOutcome outcome = rig.run(plan);
  CHECK(outcome.status == "interrupted");
  CHECK_THAT(outcome.reason, Contains("nothing was touched") && Contains("viscard rig touch") &&
                                 Contains("toward_specimen = 1") && Contains("motor is dead") &&
                                 Contains("lifted by"));
  // A blind cell may have let the punch press: nobody is sent nearer before it has answered.
  CHECK(Contains("bring it nearer").match(outcome.reason) == has_answered);
  CHECK(Contains("Touch the cell first").match(outcome.reason) != has_answered);
  CHECK(rig.has_event("advice", "unanswered") != has_answered);
  CHECK(rig.emulated.outcome().final_position_m == Approx(0.0).margin(1e-6));
}

TEST_CASE("a contact that is stiffer than the stated frame names the frame", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  options.config.frame.stiffness_N_m = 1e3;
  RigFixture rig(options);
  const RunOutcome outcome = rig.run(short_plan());
  CHECK(outcome.status == "interrupted");
  CHECK_THAT(outcome.reason, Contains("stiffness under [frame]") && Contains("only 1 N/mm") &&
                                 !Contains("modulus_guess"));
}

TEST_CASE("a force above the limit names what the test calls its load", "[rig][pty]") {
  EmulatedRigOptions options = RigFixture::options();
  RigFixture rig(options);
  double weight_N =
      -1.0;  // grows in the hold: too slowly for an open wire, faster than a step back
  when_phase(rig, "creep", [&] { weight_N = 0.0; });
  rig.on_record = [&](const RunRecord& record) {
    if (weight_N < 0.0 || !std::holds_alternative<LoadSample>(record)) return;
    rig.emulated.hang_weight(weight_N += 0.4);
  };
  TestPlan plan = short_plan();
  plan.protocol = "creep";
  plan.creep.force_N = 0.3;
  plan.creep.ramp_s = 2.0;
  plan.creep.hold_s = 3.0;
  const RunOutcome outcome = rig.run(plan);
  CHECK(outcome.status == "stopped");
  CHECK_THAT(outcome.reason, Contains("Lower force under [creep] of the test file"));
}

TEST_CASE("a run that is stopped before anything moved reports that the stage stands",
          "[rig][pty]") {
  RigFixture rig(RigFixture::options());
  when_phase(rig, "tare", [&rig] { rig.stop = true; });
  const RunOutcome outcome = rig.run(short_plan());
  CHECK_THAT(outcome.reason, Contains("The stage was not moved") && !Contains("lifted"));
}

}  // namespace viscard
