#pragma once

#include "rig/stages/polled_stage.h"

#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// What the drivers of controllers share that answer nothing but questions, in mm and mm/s, and do
// not number their answers (PI GCS 2, Newport SMC100). The rules:
//  - One question is open at a time. After a lost answer the controller is asked for its name, and
//    all lines before that answer are ignored: a late answer cannot answer a newer question.
//  - Only questions and stops are repeated. A move is written once, with its absolute target, after
//    the controller has confirmed its speed. Then it is asked for its error and its target.
//  - The position and the state are asked for in rounds. A round counts when all of its questions
//    were asked after the move (or stop) that it judges.
class AskedStage : public PolledStage {
 public:
  void connect(const Pump& pump) override;
  void service() override;
  StageDynamics dynamics() const override { return dynamics_; }
  std::vector<std::string> advice() const override;
  std::string identity() const override { return identity_; }
  void begin_move(double to_m, double speed_m_s, const std::string& purpose) override;
  bool is_moving() const override { return active_.has_value(); }
  void stop_soft() override { stop(dialect_.soft_stop); }
  void stop_hard() override;
  void recover(const Pump& pump) override;

 protected:
  struct Dialect {
    std::string name;               // of the controller, for messages
    std::string settings;           // which baud and device it needs, if it does not answer
    std::string name_question;      // its answer differs from every other line
    std::string position_question;  // mm
    std::string speed_question;     // mm/s
    std::string target_question;    // mm; empty if the controller does not know it
    std::string error_question;
    std::string soft_stop, hard_stop;
    std::string limits;                 // names of its limits of travel, for messages
    double after_command_wall_s = 0.0;  // pause that it needs after a command
  };
  // What one round of questions has shown.
  struct Seen {
    double asked_s = 0.0;  // the first of them
    bool is_moving = false;
    bool is_steady = false;  // it rests where it rested in the round before
    bool is_on_target = false;
    bool holds = true;  // the motor holds the position
    bool has_reference = true;
    std::string trouble;  // in the controller's words; may be empty
  };

  AskedStage(Transport& transport, const StageConfig& config, const RigClock& clock,
             RecordSink sink, Dialect dialect);

  virtual bool may_write() { return true; }  // stops are written in any case
  virtual std::string bytes_of(const std::string& words) const = 0;
  virtual bool is_question(const std::string& words) const = 0;
  virtual bool is_name(const std::string& line) const = 0;
  // What the line answers to the question; nothing if it cannot be its answer.
  virtual std::optional<std::string> answer_in(const std::string& question,
                                               const std::string& line) const = 0;
  virtual std::string speed_words(double speed_mm_s) const = 0;
  virtual std::string move_words(double target_mm) const = 0;
  // The error in an answer to error_question; empty for none and for that of a stop.
  virtual std::string trouble_in(const std::string& answer) const = 0;
  // Fills round_ with the questions of a round; take_state() may add some.
  virtual void plan_round() = 0;
  virtual void take_state(const std::string& question, const std::string& answer) = 0;
  // After the name: waits until it is ready, fills dynamics_, switches the motor on, homes.
  virtual void set_up(const Pump& pump) = 0;
  // After a stop or an alarm: makes moves possible again.
  virtual void set_free(const Pump& pump) = 0;

  // Sends a question and waits for its answer; nothing if it is not answered n_tries times.
  std::optional<std::string> ask_if_known(const std::string& question, const Pump& pump,
                                          int n_tries = 1);
  std::string ask(const std::string& question, const Pump& pump);
  double number(const std::string& question, const Pump& pump);
  void send_later(const std::string& command) { jobs_.push_back({command, Origin::kAsk}); }
  // Sends a command and asks for its error. Throws RigError if there is one.
  void command(const std::string& words, const Pump& pump);
  // Waits for a round that shows standstill.
  void await_rest(const Pump& pump, double wall_s);
  // For the destructor: the speed that the controller had at first.
  void restore_speed();

  Dialect dialect_;
  StageDynamics dynamics_;
  double first_speed_mm_s_ = 0.0;
  std::deque<std::string> round_;  // questions of the round that are not yet asked
  Seen seen_;                      // in this round so far

 private:
  static constexpr double kPollMoving_s = 0.05;  // between rounds, rig time
  static constexpr double kPollResting_s = 0.2;
  // An end so near counts as reached; the reported position is then recorded as the end.
  static constexpr double kNear_m = 2e-6;
  enum class Origin { kAsk, kMove, kRound, kDropped };
  struct Job {
    std::string words;
    Origin origin = Origin::kAsk;
    bool begins_move = false;
  };
  struct Sent {
    Job job;
    double written_s = 0.0;
  };
  struct ActiveMove {
    StageMove planned;  // its start is not known until the command is written
    std::optional<MoveTracker> tracker;
    std::string purpose;
    double target_m = 0.0;
    std::optional<double> accepted_s = {};
    std::string refusal = {};    // the controller's error instead
    double late_before_s = 0.0;  // delays of this program before the move
    bool is_stopping = false;
    double stop_s = 0.0, stop_sent_s = 0.0;
    std::string stop_words = {};
    std::optional<double> rests_since_s = {};  // elsewhere than at the target
    int n_astray = 0;                          // rounds in a row that show it outside of its path
  };

  double send(const std::string& words);
  void take_line(const ReceivedLine& line);
  void take_answer(const Sent& question, const std::string& answer, double time_s);
  void take_move_answer(const std::string& question, const std::string& answer, double time_s);
  void take_position(const Sent& question, const std::string& answer, double time_s);
  void judge();
  void judge_health();
  void judge_move();
  void rest_elsewhere();
  void end_move(double end_m);
  void drive(double now_s);
  bool find_again(double now_s);
  void send_job(Job job);
  void ask_in_round(double now_s);
  void abort_round();
  void stop(const std::string& words);
  bool await_name(const Pump& pump);

  std::deque<Job> jobs_;  // sent one by one, before any round
  std::optional<Sent> question_;
  bool is_lost_ = true;  // asks for the name and ignores other lines
  double next_name_s_ = 0.0;
  double free_at_s_ = 0.0;  // the controller takes the next line
  std::optional<std::string> asked_answer_;
  int n_tries_left_ = 0;  // of the question of ask()

  std::string identity_;
  double speed_mm_s_ = 0.0;    // as the controller confirmed last
  bool is_recovering_ = true;  // faults are expected, also until connected
  Seen last_;                  // complete round
  double last_m_ = 0.0;        // position in it
  std::size_t n_rounds_ = 0;
  int n_unwell_ = 0;  // rounds in a row that show a fault

  std::optional<ActiveMove> active_;
};

}  // namespace viscard
