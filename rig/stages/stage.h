#pragma once

#include "rig/lines/record_sink.h"
#include "rig/lines/rig_error.h"
#include "rig/lines/transport.h"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// The stage locked itself (limit switch, reset in motion) and needs recover().
class StageAlarm : public RigError {
 public:
  using RigError::RigError;
};

// Settings of the controller that determine how it moves.
struct StageDynamics {
  double steps_per_m = 0.0;
  double acceleration_m_s2 = 0.0;
  double max_speed_m_s = 0.0;
  double min_speed_m_s = 0.0;  // slower moves are made at this speed
  // The controller refuses positions beyond these, if it checks its travel itself.
  double lowest_m = -std::numeric_limits<double>::infinity();
  double highest_m = std::numeric_limits<double>::infinity();
};

// Time from a position request to its report, wall seconds.
struct ReportLatency {
  int n = 0;
  int n_lost = 0;
  double mean_s = 0.0;
  double longest_s = 0.0;
};

// What homing again shows of the steps that a stage has counted since it was homed.
struct CountCheck {
  double off_m = 0.0;     // the count over the way made, toward the specimen; 0: no step was lost
  double steps = 0.0;     // the same in steps
  double within_m = 0.0;  // a smaller difference shows nothing
};

// What a run of a series knows of the count that the runs before it have left.
struct HomedStage {
  double homed_at_m = 0.0;  // where homing has left the stage
  double stood_at_m = 0.0;  // at the end of the run before
};

// One motorised axis that presses a punch into a specimen. Positions in m from the controller's own
// zero, growing toward the specimen. No call blocks by itself: while it waits for an answer it
// calls `pump`, so that the caller can watch the force. All calls throw PortHungUp, StageAlarm,
// DeviceRestarted or RigError.
class Stage {
 public:
  virtual ~Stage() = default;
  Stage& operator=(Stage&&) = delete;  // neither copied nor moved

  virtual Transport& transport() = 0;

  // Before connect(): the count will be compared by check_count(), so connect() homes this axis alone
  // (and refuses if it cannot), or not at all if an earlier run has homed it. It refuses then
  // if the stage does not stand where that run has left it.
  virtual void plan_count_check(std::optional<HomedStage> /*before*/) {}
  // Before connect(): a controller that is locked stays locked, because nothing will be moved.
  virtual void keep_locked() {}
  // Before connect(): the stage will move away from the specimen only, so what moves toward it need is not proven.
  virtual void plan_lift_only() {}
  // Waits for the controller, identifies it, reads its settings, unlocks it, asks for its position.
  virtual void connect(const Pump& pump) = 0;
  // Handles what has arrived and asks for the position when that is due. Call often.
  virtual void service() = 0;

  virtual StageDynamics dynamics() const = 0;
  // Settings that should be changed and why, one sentence each.
  virtual std::vector<std::string> advice() const = 0;

  virtual ReportLatency report_latency() const = 0;
  // Name and version as the controller reports them.
  virtual std::string identity() const = 0;

  // At rest the exact end of the last move, while moving the last reported position.
  virtual double position_m() const = 0;

  // Begins a move. to_m is rounded to whole steps; a move away from the specimen ends at the end of
  // the controller's travel. purpose names the move in its CommandedMove record, which is passed to
  // the sink when the move has ended, because its start is known best then. Precondition: at rest.
  virtual void begin_move(double to_m, double speed_m_s, const std::string& purpose) = 0;
  // From begin_move() until the controller has reported standstill.
  virtual bool is_moving() const = 0;
  // Rig time at which the current or last move should end.
  virtual double expected_end_s() const = 0;

  // How much later than its settings say the stage was in the last move, if that is more than its
  // clock and its answers explain; the record then holds a course that it did not take. 0: it was
  // not.
  virtual double lag_s() const { return 0.0; }

  // Decelerates; is_moving() is true until standstill.
  virtual void stop_soft() = 0;
  // Stops at once even if steps are lost; recover() must follow.
  virtual void stop_hard() = 0;
  // After stop_hard() or an alarm: unlocks the stage and asks for its position.
  virtual void recover(const Pump& pump) = 0;

  // Why position_m() will mean another place when the stage is connected again; empty if the
  // controller keeps its zero.
  virtual std::string trouble_with_zero() const { return ""; }
  // True if the controller was unlocked although it is not homed, as far as this connection knows.
  // It cannot report that to the next one, which would take its count for that of a homed stage.
  virtual bool is_unlocked_unhomed() const { return false; }
  // True if position_m() is measured by an encoder, false if it is a count of steps.
  virtual bool measures_position() const { return false; }
  // Where the last homing left the stage.
  virtual std::optional<double> homed_at_m() const { return std::nullopt; }
  // Why check_count() cannot work with this controller and its settings; empty if it can, or if the
  // driver has none. Moves nothing.
  virtual std::string trouble_with_count_check(const Pump& /*pump*/) { return ""; }
  // Goes to the limit switch by the count, homes this axis alone, and goes there again. The punch
  // must be lifted. Nothing if this driver cannot compare them. An exception ends a homing cycle,
  // but a move goes on until the caller stops it.
  virtual std::optional<CountCheck> check_count(const Pump& /*pump*/) { return std::nullopt; }
};

}  // namespace viscard
