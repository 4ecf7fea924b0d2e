#include "io/flow/move_rig_stage.h"

#include "io/flow/open_rig.h"

namespace viscard {

StageMoved move_rig_stage(RigConfig rig, bool is_emulated, const StageOrder& order,
                          const std::atomic<bool>* stop) {
  rig.stage.home = order.is_home;
  OpenRig open(rig, is_emulated);
  RunControl control;
  control.clock = &open.clock();
  control.stop = stop;
  return move_stage(
      *open.devices().stage, *open.devices().load_cell, open.config(), [](const RunRecord&) {},
      control, order);
}

}  // namespace viscard
