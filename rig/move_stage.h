#pragma once

#include "models/experiment/rig_config.h"
#include "rig/cells/load_cell.h"
#include "rig/lines/record_sink.h"
#include "rig/lines/rig_error.h"
#include "rig/run/run_control.h"
#include "rig/stages/stage.h"

#include <optional>
#include <string>

namespace viscard {

// A move that a person asks for, outside of any test.
struct StageOrder {
  double toward_m = 0.0;  // way toward the specimen; negative: away from it
  double speed_m_s = 0.2e-3;
  // > 0. Toward the specimen the stage stops when the force has changed by this, away from it when
  // the force has risen by this, or pulls with it: a lift ends no sooner than the punch is free.
  double limit_N = 0.0;
  bool is_home = false;  // the controller's homing cycle, before any move
};

// The phase of RunProgress in which forces are counted from the one before the move.
inline constexpr const char* kMovePhase = "move";

struct StageMoved {
  double from_m = 0.0, to_m = 0.0;                   // positions of the controller
  double force_before_N = 0.0, force_after_N = 0.0;  // by the calibration, without a tare
  bool is_stopped_by_force = false;
  // From which a person counts positions: that of the rig file, if the controller keeps its own zero.
  std::optional<double> zero_m;
  std::string note;  // what a person must know of position and cell from now on; may be empty
};

// A move that ended early, with the stage at rest where it stands.
class StageStands : public RigError {
 public:
  StageStands(const std::string& text, double position_m)
      : RigError(text), position_m_(position_m) {}
  double position_m() const { return position_m_; }

 private:
  double position_m_;
};

// Moves the stage while the force is watched as in a test: a limit, a dead cell or a lost port stops
// it. Apart from homing nothing moves if the cell does not measure (findings_at_rest()); toward the specimen nothing
// moves either if something presses already. Throws StageStands with the reason if the stage has moved, otherwise
// RigError.
StageMoved move_stage(Stage& stage, LoadCell& load_cell, const RigConfig& rig,
                      const RecordSink& sink, const RunControl& control, const StageOrder& order);

}  // namespace viscard
