#pragma once

#include "rig/cells/load_cell.h"
#include "rig/lines/record_sink.h"
#include "rig/lines/rig_clock.h"
#include "rig/sensors/thermometer.h"
#include "rig/stages/stage.h"

#include <optional>

namespace viscard {

// Detects that a stream of readings has stopped, within a few periods of wall time, without a false
// alarm at every delay of the machine. Only time spent listening counts: what the device sent while
// this process or the whole machine stood still has arrived by the next pass, so a long pass counts
// as a short one. The limit is the larger of three periods and twice the longest silence seen while
// the stage was at rest; the latter is kept between floor_s, because an FTDI adapter holds bytes
// back for 16 ms and schedulers delay the process, and 250 ms.
class SilenceWatch {
 public:
  // floor_s: larger for an emulated rig whose clock runs fast.
  explicit SilenceWatch(double floor_s = 0.1) : floor_s_(floor_s) {}

  // One pass of the loop, ended at wall_s; has_arrived: a reading arrived in it.
  void pass(double wall_s, bool has_arrived, bool is_moving);

  double silent_s() const { return silent_s_; }
  // period_s: time between readings on the wall clock.
  double limit_s(double period_s) const;
  bool is_silent(double period_s) const { return silent_s_ >= limit_s(period_s); }

 private:
  double floor_s_;
  double last_pass_s_ = -1.0;
  double silent_s_ = 0.0;
  double longest_at_rest_s_ = 0.0;
};

// Stage, load cell and thermometer served by one thread, and what is known of their health: which is connected,
// which was lost or has restarted, whether the stage must be recovered, whether readings have
// stopped.
class ServedDevices {
 public:
  // thermometer: may be nullptr.
  ServedDevices(Stage& stage, LoadCell& load_cell, Thermometer* thermometer, const RigClock& clock);

  Stage& stage() { return stage_; }
  LoadCell& load_cell() { return load_cell_; }
  const LoadCell& load_cell() const { return load_cell_; }
  const Thermometer* thermometer() const { return thermometer_; }

  // The load cell first, so that the force is known before the stage may home.
  void connect(const Pump& pump);
  // Waits a moment for bytes, then lets both devices handle what has arrived. is_guarded: an error
  // of the load cell stops a moving stage at once and is thrown; otherwise only the stage's errors
  // are thrown.
  void serve(bool is_guarded);

  // Stops the stage at once; it must be recovered before it moves again.
  void stop_hard();
  // A gentle stop during which the force is still judged, until end_gentle_stop().
  void begin_gentle_stop();
  void end_gentle_stop() { is_stopping_ = false; }
  bool is_stopping() const { return is_stopping_; }
  void recover(const Pump& pump);
  // After the stage's port hung up: opens it again, verifies that the same controller answers, and
  // unlocks it. Its position is lost then. Waits up to wall_s for the port. Throws PortHungUp if it
  // does not come back, RigError if another device answers.
  void reopen_stage(double wall_s, const Pump& pump);

  struct Silence {
    double silent_s = 0.0;  // wall time without a reading
    double limit_s = 0.0;
  };
  // Nothing unless readings have stopped for longer than the limit, which is much shorter while the
  // stage moves.
  std::optional<Silence> silence() const;

  bool is_stage_connected() const { return is_stage_connected_; }
  bool needs_recovery() const { return needs_recovery_; }  // the stage was reset or locked itself
  // The controller has restarted, or its port was gone.
  bool is_position_lost() const { return is_position_lost_; }
  bool is_cell_restarted() const { return is_cell_restarted_; }  // its tare may have changed
  bool is_cell_usable() const { return is_cell_connected_ && !is_cell_lost_; }

 private:
  void wait();
  void serve_cell(bool is_guarded);
  void serve_stage();

  Stage& stage_;
  LoadCell& load_cell_;
  Thermometer* thermometer_;
  const RigClock& clock_;
  SilenceWatch silence_;
  double last_arrival_s_ = 0.0;  // of the newest reading passed to silence_
  bool is_cell_connected_ = false;
  bool is_cell_lost_ = false;
  bool is_cell_restarted_ = false;
  bool is_stage_connected_ = false;
  bool is_stage_lost_ = false;  // its port hung up
  bool needs_recovery_ = false;
  bool is_position_lost_ = false;
  bool is_stopping_ = false;
};

}  // namespace viscard
