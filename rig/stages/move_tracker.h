#pragma once

#include "models/experiment/run_record.h"

namespace viscard {

// Narrows down when a move really began. All that is sure at first is that it was not before its
// command was written nor after the controller had answered; each position report, asked for and
// received at known times, bounds the time by which the trapezoid had got so far.
class MoveTracker {
 public:
  // move.start_time_s is the time the command was written; resolution_m how far a reported position
  // may be from the true one.
  MoveTracker(const StageMove& move, double resolution_m);

  const StageMove& move() const { return move_; }
  // The command was answered at that time.
  void acknowledged(double time_s);
  // It stood at position_m at some time between the two.
  void reported(double asked_s, double received_s, double position_m);

  // The move with the earliest start that agrees with everything, and how much later it can have
  // been. end_m replaces its end where it was stopped on the way.
  CommandedMove best(double end_m) const;
  double latest_end_s() const;
  // Reports that no start time can reconcile with the trapezoid.
  int n_contradictions() const { return n_contradictions_; }

 private:
  double time_to_way_s(double way_m) const;

  StageMove move_;
  double resolution_m_;
  double earliest_s_;
  double latest_s_;
  int n_contradictions_ = 0;
};

}  // namespace viscard
