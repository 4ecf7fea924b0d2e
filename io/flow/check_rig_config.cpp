#include "io/flow/check_rig_config.h"

#include "io/basics/timestamp.h"
#include "io/flow/open_rig.h"

namespace viscard {

RigCheck check_rig_config(RigConfig rig, bool is_emulated, double seconds) {
  rig.stage.home = false;  // a check moves nothing
  OpenRig open(rig, is_emulated);
  RigDevices& devices = open.devices();
  return check_rig(*devices.stage, *devices.load_cell, open.config(), open.clock(), seconds,
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
