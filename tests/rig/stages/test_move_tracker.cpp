#include "rig/stages/move_tracker.h"

#include <catch2/catch.hpp>

#include <algorithm>

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

TEST_CASE("the reports after a standstill give its length", "[rig]") {
  const double stood_s = GENERATE(0.0, 0.05, 0.2, 2.0);
  const StageMove move{0.0, 0.0, 0.26e-3, 0.25e-3, 0.2};
  MoveTracker tracker(move, 0.8e-6);
  tracker.acknowledged(0.005);
  for (double asked_s = 0.1; asked_s < 1.0 + stood_s; asked_s += 0.1) {
    const double moved_s = asked_s < 0.35 ? asked_s : std::max(0.35, asked_s - stood_s);
    tracker.reported(asked_s, asked_s + 0.004, position_m(move, moved_s + 0.002));
  }
  // The move may have begun 15 ms after its command, and two reports are wanted.
  CHECK(tracker.lag_s() == Approx(std::max(0.0, stood_s - 0.01)).margin(0.02));
  CHECK((tracker.lag_s() > 0.0) == (stood_s > 0.0));
}

TEST_CASE("a servo that rests short of its target is at its end, one that has not begun is not",
          "[rig]") {
  const StageMove move{0.0, 0.0, 0.26e-3, 0.25e-3, 0.2};
  CHECK(end_of_way_m(move, 0.2585e-3, true, 2e-6) == move.to_m);
  CHECK(end_of_way_m(move, 0.2585e-3, false, 2e-6) == 0.2585e-3);
  CHECK(end_of_way_m(move, 0.25e-3, true, 2e-6) == 0.25e-3);
  const StageMove short_one{0.0, 0.0, 1e-6, 0.25e-3, 0.2};
  CHECK(end_of_way_m(short_one, 0.0, true, 2e-6) == 0.0);
}

TEST_CASE("one late report is no lag", "[rig]") {
  const StageMove move{0.0, 0.0, 1e-3, 0.5e-3, 0.2};
  MoveTracker tracker(move, 0.8e-6);
  tracker.acknowledged(0.01);
  tracker.reported(1.0, 1.01, 0.0);
  tracker.reported(1.1, 1.11, position_m(move, 1.105));
  CHECK(tracker.n_contradictions() == 1);
  CHECK(tracker.lag_s() == 0.0);
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
