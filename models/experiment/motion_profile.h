#pragma once

#include <vector>

namespace viscard {

// One point-to-point move of a motion controller: the speed rises at `acceleration` to `speed`,
// stays constant and falls at the same rate (a trapezoid, or a triangle if the distance is too
// short for full speed). Positions in m on an axis that grows toward the specimen, times in s,
// speed > 0, acceleration > 0. Not a Course: its velocity, not its position, is linear between the knots.
struct StageMove {
  double start_time_s = 0.0;
  double from_m = 0.0;
  double to_m = 0.0;
  double speed_m_s = 0.0;
  double acceleration_m_s2 = 0.0;
};

// Throws std::invalid_argument unless speed and acceleration are positive and all values finite.
void validate(const StageMove& move);

// Time from the start of the move to its end.
double duration_s(const StageMove& move);

// Position at any time: from_m before the start, to_m after the end.
double position_m(const StageMove& move, double time_s);
double velocity_m_s(const StageMove& move, double time_s);

// Absolute times at which the acceleration changes (start, ends of the ramps, end), ascending.
// Between them the position is a parabola or a line, so a hereditary integral needs them as nodes.
std::vector<double> knots_s(const StageMove& move);

// Position of a stage that makes these moves one after another (ascending start times, each from
// the end of the previous one). Before the first move it is its from_m.
double position_m(const std::vector<StageMove>& moves, double time_s);

// The nearest position on a whole step.
double quantised_m(double position_m, double steps_per_m);

}  // namespace viscard
