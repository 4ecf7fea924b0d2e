#pragma once

#include "rig/protocols/marlin_protocol.h"
#include "rig/stages/polled_stage.h"

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// A stage behind a board with Marlin firmware (rig/protocols/marlin_protocol.h). Moves toward the
// specimen are sent in short pieces, so that a stage that hears nothing more comes to rest.
// rig/stages/README.md lists the rules that the driver relies on.
class MarlinStage final : public PolledStage {
 public:
  MarlinStage(Transport& transport, const StageConfig& config, const RigClock& clock,
              RecordSink sink);

  void keep_locked() override { presses_nothing_ = true; }
  void plan_lift_only() override { presses_nothing_ = true; }
  void connect(const Pump& pump) override;
  void service() override;
  StageDynamics dynamics() const override;
  std::vector<std::string> advice() const override;
  std::string identity() const override { return firmware_; }
  std::string trouble_with_zero() const override {
    return "this driver counts from where the stage stands when it connects (G92)";
  }
  void begin_move(double to_m, double speed_m_s, const std::string& purpose) override;
  bool is_moving() const override { return active_.has_value(); }
  void stop_soft() override;
  void stop_hard() override;
  void recover(const Pump& pump) override;

 private:
  static constexpr double kSilence_wall_s = 0.3;  // then a line is sent again
  static constexpr int kMostTries = 10;
  // M410 is answered after 1 s, in which no move is taken, without an emergency parser after 2 s
  // (planner.cpp, quick_stop(); motion.cpp, quickstop_stepper()). One that comes meanwhile begins
  // this time again, so it is written again only if it must have been lost.
  static constexpr double kStopped_wall_s = 2.5;
  static constexpr int kMostStops = 3;
  static constexpr int kMostStopsAtStart = 6;  // a board boots for up to 10 s
  // Without R Count is the end of what waits, not where the motors are (motion.cpp,
  // report_current_position_projected()), also with it in builds without M114_REALTIME.
  static constexpr const char* kAsk = "M114 R";
  // MIN_STEPS_PER_SEGMENT of many builds: shorter moves are not made, but added to the next one.
  static constexpr int kFewestSteps = 6;
  struct Sent {
    std::string command;
    long number = 0;
    double first_s = 0.0, written_s = 0.0;
    int n_sent = 0;
    std::optional<double> again_at_s = {};  // asked for again; until then an ok belongs to that
    bool is_reported = false;               // kAsk: the report has come, its ok has not
  };
  struct ActiveMove {
    StageMove planned;  // its start is not known until the first piece is written
    double feed_mm_min = 0.0;
    long long sent = 0, target = 0, piece = 0;  // steps
    std::string purpose;
    std::optional<MoveTracker> tracker = {};
    std::optional<double> ok_s = {};  // of the newest piece
    long long seen = 0;               // steps of the last report
    double progress_s = 0.0;
    int n_astray = 0;
    bool is_stopping = false;
    std::optional<long long> stood = {};  // steps in the last report after a stop
    double late_before_s = 0.0;           // delays of this program before the move
  };

  enum class Reports { kTrue, kPlanned, kLate, kNotMoved };

  void write(const std::string& bytes);
  void send(const std::string& command);
  void send_again(double now_s);
  void take_line(const ReceivedLine& line);
  void take_other(const std::string& text, double time_s);
  void take_start(double time_s);
  void take_ok(double time_s);
  void take_resend(long number, double time_s);
  void take_error(const std::string& text);
  void take_count(long long count, double time_s);
  void answered(const Sent& sent, double time_s);
  void drive(double now_s);
  bool wants_piece(double now_s) const;
  void send_piece();
  void follow_move(double asked_s, double received_s);
  void follow_stop(double asked_s);
  void rest_elsewhere(double asked_s);
  [[noreturn]] void throw_not_made(double target_m);
  std::string words_of_board() const;  // in the last move
  void end_move();
  void stop();
  void write_stop();
  void command(const std::string& text, const Pump& pump, double wall_s = 5.0);
  void await_boot(const Pump& pump);
  void await_pause(const Pump& pump);
  void converse(bool is_first, const Pump& pump);
  void converse_again(bool is_first, const Pump& pump);
  void halt(const Pump& pump);
  void read_settings(const Pump& pump);
  void home(const Pump& pump);
  void require_true_reports(const Pump& pump);
  Reports reports_of_move(long long to, double speed_m_s, const Pump& pump);
  std::string move_to(long long count, double feed_mm_min) const;
  double setting(const std::string& name) const;
  double steps_per_m() const;
  double metres(long long steps) const {
    return toward_ * static_cast<double>(steps) / steps_per_m() + 0.0;
  }
  bool is_toward() const { return active_->planned.to_m > active_->planned.from_m; }

  long number_ = 0;  // of the newest line
  std::deque<std::string> outbox_;
  std::optional<Sent> in_flight_;
  bool was_piece_ = false;        // the newest line
  bool is_stop_open_ = false;     // M410 was written and not answered
  int n_stops_ = 0;               // tries
  int n_stale_ = 0;               // answers to these tries that may still come
  bool is_unsettled_ = false;     // after several tries, until a question was answered
  bool is_piece_behind_ = false;  // was written just before a stop, and may be made after it
  double stop_written_s_ = 0.0, stopped_s_ = 0.0;
  double quiet_until_s_ = 0.0;          // answers before this time belong to nothing
  std::optional<std::string> awaited_;  // what command() waits for

  std::string firmware_;
  bool has_emergency_parser_ = false;
  bool presses_nothing_ = false;  // so what its reports are is not found out
  std::map<std::string, double> settings_;
  long long count_ = 0;          // steps, as reported last
  long long origin_count_ = 0;   // steps at position 0 of G1
  double rest_latency_s_ = 0.0;  // longest time to an answer to kAsk at rest
  int n_starts_ = 0;
  bool was_moved_ = false;  // by connect()
  double heard_s_ = 0.0;    // when the last line came
  std::string last_message_;
  bool is_recovering_ = true;  // starts and errors are expected, also until connected

  std::optional<ActiveMove> active_;
};

}  // namespace viscard
