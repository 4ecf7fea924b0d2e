#include "models/experiment/motion_profile.h"

#include "models/maths/require.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

struct Phases {
  double rise_s;    // speeding up, and again slowing down
  double cruise_s;  // at full speed
  double top_m_s;
  double direction;

  double total_s() const { return 2.0 * rise_s + cruise_s; }
};

Phases phases_of(const StageMove& move) {
  const double way_m = std::abs(move.to_m - move.from_m);
  const double direction = move.to_m >= move.from_m ? 1.0 : -1.0;
  double top_m_s = move.speed_m_s;
  double rise_s = top_m_s / move.acceleration_m_s2;
  if (rise_s * top_m_s > way_m) {  // never reaches full speed
    rise_s = std::sqrt(way_m / move.acceleration_m_s2);
    top_m_s = rise_s * move.acceleration_m_s2;
    return {rise_s, 0.0, top_m_s, direction};
  }
  return {rise_s, way_m / top_m_s - rise_s, top_m_s, direction};
}

}  // namespace

void validate(const StageMove& move) {
  require_positive("speed of the stage", move.speed_m_s, "m/s");
  require_positive("acceleration of the stage", move.acceleration_m_s2, "m/s2");
  require(
      std::isfinite(move.from_m) && std::isfinite(move.to_m) && std::isfinite(move.start_time_s),
      "a stage move needs finite positions and a finite start time");
}

double duration_s(const StageMove& move) {
  return phases_of(move).total_s();
}

double position_m(const StageMove& move, double time_s) {
  const Phases phases = phases_of(move);
  const double t = time_s - move.start_time_s;
  const double total_s = phases.total_s();
  if (t <= 0.0) return move.from_m;
  if (t >= total_s) return move.to_m;
  const double a = move.acceleration_m_s2;
  if (t < phases.rise_s) return move.from_m + phases.direction * 0.5 * a * t * t;
  if (t < phases.rise_s + phases.cruise_s) {
    return move.from_m + phases.direction * phases.top_m_s * (t - 0.5 * phases.rise_s);
  }
  const double left_s = total_s - t;
  return move.to_m - phases.direction * 0.5 * a * left_s * left_s;
}

double velocity_m_s(const StageMove& move, double time_s) {
  const Phases phases = phases_of(move);
  const double t = time_s - move.start_time_s;
  const double total_s = phases.total_s();
  if (t <= 0.0 || t >= total_s) return 0.0;
  const double ramp_s = std::min({t, total_s - t, phases.rise_s});
  return phases.direction * move.acceleration_m_s2 * ramp_s;
}

std::vector<double> knots_s(const StageMove& move) {
  const Phases phases = phases_of(move);
  const double start_s = move.start_time_s;
  std::vector<double> knots{start_s, start_s + phases.rise_s};
  if (phases.cruise_s > 0.0) knots.push_back(start_s + phases.rise_s + phases.cruise_s);
  knots.push_back(start_s + 2.0 * phases.rise_s + phases.cruise_s);
  return knots;
}

double position_m(const std::vector<StageMove>& moves, double time_s) {
  if (moves.empty()) return 0.0;
  const StageMove* current = &moves.front();
  for (const StageMove& move : moves) {
    if (move.start_time_s > time_s) break;
    current = &move;
  }
  return position_m(*current, time_s);
}

double quantised_m(double position_m, double steps_per_m) {
  return std::round(position_m * steps_per_m) / steps_per_m;
}

}  // namespace viscard
