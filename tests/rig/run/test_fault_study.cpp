// Runs with one fault each, and healthy runs, from seeds: no run may load the cell beyond its
// capacity, what is wrong must be named, and what finishes without a doubt must be as true as a
// healthy run. Their stages are homed (home = true).
#include "fit/fit_indentation.h"
#include "fit/indentation_from_capture.h"
#include "rig/emulator/seeded_noise.h"
#include "tests/rig/rig_fixture.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <map>
#include <random>

namespace viscard {
namespace {

constexpr double kFrame_u = 0.01, kGain_u = 0.003;
constexpr double kHomedAt_m = 1e-3;  // from the switch, which is machine zero: $27 of the emulator

const std::vector<std::string>& phases() {
  static const std::vector<std::string> kPhases{"", "approach", "ramp", "hold", "unload"};
  return kPhases;
}

// A port counts as one kind of fault, whichever device it belongs to.
const std::vector<RigFaultKind>& kinds() {
  using enum RigFaultKind;
  static const std::vector<RigFaultKind> kKinds{
      kFrozen,     kZeros,     kFastReadings, kOpenWire,  kDriftingWire,
      kSaturation, kDeadMotor, kLostSteps,    kStagePort, kSlowReadings};
  return kKinds;
}

// Words of which one names the fault.
std::vector<std::string> names_of(RigFaultKind kind) {
  using enum RigFaultKind;
  switch (kind) {
    case kFrozen:
      return {"frozen", "the same number"};
    case kZeros:
      return {"exactly 0"};
    case kFastReadings:
    case kSlowReadings:
      return {"rate has", "expected_rate"};
    case kOpenWire:
      return {"open wire", "wire of the load cell is open", "wires of the cell"};
    case kDriftingWire:
      return {"open wire", "wire of the load cell", "open wire"};
    case kSaturation:
      return {"saturation"};
    case kDeadMotor:
      return {"motor"};
    case kLostSteps:
      return {"lost steps"};
    case kStagePort:
    case kStagePortBack:
    case kLoadCellPort:
      return {"is gone", "port"};
    case kStageStall:
      return {"stood still"};
    case kDirectionStuck:
      return {"direction"};
    case kPlay:
      return {"lost motion"};
    case kNoExcitation:
    case kHalfGain:
    case kFiltered:
    case kSinks:
    case kNone:
      break;
  }
  return {};
}

struct StudyRun {
  RigFault fault;
  RunOutcome outcome;
  double peak_N = 0.0;  // true
  double lost_m = 0.0;  // counted and not travelled
  bool is_doubtful = false, is_named = false;
  bool has_fit = false, holds = false;
  std::string said;
};

double within(std::mt19937_64& random, double least, double most) {
  return std::uniform_real_distribution<double>(least, most)(random);
}

RigFault fault_of(std::uint64_t seed, std::mt19937_64& random) {
  const std::size_t n = kinds().size();
  RigFault fault;
  fault.kind = kinds()[seed % n];
  if (fault.kind == RigFaultKind::kStagePort && seed / n % 2 == 1) {
    fault.kind = RigFaultKind::kLoadCellPort;
  }
  fault.phase = phases()[seed / n % phases().size()];
  const std::map<std::string, double> longest_s{
      {"", 0.0}, {"approach", 2.0}, {"ramp", 0.9}, {"hold", 5.0}, {"unload", 0.05}};
  fault.after_s = within(random, 0.0, longest_s.at(fault.phase));
  return fault;
}

StudyRun study_run(std::uint64_t seed, bool is_faulted) {
  std::mt19937_64 random(seed * 7919 + (is_faulted ? 1 : 0));
  std::normal_distribution<double> normal;
  constexpr double kRatios[] = {10.0, 13.0, 20.0};
  const double ratio = kRatios[random() % 3];
  EmulatedRigOptions options = RigFixture::options();
  // As the last run of a series: the stage was homed before, and is homed after the lift, without
  // which only an unloading can show lost steps.
  options.config.stage.home = true;
  options.grbl = able_rig(options.truth, options.config).grbl;
  options.grbl.is_homed = true;
  options.truth = demo_truth(ratio, seed);
  options.truth.overload_N = 100.0;  // a cell that breaks would hide how far the force went
  options.truth.surface_position_m = within(random, 0.25e-3, 0.5e-3);
  options.truth.material.E0_Pa *= within(random, 0.8, 1.15);
  // What the rig file states is true within the uncertainties that it states.
  options.truth.frame_stiffness_N_m *= 1.0 + kFrame_u * normal(random);
  options.truth.cell_gain =
      options.config.calibration.volts_per_newton * (1.0 + kGain_u * normal(random));
  options.travel_scale = 1.0 + options.config.stage.depth_relative_u * normal(random);
  options.config.frame.stiffness_relative_u = kFrame_u;
  options.config.calibration.volts_per_newton_u =
      kGain_u * options.config.calibration.volts_per_newton;
  StudyRun run;
  if (is_faulted) run.fault = options.fault = fault_of(seed, random);
  TestPlan plan = short_plan();
  plan.hold_s = 6.0;
  plan.recovery_s = 3.0;
  RigFixture rig(options);
  rig.sink = [&rig](const RunRecord& record) {
    rig.records.push_back(record);
    const auto* event = std::get_if<RunEvent>(&record);
    if (event != nullptr && event->name == "phase") rig.emulated.enter_phase(event->value);
  };
  const Specimen specimen = demo_specimen(ratio);
  try {
    RunControl control;
    control.clock = &rig.clock;
    control.homed_before = HomedStage{kHomedAt_m, kHomedAt_m - kHomeAt_m};  // it begins at 0
    run.outcome =
        run_indentation(rig.stage, rig.load_cell, rig.config, plan, specimen, rig.sink, control);
    run.said = run.outcome.reason;
  } catch (const RigError& error) {  // before anything moved
    run.outcome.status = "refused";
    run.said = error.what();
  }
  for (const std::string& doubt : run.outcome.doubts) run.said += " | " + doubt;
  run.peak_N = rig.emulated.outcome().peak_force_N;
  run.lost_m = rig.emulated.outcome().lost_m;
  run.is_doubtful = run.outcome.status != "finished" || !run.outcome.doubts.empty();
  for (const std::string& name : names_of(run.fault.kind)) {
    run.is_named = run.is_named || run.said.find(name) != std::string::npos;
  }
  if (run.is_doubtful) return run;
  CapturedRun captured;
  captured.rig = rig.config;
  captured.plan = plan;
  captured.specimen = specimen;
  captured.load_samples = rig.all<LoadSample>();
  captured.stage_reports = rig.all<StageReport>();
  captured.moves = rig.all<CommandedMove>();
  captured.events = rig.all<RunEvent>();
  captured.status = run.outcome.status;
  const FitResult fit = fit_indentation(indentation_from_capture(captured), {});
  run.has_fit = true;
  const double E0_Pa = options.truth.material.E0_Pa;
  const Interval interval = combined_intervals(fit).E0_Pa;
  run.holds = interval.low <= E0_Pa && E0_Pa <= interval.high;
  char text[120];
  std::snprintf(text, sizeof text, "E0 %.4f in [%.4f, %.4f] MPa", E0_Pa * 1e-6, interval.low * 1e-6,
                interval.high * 1e-6);
  run.said += text;
  return run;
}

struct StudyRow {
  int runs = 0, finished = 0, doubtful = 0, named = 0, sure = 0, misses = 0;
  double peak = 0.0;  // of the capacity
};

void add(StudyRow& row, const StudyRun& run) {
  ++row.runs;
  row.finished += run.outcome.status == "finished" ? 1 : 0;
  row.doubtful += run.is_doubtful ? 1 : 0;
  row.named += run.is_doubtful && run.is_named ? 1 : 0;
  row.sure += run.is_doubtful ? 0 : 1;
  row.misses += run.has_fit && !run.holds ? 1 : 0;
  row.peak = std::max(row.peak, run.peak_N / demo_rig().calibration.capacity_N);
}

void print(const std::string& name, const StudyRow& row) {
  char text[200];
  std::snprintf(text, sizeof text, "| %s | %d | %d | %d | %d | %d | %d | %.0f %% |\n", name.c_str(),
                row.runs, row.finished, row.doubtful, row.named, row.sure, row.misses,
                100.0 * row.peak);
  std::cout << text;
}

// The table of tests/rig/README.md.
void study(std::uint64_t n_faulted, std::uint64_t n_healthy) {
  std::map<std::string, StudyRow> rows;
  StudyRow faulted, healthy;
  for (std::uint64_t seed = 1; seed <= n_faulted; ++seed) {
    const StudyRun run = study_run(seed, true);
    const std::string name = name_of(run.fault.kind);
    CAPTURE(seed, name, run.fault.phase, run.fault.after_s, run.outcome.status, run.said);
    add(rows[name], run);
    add(faulted, run);
    CHECK(run.peak_N <= demo_rig().calibration.capacity_N);
    // Two steps, and the decimals of the reports.
    constexpr double kUnseen_m = 4e-6;
    CHECK((run.is_doubtful || run.lost_m <= kUnseen_m));
    const bool is_seen = run.is_doubtful ? run.is_named : run.holds;
    if (!is_seen) {
      std::cout << seed << " " << name << "@" << run.fault.phase << "+" << run.fault.after_s << " "
                << run.outcome.status << ": " << run.said << "\n";
    }
  }
  for (std::uint64_t seed = 1; seed <= n_healthy; ++seed) {
    const StudyRun run = study_run(seed, false);
    CAPTURE(seed, run.outcome.status, run.said);
    add(healthy, run);
    CHECK(run.peak_N <= demo_rig().calibration.capacity_N);
    if (run.is_doubtful || !run.holds) std::cout << seed << " healthy: " << run.said << "\n";
  }
  std::cout
      << "| fault | runs | finished | doubtful | named | without a doubt | E0 missed | largest "
         "force |\n|---|---|---|---|---|---|---|---|\n";
  for (const auto& [name, row] : rows) print(name, row);
  print("all faults", faulted);
  print("healthy", healthy);
  CHECK(10 * faulted.named >= 8 * faulted.doubtful);
  CHECK(100 * healthy.doubtful <= 3 * healthy.runs);
  // At most 10 % miss; and no more of the faulted ones than chance allows over the healthy ones.
  CHECK(10 * healthy.misses <= healthy.sure);
  const double share = static_cast<double>(healthy.misses + 1) / (healthy.sure + 1);
  const double likely = share * faulted.sure + 2.0 * std::sqrt(share * faulted.sure);
  CHECK(faulted.misses <= std::ceil(likely));
}

}  // namespace

TEST_CASE("10 faulted and 2 healthy runs: nothing is overloaded, and the fault is named",
          "[rig][pty]") {
  study(10, 2);
}

TEST_CASE("200 faulted and 100 healthy runs: nothing is overloaded, and the fault is named",
          "[rig][pty][slow]") {
  study(200, 100);
}

}  // namespace viscard
