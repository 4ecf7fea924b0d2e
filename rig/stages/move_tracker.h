#pragma once

#include "models/experiment/run_record.h"

namespace viscard {

// Narrows down when a move really began. At first it is only known that it began after its command
// was written and soon after the controller answered. Each position report, with the known times of
// its request and its arrival, then bounds the start through the trapezoid of the move.
class MoveTracker {
 public:
  // move.start_time_s: when the command was written; resolution_m: largest error of a reported
  // position.
  MoveTracker(const StageMove& move, double resolution_m);

  const StageMove& move() const { return move_; }
  // The controller answered the command at time_s. It begins at most first_step_s later: GRBL
  // prepares one segment of 10 ms (gnea/grbl stepper.c).
  void acknowledged(double time_s, double first_step_s = 0.010);
  // The stage was at position_m at some time between the two.
  void reported(double asked_s, double received_s, double position_m);

  // The move with the earliest start that agrees with all reports, and how much later the start can
  // have been. end_m replaces the end of a move that was stopped on the way.
  CommandedMove best(double end_m) const;
  double latest_end_s() const;
  // Number of reports that no start time can reconcile with the trapezoid.
  int n_contradictions() const { return n_contradictions_; }
  // How much later than the trapezoid at least two reports have found the stage, beyond all that
  // written commands, answers and other reports allow; 0 if they have not. A single one may be
  // garbled.
  double lag_s() const { return second_lag_s_; }

 private:
  double time_to_way_s(double way_m) const;
  void take_lag(double lag_s);

  StageMove move_;
  double resolution_m_;
  double earliest_s_;
  double latest_s_;
  int n_contradictions_ = 0;
  double largest_lag_s_ = 0.0, second_lag_s_ = 0.0;
};

// The reported position for MoveTracker::reported(). A servo that rests within near_m of its target
// has made its way, and so is at its end: else it would seem to be late as long as it rests there.
double end_of_way_m(const StageMove& move, double reported_m, bool is_at_rest, double near_m);

}  // namespace viscard
