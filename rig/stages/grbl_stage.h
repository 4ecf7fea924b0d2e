#pragma once

#include "rig/protocols/grbl_protocol.h"
#include "rig/stages/polled_stage.h"

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// A stage behind GRBL 1.1 or grblHAL. rig/stages/README.md lists the rules of the firmware that the
// driver relies on, rig/protocols/README.md their sources.
class GrblStage final : public PolledStage {
 public:
  GrblStage(Transport& transport, const StageConfig& config, const RigClock& clock, RecordSink sink,
            double patience = 1.0);

  void plan_count_check(std::optional<HomedStage> before) override;
  void keep_locked() override { keeps_locked_ = true; }
  void connect(const Pump& pump) override;
  void service() override;
  StageDynamics dynamics() const override;
  std::vector<std::string> advice() const override;
  std::string identity() const override { return version_; }
  void begin_move(double to_m, double speed_m_s, const std::string& purpose) override;
  bool is_moving() const override { return active_.has_value(); }
  void stop_soft() override;
  void stop_hard() override;
  void recover(const Pump& pump) override;
  std::optional<double> homed_at_m() const override { return homed_at_m_; }
  std::string trouble_with_zero() const override;
  bool is_unlocked_unhomed() const override;
  std::string trouble_with_count_check(const Pump& pump) override;
  std::optional<CountCheck> check_count(const Pump& pump) override;

  // Sends one line and waits for its answer. Throws RigError on error:N, if there is no answer, or
  // if the controller starts instead.
  void command(const std::string& line, const Pump& pump, double timeout_wall_s = 3.0);
  const std::string& state() const { return state_; }

 private:
  // A homing cycle that the controller ended without an ok. It is not tried again, because it may
  // have run into a broken switch.
  class HomingFailed : public RigError {
   public:
    using RigError::RigError;
  };
  struct Pending {
    std::string line;
    bool is_awaited;  // command() handles an error; otherwise it is thrown
  };
  struct ActiveMove {
    MoveTracker tracker;
    std::string purpose;
    bool has_ok = false;
    double ok_s = 0.0;
    bool is_stopping = false;
    double stop_s = 0.0;
    int n_rests_elsewhere = 0;
    int n_astray = 0;               // reports in a row from outside of its path
    std::optional<double> stood_m;  // position at rest in the last report after a stop
    double late_before_s = 0.0;     // delays of this program before the move
    double progress_s = 0.0;        // time of the last report with a changed position
    bool is_nudged = false;
  };

  void send_line(const std::string& line, bool is_awaited);
  void send_realtime(char c);
  void take_line(const ReceivedLine& line);
  void take_answer(std::optional<int> error, double time_s);
  void take_alarm(int code, double time_s);
  void take_welcome(const GrblWelcome& welcome, double time_s);
  void take_status(const GrblStatus& status, double time_s);
  void follow_move(double asked_s, double received_s);
  void rest_elsewhere(double asked_s);
  void end_move(double end_m);
  void poll_status();
  void nudge(double now_s);
  void watch_deadlines(double now_s);
  std::optional<double> reported_position_m(const GrblStatus& status);
  void await_welcome(const Pump& pump);
  void converse(const Pump& pump);
  void refuse_old_firmware() const;
  void ask_position(const Pump& pump);
  void read_settings(const Pump& pump);
  void refuse_lost_count() const;
  double count_slack_m() const;
  void home(const Pump& pump);
  bool is_homing() const;
  [[noreturn]] void throw_homing_failed(const std::string& how);
  void go(double to_m, double speed_m_s, const Pump& pump);
  double touch_switch(const Pump& pump);
  bool has_bit(int number, int bit) const;
  double setting(int number, double otherwise) const;
  double resolution_m() const;
  double least_speed_m_s() const;

  int axis_;
  bool is_connected_ = false;  // after the welcome; lines before it are dropped
  bool awaits_welcome_ = true;
  bool is_recovering_ = false;  // alarms are expected
  std::string version_;
  bool is_hal_ = false;
  std::map<int, double> settings_;
  std::deque<Pending> pending_;
  std::optional<int> awaited_error_;

  std::string state_;  // as reported last
  std::vector<double> work_offset_mm_;
  int n_welcomes_ = 0;
  bool restarts_when_opened_ = false;
  bool keeps_locked_ = false;
  bool was_in_alarm_ = false;  // and has not been homed since, so its count may mean nothing
  int alarm_code_ = 0;         // of the newest alarm

  bool compares_count_ = false;             // plan_count_check() was called
  std::optional<HomedStage> homed_before_;  // by an earlier run of the series
  std::optional<double> homed_at_m_;
  std::optional<std::string> build_options_;  // of $I

  std::optional<ActiveMove> active_;
};

}  // namespace viscard
