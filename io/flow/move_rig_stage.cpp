#include "io/flow/move_rig_stage.h"

#include "rig/emulator/demo_rig.h"
#include "rig/emulator/emulated_rig.h"
#include "rig/open_devices.h"

#include <memory>

namespace viscard {

StageMoved move_rig_stage(RigConfig rig, bool is_emulated, const StageOrder& order,
                          const std::atomic<bool>* stop) {
  std::unique_ptr<EmulatedRig> emulated;
  if (is_emulated) {
    emulated = std::make_unique<EmulatedRig>(
        EmulatedRigOptions{.truth = demo_truth(10.0, 1), .config = rig});
    rig = emulated->config();
  }
  const RigClock clock = emulated ? emulated->clock() : RigClock(rig.clock_speed);
  const RecordSink nowhere = [](const RunRecord&) {};
  rig.stage.home = order.is_home;
  RigDevices devices = open_ports(rig, clock);
  add_drivers(devices, rig, clock, nowhere);
  RunControl control;
  control.clock = &clock;
  control.stop = stop;
  return move_stage(*devices.stage, *devices.load_cell, rig, nowhere, control, order);
}

}  // namespace viscard
