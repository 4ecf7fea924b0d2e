#include "rig/run/count_comparison.h"

#include "models/maths/failure_text.h"
#include "models/maths/text_of_number.h"

#include <cmath>

namespace viscard {
namespace {

std::string micrometres_of(double length_m) {
  return text_from_number(std::abs(length_m) * 1e6, 1) + " um";
}

void note_count(RunSession& session, const std::string& value, const std::string& text) {
  session.event("count", value, text);
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

void compare_count(RunSession& session, const RigConfig& rig, const RunControl& control,
                   RunOutcome& outcome) {
  if (!session.is_stage_connected()) return;
  Stage& stage = session.stage();
  outcome.homed_at_m = stage.homed_at_m();
  if (stage.measures_position()) outcome.depth_is = "measured";
  if (outcome.status != "finished" || !rig.stage.home || !control.homes_after) return;
  if (!outcome.doubts.empty()) {
    return note_count(session, "not_compared",
                      "The run is doubtful, so the stage was not homed after it");
  }
  if (!stage.homed_at_m()) {
    return note_count(session, "not_compared",
                      "This driver does not compare the stage's count with its switch");
  }
  session.begin_phase(kHomePhase, 0.0, "Homing the stage, which shows whether it has lost steps");
  try {
    outcome.count = stage.check_count([&] { session.pump(); });
  } catch (const RigError& error) {
    outcome.doubts.push_back(
        "the stage could not be homed after the lift, so whether it has lost steps is not known: " +
        failure_text(error, "the homing"));
    return session.event("doubt", "not_homed", outcome.doubts.back());
  }
  if (!outcome.count) return;
  const std::string doubt = lost_steps_doubt(*outcome.count);
  if (!doubt.empty()) {
    outcome.doubts.push_back(doubt);
    return session.event("doubt", kLostSteps, doubt);
  }
  outcome.depth_is = "compared";
  note_count(session, text_from_number(outcome.count->off_m, 9),
             "Homed after the lift, the stage stood where it counted, within " +
                 micrometres_of(outcome.count->within_m));
}

}  // namespace viscard
