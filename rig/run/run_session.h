#pragma once

#include "models/experiment/rig_config.h"
#include "rig/cells/load_cell.h"
#include "rig/lines/record_sink.h"
#include "rig/run/age_watch.h"
#include "rig/run/force_guard.h"
#include "rig/run/force_readings.h"
#include "rig/run/hold_watch.h"
#include "rig/run/life_watch.h"
#include "rig/run/punch_lift.h"
#include "rig/run/rise_watch.h"
#include "rig/run/run_control.h"
#include "rig/run/served_devices.h"
#include "rig/run/spike_watch.h"
#include "rig/stages/stage.h"

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace viscard {

// One run of both devices, served by the calling thread, with every reading judged by the force
// guard. All waiting is done in pump(). From connect() until make_safe() the session is guarded: a
// force limit, a stream that has stopped, a lost port or the stop flag stops the stage and then
// ends the run by an exception.
class RunSession {
 public:
  RunSession(Stage& stage, LoadCell& load_cell, const RigConfig& rig, const RecordSink& sink,
             const RunControl& control);
  ~RunSession();
  RunSession& operator=(RunSession&&) = delete;  // neither copied nor moved

  Stage& stage() { return devices_.stage(); }
  LoadCell& load_cell() { return devices_.load_cell(); }
  const Thermometer* thermometer() const { return devices_.thermometer(); }
  double now_s() const { return clock_.now_s(); }

  void connect();
  // Serves both devices once; waits at most some milliseconds.
  void pump();
  void pump_until(double time_s);  // rig time
  // As pump_until(), and then until the readings made by time_s have arrived, for at most one
  // second of wall time: on a busy machine they arrive late.
  void pump_until_received(double time_s);

  // The same, and the mean over the readings of the last mean_s of it; nothing if fewer than five
  // came.
  std::optional<ForceMean> mean_until_received(double time_s, double mean_s);

  // The stiffness of specimen and frame in series is at least this. Each move toward the specimen
  // is judged by the largest value so far.
  void expect_stiffness(double stiffness_N_m);
  // The readings since then were made at rest.
  void forget_readings() { life_.restart(); }
  LifeSigns life_signs() const { return life_.signs(); }
  // From now on readings that stop measuring stop the stage and end the run (CellIsDead).
  void watch_life() { life_.begin_watch(load_cell().has_own_clock()); }
  // The contact and the stiffness seen in the approach: from now on the force must follow the moves
  // toward the specimen, by at least a tenth of that stiffness; otherwise ForceDoesNotFollow.
  void expect_force(double contact_m, double stiffness_N_m);
  // What a change of that size in the stage's position does to the force, N.
  double implied_N(double from_m, double to_m) const;
  static constexpr double kFollows = 0.1;  // of what the stiffness implies
  // True if the force has changed as the stiffness implies, by a tenth at least, or if too little is
  // implied to be judged.
  bool follows(double implied_N, double change_N) const;
  [[noreturn]] static void throw_unfollowed(const std::string& what, double from_m, double to_m,
                                            double implied_N, double change_N);
  // Smallest change of the force that is judged: more than noise, far less than the cell can bear.
  double judged_N() const;
  // The force may rise so much, and no more, in a move away from the specimen.
  double most_rise_N() const;
  // The force rose in a move away from the specimen: stops the stage at once and ends the run.
  [[noreturn]] void end_wrong_way(double rise_N);
  // Moves and waits for standstill. Away from the specimen the force must not rise
  // (StageGoesWrongWay); moves of one purpose in a row count as one. While it presses, the readings
  // must be younger than AgeWatch allows, otherwise ReadingsTooOld is thrown after an immediate
  // stop; if they come too rarely for that, the stage moves in steps and waits for a reading after
  // each.
  // Returns true, after a gentle stop, if the force passed
  // stop_above_N (from the tare) in either direction: if the load cell is wired the other way
  // round, its force falls while the punch presses.
  bool move(double to_m, double speed_m_s, const std::string& purpose,
            std::optional<double> stop_above_N = std::nullopt);
  // A move away from the specimen by hand: true, after a gentle stop, if the force rose by more
  // than limit_N, or pulls with more than that. A force that goes to zero while the punch comes free
  // does not stop it.
  bool lift(double to_m, double speed_m_s, const std::string& purpose, double limit_N);
  // How late the stage was in the latest of the moves since the last call (Stage::lag_s).
  double take_lag_s() { return std::exchange(lag_s_, 0.0); }
  // From now on the stage stands in contact: a force that jumps, or rises by more than rise_N, is a
  // doubt. Only the first one of a run is noted. Ends with the next move.
  void watch_hold(const std::string& phase, std::optional<double> rise_N);
  bool has_hold_changed() const { return has_hold_changed_; }
  // Mean over the readings made from now on, for at least six periods. Throws RigError if fewer than five
  // arrive.
  ForceMean mean_force(double asked_s);
  // Takes the mean of the next readings as the new zero.
  ForceMean tare(double duration_s);

  // A phase for the record and for the person watching; planned_rest_s: how long this phase and all
  // later ones should take.
  void begin_phase(const std::string& name, double planned_rest_s, const std::string& text);
  void event(const std::string& name, const std::string& value, const std::string& text);
  // What the test file calls the depth or force of the move that presses from now on.
  void set_load_key(const std::string& key) { load_key_ = key; }
  void set_contact_m(double contact_m) { progress_.set_contact_m(contact_m); }

  // Ends the guarding, stops the stage and lifts the punch as far as the devices still answer.
  // Never throws for a device's sake. zero_drift_N: within it (and noise) the force after the lift is
  // the zero of the tare; nothing if there was no tare. A stage that has not moved before may go the
  // wrong way: a force that rises or cannot be read ends its lift, and so does a stop that is asked
  // for meanwhile.
  SafeEnd make_safe(double retract_to_m, double speed_m_s,
                    std::optional<double> zero_drift_N = std::nullopt);
  // At once, after an error that leaves nothing to lift; nothing if its port is gone.
  void stop_if_moving();
  // Guards again after make_safe(), as if nothing had happened.
  void guard_again();

  // True once the stage's settings and position are known, so that it can be moved.
  bool is_stage_connected() const { return devices_.is_stage_connected(); }
  bool is_position_lost() const { return devices_.is_position_lost(); }
  bool has_moved() const { return has_moved_; }
  double force_N() const { return readings_.force_N(); }
  // The newest reading makes a force, and by the calibration, without a tare, it presses.
  bool is_pressed() const {
    return !is_doubtful_ && readings_.force_N() + readings_.tare_N() > 0.0;
  }
  double sound_force_N(double noise_N) const { return readings_.sound_force_N(noise_N); }
  double peak_force_N() const { return readings_.peak_force_N(); }
  // Readings marked by an event "implausible".
  int n_implausible() const { return marks_.n_marked(); }
  // Delays of this computer since the session began, in which nothing could be watched.
  int n_late() const { return clock_.lateness().n_long() - n_late_before_; }
  double longest_late_s() const { return longest_late_s_; }
  // Why this computer may be the cause if the run ends now: it was late within the last seconds.
  // Empty if it was not.
  std::string lateness_text(double within_wall_s = 2.0) const;
  // Reasons to distrust the record that the session has noticed.
  const std::vector<std::string>& doubts() const { return doubts_; }
  // Judges the last readings too; call when no more readings follow.
  void finish_marking() { marks_.finish(); }

 private:
  void take_sample(const LoadSample& sample);
  void act_on(GuardAction action, double force_N);
  void stop_hard_while_stopping(double force_N);
  void stop_at_once();
  [[noreturn]] void throw_limit(GuardAction action, double force_N);
  void check_stream();
  void check_age();
  void check_lateness();
  void take_hold(double force_N, double made_at_s);
  void take_life(const LoadSample& sample, double made_at_s);
  void check_life();
  void note_wild();
  [[noreturn]] void end_blind(LifeWatch::Trouble trouble);
  void await_change();
  void check_follow();
  void judge_press(double position_m);
  void judge_rise(double position_m);
  double age_s() const;
  double least_start_N();
  [[noreturn]] void throw_too_old(const std::string& what) const;
  void press(double to_m, double speed_m_s, const std::string& purpose,
             std::optional<double> stop_above_N);
  void move_once(double to_m, double speed_m_s, const std::string& purpose,
                 std::optional<double> stop_above_N);
  bool pump_while(const std::function<bool()>& is_waiting, double listened_wall_s);
  void await_reading_after(double time_s);
  bool guards_force() const;

  RigConfig rig_;
  RecordSink sink_;
  RunControl control_;
  const RigClock& clock_;
  ServedDevices devices_;
  ForceReadings readings_;
  ReadingMarks marks_;
  ForceGuard guard_;
  AgeWatch ages_;
  ProgressReport progress_;
  int n_late_before_;
  int n_late_;  // delays of this computer that are in the record
  double longest_late_s_ = 0.0;
  bool is_guarded_ = false;
  bool has_stopped_at_once_ = false;
  bool has_moved_ = false;
  bool is_pressing_ = false;  // a move toward the specimen that is judged by the readings' age
  double stiffness_N_m_ = 0.0;
  double press_speed_m_s_ = 0.0;
  LifeWatch life_;
  std::int64_t n_changes_before_ = 0;  // of the readings, before the last move toward the specimen
  struct Follow {
    double contact_m = 0.0;
    double stiffness_N_m = 0.0;  // 0: nothing is known yet
  };
  Follow follow_;
  double step_N_ = 0.0;  // force of one step of the stage in contact; 0: not known yet
  struct Place {
    double time_s = 0.0, position_m = 0.0;
  };
  std::deque<Place> places_;  // of the move that presses, oldest first
  double pressed_from_m_ = 0.0, pressed_from_N_ = 0.0;
  RiseWatch rise_;
  std::string away_purpose_;      // of the last move, if it went away from the specimen
  double pressed_until_s_ = 0.0;  // when the force of the last press is known
  double press_ended_s_ = -std::numeric_limits<double>::infinity();
  HoldWatch hold_;
  std::string held_phase_;
  bool has_hold_changed_ = false;
  double noise_N_ = 0.0;
  double lag_s_ = 0.0;
  std::int64_t n_at_rest_ = 0;  // readings since the stage stands still
  bool is_doubtful_ = false;    // the newest reading has no force
  bool is_wild_ = false;        // the noise has grown many times
  std::vector<std::string> doubts_;
  std::string load_key_ = "the depth";
  std::string blind_;  // why the readings say nothing about the force any more; empty: they do
};

}  // namespace viscard
