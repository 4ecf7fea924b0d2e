#include "rig/move_stage.h"

#include "models/maths/failure_text.h"
#include "models/maths/text_of_number.h"
#include "rig/lines/rig_error.h"
#include "rig/run/approach_phase.h"
#include "rig/run/rest_findings.h"
#include "rig/run/run_session.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace viscard {
namespace {

constexpr double kRest_s = 1.0;  // of readings before a move

std::string in_mm(double way_m) {
  return text_from_number(way_m * 1e3, 4) + " mm";
}

// What forbids the move. A lift is allowed under a force, because it is what ends it.
void refuse(const RestReadings& seen, const RigConfig& rig, bool is_toward) {
  for (const RestFinding& found : findings_at_rest(seen, rig)) {
    if (found.about == RestFinding::About::kForce && !is_toward) continue;
    throw RigError(found.text);
  }
  if (is_toward && !is_proven_by_noise(seen) && rig.load_cell.answered_on.empty()) {
    throw RigError(
        "the readings of the load cell do not vary, so nothing shows that it measures. Touch it "
        "once with: viscard rig touch");
  }
}

// Behind an error, or nothing.
std::string behind(const std::string& text) {
  return text.empty() ? "" : "; " + text;
}

// The next command finds an unlocked controller, so only this one can warn.
std::string note_of(const Stage& stage) {
  if (!stage.is_unlocked_unhomed()) return "";
  return "the stage was locked and has been unlocked without homing, so its position counts from "
         "where it stood, and rig set-zero cannot notice that later. Home it with: viscard rig "
         "home";
}

// In the short jogs of an approach, because nothing is known of what lies in the way. True if the
// force stopped it.
bool press(RunSession& session, double from_m, const StageOrder& order) {
  Stage& stage = session.stage();
  const double jog_m = std::max(kLongestJog_m, 1.01 / stage.dynamics().steps_per_m);
  const double to_m = from_m + order.toward_m;
  const double rounding_m = 0.5 / stage.dynamics().steps_per_m;
  for (double before_m = -1e300; stage.position_m() < to_m - rounding_m;) {
    if (stage.position_m() <= before_m) break;  // less than one step is left
    before_m = stage.position_m();
    const double next_m = std::min(to_m, before_m + jog_m);
    if (session.move(next_m, order.speed_m_s, "press", order.limit_N)) return true;
  }
  return false;
}

}  // namespace

StageMoved move_stage(Stage& stage, LoadCell& load_cell, const RigConfig& rig,
                      const RecordSink& sink, const RunControl& control, const StageOrder& order) {
  RigConfig used = rig;
  used.stage.home = order.is_home;
  RunSession session(stage, load_cell, used, sink, control);
  StageMoved moved;
  const bool is_lift = !order.is_home && order.toward_m < 0.0;
  if (is_lift) stage.plan_lift_only();
  try {
    session.connect();
    if (rig.stage.zero_m != 0.0 && stage.trouble_with_zero().empty()) {
      moved.zero_m = rig.stage.zero_m;
    }
    session.begin_phase("rest", 0.0, "The force before a move outside of any test");
    session.forget_readings();
    const ForceMean rest = session.tare(kRest_s);
    session.begin_phase(kMovePhase,
                        order.is_home ? 0.0 : kRest_s + std::abs(order.toward_m) / order.speed_m_s,
                        "A move outside of any test");
    moved.force_before_N = rest.force_N;
    moved.from_m = stage.position_m();
    moved.note = note_of(stage);
    if (order.is_home) {
      moved.to_m = moved.from_m;
      moved.force_after_N = moved.force_before_N;
      return moved;
    }
    const bool is_toward = order.toward_m > 0.0;
    refuse({rest.force_N, rest.sd_N, rest.drift, rest.rate_Hz, session.life_signs()}, rig,
           is_toward);
    session.watch_life();
    moved.is_stopped_by_force = is_toward ? press(session, moved.from_m, order)
                                          : session.lift(moved.from_m + order.toward_m,
                                                         order.speed_m_s, "lift", order.limit_N);
    moved.force_after_N = moved.force_before_N + session.mean_force(kRest_s).force_N;
    moved.to_m = stage.position_m();
    const bool has_answered = control.has_answered || !rig.load_cell.answered_on.empty();
    if (is_toward && !moved.is_stopped_by_force && !has_answered) {
      moved.note += (moved.note.empty() ? "" : "; ") +
                    std::string("the stage went its whole way and no force was felt, but ") +
                    kUnanswered;
    }
  } catch (const RigError& error) {
    const bool is_asked_for = dynamic_cast<const RunInterrupted*>(&error) != nullptr;
    // A force above the limit that presses at rest is what a lift ends.
    const bool is_relief = is_lift && !session.has_moved() && session.is_stage_connected() &&
                           session.is_pressed() && (control.stop == nullptr || !*control.stop) &&
                           dynamic_cast<const LimitReached*>(&error) != nullptr;
    if (!is_relief && (!session.is_stage_connected() || !session.has_moved())) {
      const std::string note = session.is_stage_connected() ? behind(note_of(stage)) : "";
      if (is_asked_for && order.is_home && !session.is_stage_connected()) {
        throw RigError(
            "the homing was stopped: the stage is not homed and stands where it was stopped. Look "
            "at the punch, lift it with: viscard rig lift");
      }
      if (is_asked_for) throw RigError("the move was stopped before it began" + note);
      if (note.empty()) throw;
      throw RigError(failure_text(error, "this move") + note);
    }
    const double stood_m = stage.position_m();
    const double back_m = is_relief       ? stood_m + order.toward_m
                          : order.is_home ? stood_m
                                          : std::min(moved.from_m, stood_m);
    const SafeEnd end = session.make_safe(back_m, order.speed_m_s);
    throw StageStands((is_asked_for ? "the move was stopped" : failure_text(error, "this move")) +
                          (is_relief && end.lifted_m > 0.0 ? ". The stage was lifted to "
                                                           : ". The stage was stopped at ") +
                          in_mm(stage.position_m()) + behind(end.trouble) + behind(note_of(stage)),
                      stage.position_m());
  }
  return moved;
}

}  // namespace viscard
