#pragma once

#include "models/experiment/rig_config.h"
#include "rig/lines/line_splitter.h"
#include "rig/lines/rig_clock.h"
#include "rig/stages/move_tracker.h"
#include "rig/stages/stage.h"

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// What the stage drivers share: the line and its records, the questions for the position, and where
// the stage stands.
class PolledStage : public Stage {
 public:
  Transport& transport() override { return transport_; }
  ReportLatency report_latency() const override { return latency_; }
  double position_m() const override { return exact_m_ && !is_moving() ? *exact_m_ : reported_m_; }
  double expected_end_s() const override { return expected_end_s_; }
  double lag_s() const override { return lag_s_; }

 protected:
  // patience: factor on the wall time that the driver waits for a controller that does not answer.
  PolledStage(Transport& transport, const StageConfig& config, const RigClock& clock,
              RecordSink sink, double patience = 1.0);

  // Records what has arrived and cuts it into messages.
  void receive();
  // Feeds recorded bytes to splitter_. A driver of a binary protocol also feeds its own splitter, one
  // with flow control takes those bytes out first.
  virtual void split(const Chunk& chunk);
  void note(double time_s, const std::string& name, const std::string& value,
            const std::string& text) const;
  // Pumps until something is there; false if wall_s have passed first.
  bool wait_for(const std::function<bool()>& is_there, const Pump& pump, double wall_s) const;
  // Asks for the position until it is reported. Throws RigError with the remedy if it is not.
  void await_report(const Pump& pump, double wall_s, const std::string& remedy);
  // Keeps the first lines that are no answer of the driver's controller.
  void hear(const std::string& line);
  // "no ... answered on '/dev/ttyUSB0' (12 bytes received). ", what was heard, and what to look at.
  [[noreturn]] void throw_no_answer(const std::string& what, const std::string& if_unreadable,
                                    const std::string& otherwise) const;

  void take_report(double time_s, double position_m, const std::string& state);
  // Questions for the position whose answers carry no number, so that a late answer cannot be told
  // from a prompt one. asked() follows the write of a question. AskedStage does not use these: it
  // asks for more than the position, so it finds its controller again after every lost answer.
  void asked(double now_s);
  // The time of the question that a report answers: the oldest open one, because the report cannot
  // be older than that. Nothing for an unasked report.
  std::optional<double> question_answered(double time_s);
  // True while the newest question may still be answered; counts one that was not answered in time.
  bool awaits_report(double now_s);
  void forget_questions();
  // One question was answered promptly, or not in time; throws RigError after too many of these.
  void take_latency(double asked_s, double time_s);
  void count_miss();
  // The next question follows after every_s, or just after the end of the move, so that standstill
  // is noticed without delay.
  void plan_poll(double now_s, double every_s);
  // Stops at once and throws StageAlarm if two reports in a row are outside of the path: a command
  // garbled on its way to the controller can be a valid move to another position.
  void watch_path(const StageMove& move, double slack_m, int& n_astray);
  // Throws RigError if the stage should have come to rest long ago. late_before_s: clock_.late_s()
  // when the move began. progress_s: when its position last changed, for controllers that may be
  // slower than their settings say and are waited for.
  void watch_end(double now_s, const StageMove& move, double late_before_s,
                 std::optional<double> progress_s = {}) const;
  // Stops the stage at once if this part of connect() ends by an exception, such as a force above
  // its limit: is_moving() is false in it, so the caller stops nothing.
  void stopped_by_error(const std::function<void()>& part);
  // The stage rests elsewhere than at the end of its move. state: in the controller's words.
  [[noreturn]] void throw_elsewhere(double target_m, const std::string& state,
                                    const std::string& look_for) const;
  // The reference position was there when the stage was connected or recovered, and is gone.
  [[noreturn]] void throw_reference_lost();
  [[noreturn]] void throw_no_rest() const;
  // The move has ended at end_m: hands its record to the sink. No tracker: it was never written.
  void hand_out(const std::optional<MoveTracker>& tracker, const std::string& purpose,
                double end_m);

  Transport& transport_;
  StageConfig config_;
  const RigClock& clock_;
  RecordSink sink_;
  double patience_;
  LineSplitter splitter_;
  double toward_;  // sign of the controller's axis toward the specimen

  double reported_m_ = 0.0;
  std::optional<double> exact_m_;  // end of the last move, on a whole step
  std::optional<double> start_m_;  // position at connect(), from which travel is counted
  std::size_t n_reports_ = 0;
  bool polls_ = false;
  std::vector<std::string> heard_;
  int n_missed_ = 0;
  ReportLatency latency_;
  double next_poll_s_ = 0.0;
  double expected_end_s_ = 0.0;

 private:
  double lag_s_ = 0.0;          // of the last move
  std::deque<double> asked_s_;  // times of the open questions, oldest first
  bool is_last_missed_ = false;
  bool is_answered_since_ = false;  // an older question was answered after the newest was sent
};

// At the start of a run: positions would mean nothing.
[[noreturn]] void throw_no_reference();

// The software limit that every stage driver checks: throws RigError if to_m lies further toward
// the specimen than travel_m from start_m, where the stage stood at first.
void check_travel(double to_m, double start_m, double travel_m);

// Limits the end of a move to what the controller allows (StageDynamics::lowest_m, highest_m), on a
// whole step. A move away from the specimen is shortened, because a shorter lift is better than
// none. A move toward the specimen beyond the limit throws RigError, and so does any move that
// starts outside of the travel. settings: names of the controller's limits, for the message.
double within_travel_m(double from_m, double to_m, const StageDynamics& dynamics,
                       const std::string& settings);

}  // namespace viscard
