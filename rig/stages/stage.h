#pragma once

#include "rig/lines/record_sink.h"
#include "rig/lines/rig_error.h"
#include "rig/lines/transport.h"

#include <limits>
#include <string>
#include <vector>

namespace viscard {

// The stage locked itself (limit switch, reset in motion): it needs recover().
class StageAlarm : public RigError {
 public:
  using RigError::RigError;
};

// How the controller moves, by its own settings.
struct StageDynamics {
  double steps_per_m = 0.0;
  double acceleration_m_s2 = 0.0;
  double max_speed_m_s = 0.0;
  double min_speed_m_s = 0.0;  // what is asked to go slower goes at this speed
  // Positions beyond which the controller refuses to go, where it watches over its travel itself.
  double lowest_m = -std::numeric_limits<double>::infinity();
  double highest_m = std::numeric_limits<double>::infinity();
};

// Time from a question for the position to its answer, wall seconds.
struct ReportLatency {
  int n = 0;
  int n_lost = 0;
  double mean_s = 0.0;
  double longest_s = 0.0;
};

// One motorised axis that presses a punch into a specimen. Positions in m, growing toward the
// specimen, from the controller's own zero. Nothing here waits by itself: where an answer is
// needed, `pump` is called until it is there, so that the caller can watch the force meanwhile. All
// calls throw PortHungUp, StageAlarm, DeviceRestarted or RigError.
class Stage {
 public:
  virtual ~Stage() = default;
  Stage() = default;
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  virtual Transport& transport() = 0;

  // Waits for the controller, identifies it, reads its settings back, unlocks it, asks where it is.
  virtual void connect(const Pump& pump) = 0;
  // Reads and interprets what has arrived, asks for the position when that is due. Call often.
  virtual void service() = 0;

  virtual StageDynamics dynamics() const = 0;
  // What in its settings should be changed and why, one sentence each.
  virtual std::vector<std::string> advice() const = 0;

  virtual ReportLatency report_latency() const = 0;
  // Maker's name and version as the controller gives them.
  virtual std::string identity() const = 0;

  // Where it is: the exact end of the last move at rest, the last report while moving.
  virtual double position_m() const = 0;

  // Begins a move; to_m is rounded to whole steps, and one away from the specimen ends where the
  // controller's travel does. purpose names it in its CommandedMove record,
  // which is handed out when the move has ended (its start is known best then). Precondition: at
  // rest.
  virtual void begin_move(double to_m, double speed_m_s, const std::string& purpose) = 0;
  // From begin_move() until the controller has reported standstill.
  virtual bool is_moving() const = 0;
  // Rig time at which the current or last move should end.
  virtual double expected_end_s() const = 0;

  // Decelerates to standstill; is_moving() tells when that is reached.
  virtual void stop_soft() = 0;
  // Stops at once, whatever that costs in steps; recover() must follow.
  virtual void stop_hard() = 0;
  // After stop_hard() or an alarm: unlocks, and asks where it is.
  virtual void recover(const Pump& pump) = 0;
};

}  // namespace viscard
