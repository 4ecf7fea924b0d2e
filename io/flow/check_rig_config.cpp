#include "io/flow/check_rig_config.h"

#include "io/basics/timestamp.h"
#include "rig/emulator/demo_rig.h"
#include "rig/emulator/emulated_rig.h"
#include "rig/open_devices.h"

#include <memory>

namespace viscard {

RigCheck check_rig_config(RigConfig rig, bool is_emulated, double seconds) {
  std::unique_ptr<EmulatedRig> emulated;
  if (is_emulated) {
    emulated = std::make_unique<EmulatedRig>(
        EmulatedRigOptions{.truth = demo_truth(10.0, 1), .config = rig});
    rig = emulated->config();
  }
  const RigClock clock = emulated ? emulated->clock() : RigClock(rig.clock_speed);
  const RecordSink nowhere = [](const RunRecord&) {};
  rig.stage.home = false;  // a check moves nothing
  RigDevices devices = open_ports(rig, clock);
  add_drivers(devices, rig, clock, nowhere);
  return check_rig(*devices.stage, *devices.load_cell, rig, clock, seconds,
                   devices.thermometer.get());
}

void add_calibration(const RigConfig& rig, RigCheck& found) {
  if (rig.calibration.largest_force_N == 0.0) {
    found.advice.push_back(
        "the load cell's calibration does not state the range of force in which it was made "
        "(largest_force), so a force beyond it is not noticed. A new record of viscard calibrate "
        "states it");
  }
  const std::string trouble = calibration_trouble(rig.calibration, today());
  if (trouble.empty()) return;
  found.advice.push_back(trouble);
  if (!last_valid_day(rig.calibration).empty()) found.is_usable = false;
}

}  // namespace viscard
