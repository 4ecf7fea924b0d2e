#include "io/basics/atomic_file.h"
#include "io/basics/option_use.h"
#include "io/capture/capture_file.h"
#include "io/capture/capture_header.h"
#include "io/capture/integrity_notes.h"
#include "io/cli/rig/calibrate_words.h"
#include "io/cli/words/json_output.h"
#include "io/cli/words/stop_on_signal.h"
#include "io/flow/calibrate.h"
#include "io/flow/damaged_table.h"
#include "io/tables/csv_table.h"
#include "rig/emulator/emulated_rig.h"
#include "rig/open_devices.h"
#include "rig/run_indentation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <variant>

namespace viscard {
namespace {

constexpr double kBlock_Pa = 200e9;       // steel, much stiffer than any frame
constexpr double kUsualFrame_N_m = 10e3;  // assumed for a rig file without a frame stiffness
constexpr double kShareOfLimit = 0.7;
constexpr double kPunch_m = 2e-3;

Specimen rigid_block() {
  Specimen block;
  block.id = "rigid block";
  block.modulus_guess_Pa = kBlock_Pa;
  block.contact.punch_radius_m = kPunch_m;
  block.contact.poisson_ratio = 0.3;
  return block;
}

TestPlan block_plan(const CalibrateWords& words, const RigConfig& rig) {
  TestPlan plan;
  plan.name = "frame stiffness";
  plan.protocol = "compliance";
  plan.baseline_s = 1.0;
  plan.compliance.steps = words.steps;
  plan.compliance.hold_s = words.mean_s;
  plan.compliance.force_N =
      words.force_N > 0.0 ? words.force_N
                          : kShareOfLimit * rig.safety.soft_fraction * rig.calibration.capacity_N;
  return plan;
}

// Keeps the records that the fit needs.
struct KeepRecords {
  CapturedRun& run;
  void operator()(const RawBytes& raw) const { run.n_raw_bytes += raw.bytes.size(); }
  void operator()(const LoadSample& sample) const { run.load_samples.push_back(sample); }
  void operator()(const StageReport& report) const { run.stage_reports.push_back(report); }
  void operator()(const CommandedMove& move) const { run.moves.push_back(move); }
  void operator()(const RunEvent& event) const { run.events.push_back(event); }
  void operator()(const TemperatureSample& sample) const { run.temperatures.push_back(sample); }
};

CapturedRun press_block(const CalibrateWords& words, RigConfig rig) {
  std::unique_ptr<EmulatedRig> emulated;
  if (rig.frame.stiffness_N_m == 0.0) rig.frame.stiffness_N_m = kUsualFrame_N_m;
  const Specimen block = rigid_block();
  if (words.is_emulated) {
    EmulatedTruth truth = calibrate_truth(words);
    truth.material.E0_Pa = kBlock_Pa;
    truth.material.terms.clear();
    truth.contact = block.contact;
    emulated = std::make_unique<EmulatedRig>(able_rig(truth, rig));
    rig = emulated->config();
  }
  const StopOnSignal on_signal;
  const RigClock clock = emulated ? emulated->clock() : RigClock(rig.clock_speed);
  CapturedRun run;
  run.rig = rig;
  run.plan = block_plan(words, rig);
  run.specimen = block;
  const RecordSink sink = [&run](const RunRecord& record) { std::visit(KeepRecords{run}, record); };
  RigDevices devices = open_ports(rig, clock);
  add_drivers(devices, rig, clock, sink);
  RunControl control;
  control.clock = &clock;
  control.stop = &StopOnSignal::is_asked();
  control.thermometer = devices.thermometer.get();
  const RunOutcome outcome =
      run_indentation(*devices.stage, *devices.load_cell, rig, run.plan, block, sink, control);
  if (outcome.status != "finished") throw std::runtime_error(outcome.reason);
  return run;
}

void wait_for_block(const CalibrateWords& words, Streams& streams) {
  if (words.is_emulated || words.asks_nobody) return;
  streams.err
      << "Put a block of steel or glass under the punch, with nothing soft between them, and "
         "press Enter: "
      << std::flush;
  std::string answer;
  if (!std::getline(std::cin, answer)) throw std::runtime_error("nothing was measured");
}

void say_damage(const std::string& file, const std::vector<IntegrityNote>& notes,
                Streams& streams) {
  for (const IntegrityNote& note : notes) {
    streams.err << "viscard: " << file << ": " << note.text << "\n";
  }
}

void print(const FrameCalibration& frame, const CalibrateWords& words, Streams& streams) {
  if (words.as_json) {
    print_result(
        {"viscard-calibrate-frame/1", inputs_of(words)},
        [&](ResultVisitor& v) { show_keys(v, frame, words.out_file); }, streams, -1);
    return;
  }
  const FrameStiffnessFit& fit = frame.fit;
  streams.out << fmt::format("stiffness   {:.4g} N/mm, {:.4g} to {:.4g} (k = 2)\n",
                             fit.stiffness_N_m * 1e-3, fit.low_N_m * 1e-3, fit.high_N_m * 1e-3)
              << (fit.seating_m > 0.0
                      ? fmt::format("seating     the block settled by {:.1f} um under the first "
                                    "forces; fitted\n",
                                    1e6 * fit.seating_m)
                      : std::string())
              << fmt::format("curvature   {:.2f} um off the straight line at most, {} points\n",
                             fit.curvature_m * 1e6, fit.n_points)
              << fmt::format("{}: '{}'\n", words.out_file, frame.record.frame->id);
}

}  // namespace

DescribedResult result_of_frame() {
  return {"calibrate-frame", "viscard calibrate --compliance", {[](ResultVisitor& v) {
            show_keys(v, FrameCalibration{}, "");
          }}};
}

int calibrate_frame(const CalibrateWords& words, Streams& streams) {
  CalibrationRequest request = words.request;
  if (words.data_file) request.where = *words.data_file + ": ";
  BlockPoints points;
  std::optional<RigConfig> rig;  // whose gain is known
  if (words.data_file && looks_like_capture(*words.data_file)) {
    refuse_idle({{*words.data_file + ": --rig", words.rig_file.has_value(), false,
                  "tables, and this capture has its rig"}});
    const CapturedRun run =
        read_capture(*words.data_file, {.accepts_damage = words.accepts_unverified});
    say_damage(*words.data_file, integrity_notes(run), streams);
    points = block_points_from_capture(run);
    rig = run.rig;
  } else if (words.data_file) {
    CsvTable table = read_csv(*words.data_file);
    refuse_unverified(table, words);
    say_damage(*words.data_file, accepted_damage(table, words.accepts_unverified), streams);
    table = complete_rows(std::move(table), true, streams);
    points = block_points_from_table(table);
    if (words.rig_file) rig = read_rig(*words.rig_file, words.plausible);
  } else {
    rig = calibrate_rig(words);
    wait_for_block(words, streams);
    points = block_points_from_capture(press_block(words, *rig));
  }
  const FrameCalibration frame =
      calibrated_frame(points, gain_relative_u(points, rig ? &*rig : nullptr), request);
  write_file(words.out_file, toml_from_calibration(frame.record), words.overwrite);
  print(frame, words, streams);
  return kDone;
}

}  // namespace viscard
