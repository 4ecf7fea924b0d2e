#pragma once

#include "rig/lines/rig_clock.h"
#include "rig/lines/rig_error.h"
#include "rig/stages/stage.h"

#include <atomic>
#include <functional>
#include <optional>
#include <string>

namespace viscard {

// What a person at the rig sees of a run, several times a second. Times in rig seconds.
struct RunProgress {
  double time_s = 0.0;  // since the run began
  std::string phase;
  double fraction = 0.0;  // of the whole run, by time
  double force_N = 0.0;   // newest force from the tare
  double depth_m = 0.0;   // indentation by the live contact point; 0 before contact
  double time_left_s = 0.0;
};

// One reading of the load cell that is not doubtful.
struct RunReading {
  double time_s = 0.0;   // when it was made, in rig seconds since the run began
  double force_N = 0.0;  // from the tare
  double depth_m = 0.0;  // depth, as in RunProgress
};

class Thermometer;

// How a run is observed and ended from outside.
struct RunControl {
  const RigClock* clock = nullptr;          // the one the devices were made with
  const std::atomic<bool>* stop = nullptr;  // set by a signal handler to end the run
  // Stops the stage at once, without braking, also if it is braking because of `stop`.
  const std::atomic<bool>* stop_at_once = nullptr;
  std::function<void(const RunProgress&)> progress;  // may be empty
  std::function<void(const RunReading&)> reading;    // every one; may be empty
  // A punch that presses before the test is lifted in any case; then the test goes on instead of
  // ending.
  bool lifts_at_start = false;
  // The load cell has answered to a force today: it is an emulated one, or an earlier run of the
  // series has found the specimen.
  bool has_answered = false;
  Thermometer* thermometer = nullptr;  // read beside the run; may be nullptr
  // With home = true under [stage], and for a series of runs: what an earlier one that has homed
  // the stage has left (RunOutcome::homed), so that this one does not; and whether this one homes
  // it after its lift. Between the runs of a series the stage is not homed: drivers without a
  // comparison then get home = false.
  std::optional<HomedStage> homed_before;
  bool homes_after = true;
};

// The phase after a test in which the stage is homed.
inline constexpr const char* kHomePhase = "home";

// A person asked the run to end.
class RunInterrupted : public RigError {
 public:
  using RigError::RigError;
};

// The newest reading of the load cell is too old for the stage to go on pressing.
class ReadingsTooOld : public RigError {
 public:
  using RigError::RigError;
};

// The readings of the load cell go on but measure nothing any more.
class CellIsDead : public RigError {
 public:
  using RigError::RigError;
};

// The load cell sends no readings any more; a moving stage has been stopped.
class CellIsSilent : public RigError {
 public:
  using RigError::RigError;
};

// The stage counts a move that the force does not show: its motor stands, or the cell is blind.
class ForceDoesNotFollow : public RigError {
 public:
  using RigError::RigError;
};

// The force rose in a move away from the specimen, so no further one may follow.
class StageGoesWrongWay : public RigError {
 public:
  using RigError::RigError;
};

// After the last lift the force says that the punch still presses.
class PunchNotFree : public RigError {
 public:
  using RigError::RigError;
};

// The computer was late while the stage was pressing, and nobody watched the force meanwhile.
class ComputerLate : public RigError {
 public:
  using RigError::RigError;
};

// The punch, or something else, pressed on the load cell before the test.
class PressesAtStart : public RigError {
 public:
  using RigError::RigError;
};

// The force reached a limit; the stage has been sent a stop.
class LimitReached : public RigError {
 public:
  using RigError::RigError;
};

// Reports a run to the person watching, at most ten times a second.
class ProgressReport {
 public:
  // frame_stiffness_N_m: 0 for a rigid frame.
  ProgressReport(const RunControl& control, double frame_stiffness_N_m)
      : control_(control), clock_(*control.clock), frame_stiffness_N_m_(frame_stiffness_N_m) {}

  // planned_rest_s: how long this phase and all later ones should take.
  void begin_phase(const std::string& name, double planned_rest_s);
  // From now on depths are counted from that position.
  void set_contact_m(double contact_m) { contact_m_ = contact_m; }
  bool has_contact() const { return contact_m_.has_value(); }
  const std::string& phase() const { return phase_; }

  // Passes on a reading at that position, unless the last report is younger than a tenth of a second.
  void report(double force_N, double position_m);
  // While the stage moves, the depth of a reading is that at the last position report: the position is
  // older than the reading, and the difference would look like a jump.
  void report_reading(double time_s, double force_N, double position_m, bool is_moving);

 private:
  double depth_m(double force_N, double position_m) const;

  const RunControl& control_;
  const RigClock& clock_;
  double frame_stiffness_N_m_;
  std::string phase_ = "connect";
  double phase_start_s_ = 0.0;
  double planned_rest_s_ = 0.0;
  double last_report_wall_s_ = 0.0;
  std::optional<double> contact_m_;
  double reported_position_m_ = 0.0, reported_depth_m_ = 0.0;  // of the last reading
};

}  // namespace viscard
