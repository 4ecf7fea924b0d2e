#pragma once

#include "rig/cells/load_cell.h"
#include "rig/lines/record_sink.h"
#include "rig/lines/rig_clock.h"
#include "rig/run/silence_watch.h"
#include "rig/stages/stage.h"

#include <optional>

namespace viscard {

// Stage and load cell served by one thread, and what is known of their health: which is connected,
// which was lost or has restarted, whether the stage must be recovered, whether readings have
// stopped.
class ServedDevices {
 public:
  ServedDevices(Stage& stage, LoadCell& load_cell, const RigClock& clock);

  Stage& stage() { return stage_; }
  LoadCell& load_cell() { return load_cell_; }

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

  struct Silence {
    double silent_s = 0.0;  // wall time without a reading
    double limit_s = 0.0;
  };
  // Nothing unless the stage moves and readings have stopped for longer than the limit.
  std::optional<Silence> silence() const;

  bool is_stage_connected() const { return is_stage_connected_; }
  bool needs_recovery() const { return needs_recovery_; }  // the stage was reset or locked itself
  bool is_position_lost() const { return is_position_lost_; }    // the controller has restarted
  bool is_cell_restarted() const { return is_cell_restarted_; }  // its tare may have changed
  bool is_cell_usable() const { return is_cell_connected_ && !is_cell_lost_; }

 private:
  void wait();
  void serve_cell(bool is_guarded);
  void serve_stage();

  Stage& stage_;
  LoadCell& load_cell_;
  const RigClock& clock_;
  SilenceWatch silence_;
  double last_arrival_s_ = 0.0;  // of the newest reading passed to silence_
  bool is_cell_connected_ = false;
  bool is_cell_lost_ = false;
  bool is_cell_restarted_ = false;
  bool is_stage_connected_ = false;
  bool needs_recovery_ = false;
  bool is_position_lost_ = false;
  bool is_stopping_ = false;
};

}  // namespace viscard
