#include "rig/stages/move_tracker.h"

#include <catch2/catch.hpp>

namespace viscard {

TEST_CASE("position reports narrow down when a move began", "[rig]") {
  // The command was written at 10 s and answered at 10.3 s; the move began at 10.05 s.
  const StageMove move{10.0, 0.0, 1e-3, 0.5e-3, 0.2};
  StageMove truth = move;
  truth.start_time_s = 10.05;
  MoveTracker tracker(move, 0.8e-6);
  tracker.acknowledged(10.3);
  for (int i = 0; i < 20; ++i) {
    const double asked_s = 10.06 + 0.1 * i;
    tracker.reported(asked_s, asked_s + 0.008, position_m(truth, asked_s + 0.004));
  }
  const CommandedMove best = tracker.best(1e-3);
  CHECK(best.move.start_time_s <= 10.05);
  CHECK(best.move.start_time_s + best.start_uncertainty_s >= 10.05);
  // 8 ms between question and answer, and 2 x 0.8 um at 0.5 mm/s.
  CHECK(best.start_uncertainty_s <= 0.008 + 2 * 0.8e-6 / 0.5e-3 + 1e-6);
}

TEST_CASE("a report that contradicts the others does not change the start", "[rig]") {
  const StageMove move{0.0, 0.0, 1e-3, 0.5e-3, 0.2};
  MoveTracker tracker(move, 0.8e-6);
  tracker.acknowledged(0.01);
  tracker.reported(1.0, 1.01, 0.0);  // a late answer: the stage cannot still be at the start
  const CommandedMove best = tracker.best(1e-3);
  CHECK(best.move.start_time_s == 0.0);
  CHECK(best.start_uncertainty_s == Approx(0.02).margin(1e-12));
}

}  // namespace viscard
