#pragma once

namespace viscard {

// CLOCK_MONOTONIC, s.
double monotonic_s();

// Time of a run: 0 when made, then CLOCK_MONOTONIC times the declared speed of an emulated rig (1
// on a real one). "Rig time" is this clock, "wall time" is what passes in the room.
class RigClock {
 public:
  // Throws std::invalid_argument unless speed is positive and finite.
  explicit RigClock(double speed = 1.0);

  double now_s() const { return (monotonic_s() - origin_s_) * speed_; }
  double speed() const { return speed_; }
  // The rig time that passes while the wall clock makes that many seconds: deadlines for answers of
  // processors and cables are meant on the wall.
  double from_wall_s(double wall_s) const { return wall_s * speed_; }

 private:
  double speed_;
  double origin_s_;
};

}  // namespace viscard
