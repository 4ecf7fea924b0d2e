#pragma once

#include "rig/emulator/demo_rig.h"
#include "rig/emulator/emulated_rig.h"
#include "rig/open_devices.h"
#include "rig/run_indentation.h"
#include "tests/rig/line_faults.h"
#include "tests/rig/records_of.h"

#include <atomic>
#include <string>
#include <vector>

namespace viscard {

// An emulated rig with the drivers that its rig file names, perhaps behind disturbed lines.
struct DeviceFixture {
  explicit DeviceFixture(const EmulatedRigOptions& options,
                         const std::optional<LineFaults>& faults = std::nullopt)
      : emulated(options),
        config(config_behind(emulated, faults, stage_proxy, cell_proxy)),
        clock(emulated.clock()),
        devices(open_ports(config, clock)),
        sink([this](const RunRecord& record) { records.push_back(record); }) {
    add_drivers(devices, config, clock, sink);
  }

  static EmulatedRigOptions options(const std::string& stage = "grbl",
                                    const std::string& cell = "hx711") {
    EmulatedRigOptions result;
    result.truth = demo_truth(10.0, 7);
    result.config = demo_rig();
    result.config.clock_speed = 500.0;  // it waits: as fast as the computer can
    result.config.stage.driver = stage;
    result.config.load_cell.driver = cell;
    if (cell != "hx711" && cell != "scpi") result.config.calibration.volts_per_newton = 1.0;
    return result;
  }

  Pump pump() {
    return [this] {
      wait_readable({devices.stage_line.get(), devices.cell_line.get()}, clock, 0.002);
      devices.load_cell->service();
      devices.stage->service();
      if (devices.thermometer) devices.thermometer->service();
    };
  }
  void pump_for(double wall_s) {
    const double until_s = clock.awake_s() + wall_s;
    while (clock.awake_s() < until_s) pump()();
  }
  // Moves and waits, at most for some seconds.
  bool move(double to_m, double speed_m_s) {
    devices.stage->begin_move(to_m, speed_m_s, "test");
    const double until_s = clock.awake_s() + 30.0;
    while (devices.stage->is_moving() && clock.awake_s() < until_s) pump()();
    return !devices.stage->is_moving();
  }

  RunOutcome run(const TestPlan& plan) {
    RunControl control;
    control.clock = &clock;
    control.stop = &stop;
    control.thermometer = devices.thermometer.get();
    return run_indentation(*devices.stage, *devices.load_cell, config, plan, demo_specimen(10.0),
                           sink, control);
  }

  template <class Record>
  std::vector<Record> all() const {
    return records_of<Record>(records);
  }

  EmulatedRig emulated;
  std::unique_ptr<FaultProxy> stage_proxy, cell_proxy;
  RigConfig config;
  RigClock clock;
  std::vector<RunRecord> records;
  std::atomic<bool> stop{false};
  RigDevices devices;
  RecordSink sink;
};

}  // namespace viscard
