#pragma once

#include "rig/protocols/apt_protocol.h"
#include "rig/stages/polled_stage.h"

#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// A Thorlabs stage behind a motor controller with the APT protocol (rig/protocols/apt_protocol.h).
// rig/stages/README.md lists the rules that the driver relies on.
class AptStage final : public PolledStage {
 public:
  // Throws RigError if the rig file has no microstep.
  AptStage(Transport& transport, const StageConfig& config, const RigClock& clock, RecordSink sink);
  ~AptStage() override;  // restores the speed of the controller

  void connect(const Pump& pump) override;
  void service() override;
  StageDynamics dynamics() const override;
  std::vector<std::string> advice() const override;
  std::string identity() const override { return identity_; }
  bool measures_position() const override { return !units_.is_stepper; }
  void begin_move(double to_m, double speed_m_s, const std::string& purpose) override;
  bool is_moving() const override { return active_.has_value(); }
  void stop_soft() override;
  void stop_hard() override;
  void recover(const Pump& pump) override;

 private:
  static constexpr double kAnswer_wall_s = 0.25;
  static constexpr int kMostSends = 4;           // of what may have been lost
  static constexpr double kPollMoving_s = 0.05;  // FTDI keeps bytes back for up to 16 ms
  static constexpr double kPollResting_s = 0.2;
  static constexpr double kSettled_m = 1e-6;     // a servo comes to rest within this distance
  static constexpr double kSettle_wall_s = 0.5;  // and within this time
  struct ActiveMove {
    StageMove planned;     // its start is not known until the command is written
    AptVelocity velocity;  // words that the controller must confirm before the move
    std::int32_t target = 0;
    std::string purpose;
    int n_speed_sent = 0;
    double speed_sent_s = 0.0;
    bool is_due = false;  // the speed is confirmed; the move is to be written
    int n_sent = 0;
    std::optional<MoveTracker> tracker = {};  // once the move was written
    double sent_s = 0.0;
    std::optional<double> rests_since_s = {};  // elsewhere than at the target
    int n_astray = 0;
    std::uint8_t stop_mode = 0;  // 0: not stopped
    double stop_s = 0.0;
    double late_before_s = 0.0;  // delays of this program before the move
  };

  void split(const Chunk& chunk) override;
  void write(const std::string& bytes);
  void take_message(const AptMessage& message);
  void take_status(const AptStatus& status, double time_s);
  void take_velocity(const AptVelocity& velocity);
  void watch_bits();
  void follow_move(double asked_s, double received_s);
  void follow_stop(double asked_s);
  void rest_elsewhere(double asked_s);
  void end_move();
  void send_speed();
  void send_move();
  void drive(double now_s);
  void stop(std::uint8_t mode);
  AptMessage ask(const std::string& request, std::uint16_t reply, const Pump& pump);
  void ask_position(const Pump& pump);
  void halt(std::uint8_t mode, const Pump& pump);
  void identify(const Pump& pump);
  void read_velocity(const Pump& pump);
  void enable(const Pump& pump);
  void home(const Pump& pump);
  bool rests() const { return (bits_ & apt::kMoving) == 0; }
  double metres(double counts) const { return toward_ * counts * config_.microstep_m + 0.0; }
  double speed_m_s(double word) const { return word / units_.speed_word * config_.microstep_m; }
  double acceleration_m_s2(double word) const {
    return word / units_.acceleration_word * config_.microstep_m;
  }

  AptSplitter messages_;
  AptUnits units_;
  std::string identity_;
  std::deque<std::string> outbox_;
  double next_write_s_ = 0.0;
  std::uint16_t awaited_ = 0;  // id of the answer that ask() waits for
  std::optional<AptMessage> answer_;
  std::uint32_t bits_ = 0;     // as reported last
  bool has_homed_ = false;     // the event after homing
  bool is_troubled_ = false;   // by the last status
  bool is_homed_ = false;      // when the stage was connected or recovered
  bool is_recovering_ = true;  // faults are expected, also until connected
  AptVelocity found_;          // before the first move; limits the speed
  bool has_no_speed_ = false;  // the controller's own speed or acceleration was 0
  bool is_speed_changed_ = false;

  std::optional<ActiveMove> active_;
};

}  // namespace viscard
