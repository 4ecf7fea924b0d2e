#include "rig/emulator/emulated_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace viscard {

EmulatedMotion::EmulatedMotion(double steps_per_m, double position_m)
    : steps_per_m_(steps_per_m), end_m_(quantised_m(position_m, steps_per_m)) {}

double EmulatedMotion::end_time_s() const {
  return pieces_.empty() ? -std::numeric_limits<double>::infinity()
                         : pieces_.back().start_s + pieces_.back().duration_s;
}

const EmulatedMotion::Piece* EmulatedMotion::piece_at(double time_s) const {
  const Piece* found = nullptr;
  for (const Piece& piece : pieces_) {
    if (piece.start_s <= time_s) found = &piece;
  }
  return found;
}

double EmulatedMotion::position_m(double time_s) const {
  if (!is_moving(time_s)) return end_m_;
  const Piece* piece = piece_at(time_s);
  if (piece == nullptr) return pieces_.front().from_m;
  const double t = time_s - piece->start_s;
  return piece->from_m + t * (piece->velocity_m_s + 0.5 * t * piece->acceleration_m_s2);
}

double EmulatedMotion::velocity_m_s(double time_s) const {
  const Piece* piece = is_moving(time_s) ? piece_at(time_s) : nullptr;
  if (piece == nullptr) return 0.0;
  return piece->velocity_m_s + (time_s - piece->start_s) * piece->acceleration_m_s2;
}

double EmulatedMotion::next_knot_s(double time_s) const {
  for (const Piece& piece : pieces_) {
    if (piece.start_s > time_s) return piece.start_s;
  }
  const double end_s = end_time_s();
  return end_s > time_s ? end_s : std::numeric_limits<double>::infinity();
}

void EmulatedMotion::start(double time_s, double to_m, double speed_m_s, double acceleration_m_s2) {
  const StageMove move{time_s, end_m_, quantised_m(to_m, steps_per_m_), speed_m_s,
                       acceleration_m_s2};
  move_ = move;
  pieces_.clear();
  stalls_.clear();
  if (move.to_m == move.from_m) return;
  const double direction = move.to_m > move.from_m ? 1.0 : -1.0;
  const std::vector<double> knots = knots_s(move);
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
    const double middle_s = 0.5 * (knots[i] + knots[i + 1]);
    const bool is_cruise = knots.size() == 4 && i == 1;
    const double sign = is_cruise ? 0.0 : (i == 0 ? direction : -direction);
    const double at_start_m_s =
        viscard::velocity_m_s(move, middle_s) - sign * acceleration_m_s2 * (middle_s - knots[i]);
    pieces_.push_back({knots[i], knots[i + 1] - knots[i], viscard::position_m(move, knots[i]),
                       at_start_m_s, sign * acceleration_m_s2});
  }
  end_m_ = move.to_m;
}

void EmulatedMotion::extend(double to_m) {
  const std::vector<Stall> stalls = stalls_;
  end_m_ = move_.from_m;
  start(move_.start_time_s, to_m, move_.speed_m_s, move_.acceleration_m_s2);
  for (const Stall& stall : stalls) stand_still(stall.time_s, stall.for_s);
}

void EmulatedMotion::stand_still(double time_s, double for_s) {
  if (!is_moving(time_s)) return;
  stalls_.push_back({time_s, for_s});
  std::vector<Piece> made;
  for (Piece piece : pieces_) {
    const double gone_s = time_s - piece.start_s;
    if (gone_s >= piece.duration_s) {
      made.push_back(piece);
      continue;
    }
    if (gone_s >= 0.0) {
      const double here_m = position_m(time_s);
      const double here_m_s = velocity_m_s(time_s);
      made.push_back(
          {piece.start_s, gone_s, piece.from_m, piece.velocity_m_s, piece.acceleration_m_s2});
      made.push_back({time_s, for_s, here_m, 0.0, 0.0});
      piece = {time_s, piece.duration_s - gone_s, here_m, here_m_s, piece.acceleration_m_s2};
    }
    piece.start_s += for_s;
    made.push_back(piece);
  }
  pieces_ = made;
}

void EmulatedMotion::cut(double time_s) {
  while (!pieces_.empty() && pieces_.back().start_s >= time_s) pieces_.pop_back();
  if (!pieces_.empty()) pieces_.back().duration_s = time_s - pieces_.back().start_s;
}

void EmulatedMotion::stop_gently(double time_s, double acceleration_m_s2) {
  // The queued segments are still carried out, to the later of these.
  constexpr double kQueuedSteps = 7.5;
  constexpr double kQueued_s = 0.06;
  if (!is_moving(time_s)) return;
  const double here_m = position_m(time_s);
  double low_s = time_s;
  double high_s = end_time_s();
  if (std::abs(end_m_ - here_m) <= kQueuedSteps / steps_per_m_) return;
  for (int i = 0; i < 60; ++i) {
    const double middle_s = 0.5 * (low_s + high_s);
    const bool is_far = std::abs(position_m(middle_s) - here_m) >= kQueuedSteps / steps_per_m_;
    (is_far ? high_s : low_s) = middle_s;
  }
  const double slow_s = std::max(high_s, time_s + kQueued_s);
  if (slow_s >= end_time_s()) return;
  const double from_m = position_m(slow_s);
  const double velocity = velocity_m_s(slow_s);
  const double direction = velocity >= 0.0 ? 1.0 : -1.0;
  const double way_m = 0.5 * velocity * velocity / acceleration_m_s2;
  // Ends on the next whole step, but never beyond the end of the move.
  const double steps = (from_m + direction * way_m) * steps_per_m_ * direction;
  const double end_m =
      direction * std::min(std::ceil(steps - 1e-6) / steps_per_m_, direction * end_m_);
  const double braking_m = std::abs(end_m - from_m);
  cut(slow_s);
  if (braking_m > 0.0 && velocity != 0.0) {
    const double duration_s = 2.0 * braking_m / std::abs(velocity);
    pieces_.push_back({slow_s, duration_s, from_m, velocity, -velocity / duration_s});
  }
  end_m_ = end_m;
}

void EmulatedMotion::stop_at_once(double time_s) {
  if (!is_moving(time_s)) return;
  const double here_m = quantised_m(position_m(time_s), steps_per_m_);
  cut(time_s);
  end_m_ = here_m;
}

}  // namespace viscard
