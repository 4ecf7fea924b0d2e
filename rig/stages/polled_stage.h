#pragma once

#include "models/experiment/rig_config.h"
#include "rig/lines/line_splitter.h"
#include "rig/lines/rig_clock.h"
#include "rig/stages/move_tracker.h"
#include "rig/stages/stage.h"

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

 protected:
  // patience: factor on the wall time that the driver waits for a controller that does not answer.
  PolledStage(Transport& transport, const StageConfig& config, const RigClock& clock,
              RecordSink sink, double patience = 1.0);

  // Records what has arrived and cuts it into lines.
  void receive();
  // The bytes that belong to lines: without those of a flow control.
  virtual std::string text_in(const std::string& bytes) { return bytes; }
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
  // One question was answered promptly, or not in time; throws RigError after too many of these.
  void take_latency(double asked_s, double time_s);
  void count_miss();
  // The next question follows after every_s, or just after the end of the move, so that standstill
  // is noticed without delay.
  void plan_poll(double now_s, double every_s);
  // The move should have ended long ago: throws RigError. late_before_s: delays of this program
  // before the move.
  void check_deadline(const StageMove& planned, double late_before_s, double now_s) const;
  // The stage stands elsewhere than at the end of its move.
  [[noreturn]] void throw_elsewhere(double target_m, const std::string& state) const;
  // The move has ended; its record from the tracker.
  CommandedMove ended_move(const MoveTracker& tracker, const std::string& purpose, double end_m);

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
};

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
