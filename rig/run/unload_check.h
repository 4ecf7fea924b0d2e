#pragma once

#include "rig/run/test_run.h"

#include <optional>

namespace viscard {

// Looks for steps that an open-loop stage has lost while it pressed. Its counter does not know of
// them, but the force does: for a linear specimen that was pressed by t within T and unloaded by u
// after a hold, T/2 or more after the unloading
//   F >= F_before - (u/t) F_peak,
// because a relaxation modulus is convex: at T/2 it is at most its mean over the ramp. A stage that
// has pressed less than it counts unloads too far. Frame and adhesion of a flat punch change nothing
// of that.
// It has to fall as well: a modulus that relaxes is least at the end, so at any time after the
// unloading F <= (1 - u/t) F_before. A larger force shows play of the screw, which the stage takes
// up when it turns round, and counts.
class UnloadCheck {
 public:
  explicit UnloadCheck(TestRun& run) : run_(run) {}

  // A move between two depths has ended; force_before_N: at its beginning.
  void take_move(double from_m, double force_before_N, double took_s);
  // Time after an unloading at which judge() has to be called; nothing if there is none to judge.
  std::optional<double> due_after_s() const;
  // Adds a doubt if the force is too small for a stage that has lost no steps, or too large for one
  // without play.
  void judge();

 private:
  void judge_lost_steps(double least_N, double force_N);
  void judge_play(double force_N);

  struct Press {
    double way_m = 0.0, peak_N = 0.0, took_s = 0.0, ended_s = 0.0;
  };
  TestRun& run_;
  std::optional<Press> press_;  // the first one, from the contact
  std::optional<double> least_N_;
  double before_N_ = 0.0;
  double unloaded_m_ = 0.0;
  double relaxed_N_ = 0.0;
};

}  // namespace viscard
