#include "rig/stages/move_tracker.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace viscard {

MoveTracker::MoveTracker(const StageMove& move, double resolution_m)
    : move_(move),
      resolution_m_(resolution_m),
      earliest_s_(move.start_time_s),
      latest_s_(std::numeric_limits<double>::infinity()) {}

void MoveTracker::acknowledged(double time_s, double first_step_s) {
  latest_s_ = std::min(latest_s_, time_s + first_step_s);
}

// Time after the start at which the move has covered way_m, by bisection.
double MoveTracker::time_to_way_s(double way_m) const {
  double low_s = 0.0;
  double high_s = duration_s(move_);
  for (int i = 0; i < 50; ++i) {
    const double middle_s = 0.5 * (low_s + high_s);
    const double gone_m = std::abs(position_m(move_, move_.start_time_s + middle_s) - move_.from_m);
    (gone_m < way_m ? low_s : high_s) = middle_s;
  }
  return 0.5 * (low_s + high_s);
}

void MoveTracker::reported(double asked_s, double received_s, double position_m) {
  const double whole_m = std::abs(move_.to_m - move_.from_m);
  const double direction = move_.to_m >= move_.from_m ? 1.0 : -1.0;
  const double gone_m = (position_m - move_.from_m) * direction;
  double earliest_s = earliest_s_;
  double latest_s = latest_s_;
  if (gone_m + resolution_m_ < whole_m) {
    earliest_s = std::max(earliest_s, asked_s - time_to_way_s(gone_m + resolution_m_));
    take_lag(earliest_s - latest_s_);
  }
  if (gone_m - resolution_m_ > 0.0) {
    latest_s = std::min(latest_s, received_s - time_to_way_s(gone_m - resolution_m_));
  }
  // A report that contradicts the others (a late answer to an older request) changes nothing.
  if (earliest_s > latest_s) {
    ++n_contradictions_;
    return;
  }
  earliest_s_ = earliest_s;
  latest_s_ = latest_s;
}

void MoveTracker::take_lag(double lag_s) {
  second_lag_s_ = std::max(second_lag_s_, std::min(lag_s, largest_lag_s_));
  largest_lag_s_ = std::max(largest_lag_s_, lag_s);
}

CommandedMove MoveTracker::best(double end_m) const {
  CommandedMove commanded;
  commanded.move = move_;
  commanded.move.start_time_s = earliest_s_;
  commanded.move.to_m = end_m;
  commanded.start_uncertainty_s = std::isfinite(latest_s_) ? latest_s_ - earliest_s_ : 1.0;
  return commanded;
}

double MoveTracker::latest_end_s() const {
  return (std::isfinite(latest_s_) ? latest_s_ : move_.start_time_s) + duration_s(move_);
}

double end_of_way_m(const StageMove& move, double reported_m, bool is_at_rest, double near_m) {
  const double half_m = 0.5 * std::abs(move.to_m - move.from_m);  // it may not have begun
  const bool is_there = is_at_rest && std::abs(reported_m - move.to_m) < std::min(near_m, half_m);
  return is_there ? move.to_m : reported_m;
}

}  // namespace viscard
