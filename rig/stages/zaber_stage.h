#pragma once

#include "rig/protocols/zaber_protocol.h"
#include "rig/stages/polled_stage.h"

#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// A Zaber stage with the ASCII protocol (rig/protocols/zaber_protocol.h). rig/stages/README.md lists
// the rules that the driver relies on.
class ZaberStage final : public PolledStage {
 public:
  // Throws RigError if the rig file has no microstep.
  ZaberStage(Transport& transport, const StageConfig& config, const RigClock& clock,
             RecordSink sink);
  ~ZaberStage() override;  // restores the largest speed of the controller

  void connect(const Pump& pump) override;
  void service() override;
  StageDynamics dynamics() const override;
  std::vector<std::string> advice() const override;
  std::string identity() const override { return identity_; }
  void begin_move(double to_m, double speed_m_s, const std::string& purpose) override;
  bool is_moving() const override { return active_.has_value(); }
  void stop_soft() override;
  void stop_hard() override;
  void recover(const Pump& pump) override;

 private:
  static constexpr double kPollMoving_s = 0.05;  // between questions for the position, rig time
  static constexpr double kPollResting_s = 0.2;
  struct Sent {
    int id = 0;
    std::string words;
    double written_s = 0.0;
    int n_sent = 0;
  };
  struct ActiveMove {
    StageMove planned;  // its start is not known until the command is written
    std::optional<MoveTracker> tracker;
    std::string purpose;
    long long target = 0;  // microsteps
    std::optional<double> reply_s = {};
    double late_before_s = 0.0;  // delays of this program before the move
    bool is_stopping = false;
    double stop_s = 0.0;
    int n_rests_elsewhere = 0;
  };

  Sent send(const std::string& words);
  void take_line(const ReceivedLine& line);
  void take_reply(const ZaberMessage& reply, double time_s);
  void take_flag(const ZaberMessage& reply, double time_s);
  void take_action_reply(const Sent& action, const ZaberMessage& reply, double time_s);
  void take_position(const Sent& question, const ZaberMessage& reply, double time_s);
  void follow_move(double asked_s, double received_s, bool is_busy);
  void end_move(double end_m);
  void drive(double now_s);
  void start_action();
  void stop(const std::string& words);
  std::string ask(const std::string& words, const Pump& pump);
  double number(const std::string& setting, const Pump& pump);
  void wait_for_rest(const Pump& pump, double wall_s);
  void read_settings(const Pump& pump);
  void ask_position(const Pump& pump);
  bool lacks_reference() const { return flag_ == "WR" || flag_ == "WH"; }
  double metres(double microsteps) const {
    return toward_ * microsteps * config_.microstep_m + 0.0;
  }

  int next_id_ = 0;

  std::deque<std::string> actions_;  // to be sent one by one, each after the OK to the one before
  std::optional<Sent> action_;       // sent and not yet answered
  std::optional<Sent> question_;     // "get pos", sent and not yet answered
  std::optional<std::string> action_data_;
  std::string action_rejection_;
  std::optional<std::string> asked_words_;  // sent by ask(), which handles a rejection itself

  std::string identity_;
  double max_speed_data_ = 0.0;
  long long speed_data_ = 0;  // as set last
  double acceleration_data_ = 0.0;
  bool is_recovering_ = true;  // faults are expected, also until connected
  std::string flag_;           // as reported last
  bool is_busy_ = false;
  bool is_referenced_ = false;  // when the stage was connected or recovered

  std::optional<ActiveMove> active_;
};

}  // namespace viscard
