#include "rig/run/count_comparison.h"

#include "models/maths/failure_text.h"
#include "models/maths/text_of_number.h"

#include <cmath>

namespace viscard {
namespace {

std::string micrometres_of(double length_m) {
  return text_from_number(std::abs(length_m) * 1e6, 1) + " um";
}

// Everything else ends a run in any phase.
bool is_of_homing(const RigError& error) {
  return dynamic_cast<const LimitReached*>(&error) == nullptr &&
         dynamic_cast<const RunInterrupted*>(&error) == nullptr &&
         dynamic_cast<const PortHungUp*>(&error) == nullptr &&
         dynamic_cast<const CellIsDead*>(&error) == nullptr &&
         dynamic_cast<const CellIsSilent*>(&error) == nullptr;
}

}  // namespace

std::string lost_steps_doubt(const CountCheck& found) {
  if (std::abs(found.off_m) <= found.within_m) return "";
  const bool has_lost_pressing = found.off_m > 0.0;
  return "the stage has lost steps while it " +
         std::string(has_lost_pressing ? "pressed" : "lifted") + ": homed after the lift, it was " +
         micrometres_of(found.off_m) + " (" + text_from_number(std::abs(found.steps), 0) +
         " steps) " + (has_lost_pressing ? "further from" : "nearer to") +
         " the specimen than it counted. Depth and modulus are then wrong. Lower the speed or the "
         "acceleration, or raise the motor's current";
}

std::string compare_count(RunSession& session, const RigConfig& rig, const RunControl& control,
                          RunOutcome& outcome) {
  Stage& stage = session.stage();
  if (const auto homed_at_m = stage.homed_at_m()) {
    outcome.homed = HomedStage{*homed_at_m, stage.position_m()};
  }
  if (stage.measures_position() || !rig.stage.home || !control.homes_after) return kNotHomed;
  if (!outcome.doubts.empty()) return "the run is doubtful, so the stage was not homed after it";
  if (!stage.homed_at_m()) return "this driver does not compare the count with a switch";
  session.begin_phase(kHomePhase, 0.0, "Homing the stage, which shows whether it has lost steps");
  try {
    outcome.count = stage.check_count([&] { session.pump(); });
  } catch (const RigError& error) {
    if (!is_of_homing(error)) throw;
    session.stop_if_moving();
    outcome.doubts.push_back(
        "the stage could not be homed after the lift, so whether it has lost steps is not known: " +
        failure_text(error, "the homing") + ". Look at the punch before the next run");
    session.event("doubt", "not_homed", outcome.doubts.back());
    return "the stage could not be homed";
  }
  if (!outcome.count) return kNotHomed;
  const std::string doubt = lost_steps_doubt(*outcome.count);
  if (doubt.empty()) return "";
  outcome.doubts.push_back(doubt);
  session.event("doubt", kLostStepsDoubt, doubt);
  return "the count was wrong";
}

void record_depth(RunSession& session, const std::string& why, RunOutcome& outcome) {
  if (!session.is_stage_connected()) return;
  if (session.stage().measures_position()) {
    outcome.depth_is = "measured";
    return session.event("depth", outcome.depth_is, "The stage measures its position");
  }
  if (why.empty()) outcome.depth_is = "compared";
  session.event("depth", outcome.depth_is,
                why.empty()
                    ? "Counted in steps; homed after the lift, the stage stood there within " +
                          micrometres_of(outcome.count->within_m)
                    : "Counted in steps, not measured (" + why + ")");
}

}  // namespace viscard
