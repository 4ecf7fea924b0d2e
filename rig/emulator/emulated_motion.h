#pragma once

#include "models/experiment/motion_profile.h"

#include <vector>

namespace viscard {

// The position of a stage driven by GRBL at any time; m and s. Moves run from rest to rest with a
// trapezoid of speed and end on whole steps. Within a move the position is smooth: at the hundreds
// of steps per second of a test the inertia of the rotor smooths single (micro)steps.
//
// GRBL passes steps to its interrupt in a queue of six segments of at least 1.25 steps or 10 ms
// each (gnea/grbl stepper.c: SEGMENT_BUFFER_SIZE, REQ_MM_INCREMENT_SCALAR, DT_SEGMENT). So a feed
// hold or jog cancel begins to slow the motion only after max(7.5 steps, 60 ms); a reset stops it
// at once.
class EmulatedMotion {
 public:
  EmulatedMotion(double steps_per_m, double position_m);

  double position_m(double time_s) const;
  double velocity_m_s(double time_s) const;
  bool is_moving(double time_s) const { return time_s < end_time_s(); }
  double end_time_s() const;
  double end_position_m() const { return end_m_; }
  // The first time after time_s at which the acceleration changes, or infinity.
  double next_knot_s(double time_s) const;

  // Precondition: not moving. The end is rounded to whole steps.
  void start(double time_s, double to_m, double speed_m_s, double acceleration_m_s2);
  // The same move with a further end, as a planner joins moves in line. Precondition: it does not
  // brake yet.
  void extend(double to_m);
  // The stage stands for that time and then goes on with its move.
  void stand_still(double time_s, double for_s);
  void stop_gently(double time_s, double acceleration_m_s2);
  void stop_at_once(double time_s);
  void set_steps_per_m(double steps_per_m) { steps_per_m_ = steps_per_m; }

 private:
  struct Piece {
    double start_s, duration_s, from_m, velocity_m_s, acceleration_m_s2;
  };
  struct Stall {
    double time_s, for_s;
  };
  const Piece* piece_at(double time_s) const;
  void cut(double time_s);

  double steps_per_m_;
  double end_m_;
  std::vector<Piece> pieces_;  // of the current or last move
  std::vector<Stall> stalls_;  // in it
  StageMove move_;
};

}  // namespace viscard
