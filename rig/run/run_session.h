#pragma once

#include "models/experiment/rig_config.h"
#include "rig/cells/load_cell.h"
#include "rig/lines/rig_error.h"
#include "rig/run/force_guard.h"
#include "rig/run/run_control.h"
#include "rig/run/silence_watch.h"
#include "rig/run/spike_watch.h"
#include "rig/stages/stage.h"

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace viscard {

// Somebody asked the run to end.
class RunInterrupted : public RigError {
 public:
  using RigError::RigError;
};

// The force reached a limit; the stage has been told to stop.
class LimitReached : public RigError {
 public:
  using RigError::RigError;
};

struct ForceMean {
  double force_N = 0.0;  // mean from the tare
  double sd_N = 0.0;     // standard deviation of one reading
  double rate_Hz = 0.0;  // of the readings that make a force
  int n = 0;
};

// Both devices served by one thread, with the force watched at every reading. Everything that waits
// does so in pump(). While armed, a limit, a stalled stream, a lost port or the stop flag ends the
// run by an exception, after the stage has been told to stop.
class RunSession {
 public:
  RunSession(Stage& stage, LoadCell& load_cell, const RigConfig& rig, const RecordSink& sink,
             const RunControl& control);
  ~RunSession();
  RunSession(const RunSession&) = delete;
  RunSession& operator=(const RunSession&) = delete;

  Stage& stage() { return stage_; }
  LoadCell& load_cell() { return load_cell_; }
  double now_s() const { return clock_.now_s(); }

  void connect();
  void pump();
  // Serves the devices until then (rig time).
  void pump_until(double time_s);
  // Likewise, and on until the readings made by then are in, one second of wall time at most: a
  // machine that was busy hears them late.
  void hear_until(double time_s);

  // Moves and waits for standstill. Returns early, after a gentle stop, when the force exceeds
  // stop_above_N (from the tare) in either direction: a cell wired the other way round falls while
  // the punch presses. True if it did.
  bool move(double to_m, double speed_m_s, const std::string& purpose,
            std::optional<double> stop_above_N = std::nullopt);
  // Mean force over readings that were made from now on.
  ForceMean mean_force(double duration_s);
  // Takes the mean of the next readings as zero.
  ForceMean tare(double duration_s);

  // Phases for the record and for the person watching; planned_s is what the rest of the run takes.
  void begin_phase(const std::string& name, double planned_rest_s, const std::string& text);
  void event(const std::string& name, const std::string& value, const std::string& text);
  void set_contact_m(double contact_m) { contact_m_ = contact_m; }

  // Stops and lifts the punch as far as the devices still answer, whatever has happened; returns
  // what could not be done, or "".
  std::string make_safe(double retract_to_m, double speed_m_s);
  // How far make_safe() has lifted the punch.
  double lifted_m() const { return lifted_m_; }
  // The stage has been told its settings and place: it can be moved.
  bool is_stage_connected() const { return is_stage_connected_; }
  bool has_moved() const { return has_moved_; }

  double force_N() const { return force_N_; }
  double peak_force_N() const { return peak_force_N_; }
  // Readings marked by an event "implausible" because they stand out of their neighbours.
  int n_implausible() const { return static_cast<int>(implausible_.size()); }
  // The last readings have no neighbours behind them any more: judges them as they are.
  void finish_watching();

 private:
  void serve_cell();
  void serve_stage();
  void take_sample(const LoadSample& sample);
  void watch_spikes(const LoadSample& sample, bool is_doubtful);
  void mark_all(const std::vector<std::int64_t>& values, const std::vector<std::int64_t>& times);
  void mark(std::int64_t index, const std::string& why);
  void act_on(GuardAction action, double force_N);
  [[noreturn]] void throw_limit(GuardAction action, double force_N) const;
  void listen();
  // Before the stage is connected nothing can be stopped or lifted, and nothing moves but its
  // homing.
  bool guards_force() const { return is_armed_ && (is_stage_connected_ || rig_.stage.home); }
  void check_stream();
  void report_progress();
  std::string lift(double retract_to_m, double speed_m_s, double share);
  std::string force_after_lift(double before_N);

  Stage& stage_;
  LoadCell& load_cell_;
  RigConfig rig_;
  RecordSink sink_;
  RunControl control_;
  const RigClock& clock_;
  ForceGuard guard_;

  bool is_armed_ = false;  // limits, stream and stop flag end the run
  bool is_cell_connected_ = false;
  bool is_cell_lost_ = false;
  bool is_cell_restarted_ = false;  // its tare may be another one now
  bool is_stage_connected_ = false;
  bool has_moved_ = false;
  double lifted_m_ = 0.0;
  bool is_stopping_ = false;     // while a gentle stop is under way: does it suffice?
  bool needs_recovery_ = false;  // the stage was reset or locked itself
  bool is_place_lost_ = false;   // the stage started anew: its positions mean nothing any more
  SilenceWatch silence_;
  SpikeWatch spikes_;
  std::optional<SpikeWatch> time_spikes_;  // of the device's own clock
  double first_period_s_ = 0.0;            // places along device time are counted in it
  std::set<std::int64_t> implausible_;     // indices
  double heard_s_ = 0.0;                   // arrival of the last reading that silence_ knows of
  double tare_N_ = 0.0;
  double force_N_ = 0.0;
  std::int64_t n_forces_ = 0;  // readings that make a force
  double peak_force_N_ = 0.0;

  std::optional<double> stop_above_N_;
  bool has_exceeded_ = false;
  std::optional<double> collect_from_s_;
  std::vector<double> collected_N_;
  double last_made_s_ = 0.0;  // newest reading, by its own clock
  double collected_first_s_ = 0.0, collected_until_s_ = 0.0;

  std::string phase_ = "connect";
  double phase_start_s_ = 0.0;
  double planned_rest_s_ = 0.0;
  double last_progress_wall_s_ = 0.0;
  std::optional<double> contact_m_;
};

}  // namespace viscard
