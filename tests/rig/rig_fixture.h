#pragma once

#include "models/experiment/test_plan.h"
#include "rig/cells/hx711_load_cell.h"
#include "rig/emulator/demo_rig.h"
#include "rig/emulator/emulated_rig.h"
#include "rig/lines/serial_line.h"
#include "rig/run_indentation.h"
#include "rig/stages/grbl_stage.h"
#include "tests/rig/line_faults.h"
#include "tests/rig/records_of.h"

#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace viscard {

// An emulated rig with real drivers on its ports, or behind disturbed lines. Keeps all records.
struct RigFixture {
  explicit RigFixture(const EmulatedRigOptions& options,
                      const std::optional<LineFaults>& faults = std::nullopt, double patience = 1.0)
      : emulated(options),
        config(config_behind(emulated, faults, stage_proxy, cell_proxy)),
        clock(emulated.clock()),
        stage_line(config.stage.port, 115200, clock),
        cell_line(config.load_cell.port, 115200, clock),
        sink([this](const RunRecord& record) {
          records.push_back(record);
          if (on_record) on_record(record);
        }),
        stage(stage_line, config.stage, clock, sink, patience),
        load_cell(cell_line, config.load_cell, clock, sink) {}

  // A rig that waits for the test, as fast as the computer can.
  static EmulatedRigOptions options() {
    EmulatedRigOptions result;
    result.truth = demo_truth(10.0, 7);
    result.config = demo_rig();
    result.config.clock_speed = 500.0;
    return result;
  }
  // For tests of delays of the computer or of the rig.
  static EmulatedRigOptions on_wall_clock(double speed) {
    EmulatedRigOptions result = options();
    result.config.clock_speed = speed;
    result.is_on_wall_clock = true;
    return result;
  }

  // Serves the stage alone, or both devices.
  Pump pump() {
    return [this] {
      wait_readable({&stage_line, &cell_line}, clock, 0.002);
      load_cell.service();
      stage.service();
    };
  }

  RunOutcome run(const TestPlan& plan, double ratio = 10.0) {
    return run(plan, demo_specimen(ratio));
  }

  RunOutcome run(const TestPlan& plan, const Specimen& specimen) {
    RunControl control;
    control.clock = &clock;
    control.stop = &stop;
    control.progress = on_progress;
    control.lifts_at_start = lifts_at_start;
    return run_indentation(stage, load_cell, config, plan, specimen, sink, control);
  }

  template <class Record>
  std::vector<Record> all() const {
    return records_of<Record>(records);
  }

  bool has_event(const std::string& name, const std::string& value) const {
    for (const RunEvent& event : all<RunEvent>()) {
      if (event.name == name && event.value == value) return true;
    }
    return false;
  }

  EmulatedRig emulated;
  std::unique_ptr<FaultProxy> stage_proxy, cell_proxy;
  RigConfig config;
  RigClock clock;
  SerialLine stage_line;
  SerialLine cell_line;
  std::vector<RunRecord> records;
  RecordSink sink;
  GrblStage stage;
  Hx711LoadCell load_cell;
  std::atomic<bool> stop{false};
  bool lifts_at_start = false;
  std::function<void(const RunProgress&)> on_progress;
  std::function<void(const RunRecord&)> on_record;  // of the drivers, also without a run
};

inline void move_and_wait(RigFixture& rig, double to_m, double speed_m_s) {
  rig.stage.begin_move(to_m, speed_m_s, "test");
  const Pump pump = rig.pump();
  while (rig.stage.is_moving()) pump();
}

inline void pump_for(RigFixture& rig, double wall_s) {
  const double until_s = rig.clock.awake_s() + wall_s;
  const Pump pump = rig.pump();
  while (rig.clock.awake_s() < until_s) pump();
}

// Calls a function when a phase begins.
inline void when_phase(RigFixture& rig, const std::string& phase,
                       const std::function<void()>& action) {
  rig.sink = [&rig, phase, action](const RunRecord& record) {
    rig.records.push_back(record);
    const auto* event = std::get_if<RunEvent>(&record);
    if (event != nullptr && event->name == "phase" && event->value == phase) action();
  };
}

// A test of a few emulated seconds.
inline TestPlan short_plan() {
  TestPlan plan;
  plan.approach_speed_m_s = 0.2e-3;
  plan.baseline_s = 1.0;
  plan.hold_s = 3.0;
  plan.recovery_s = 2.0;
  return plan;
}

}  // namespace viscard
