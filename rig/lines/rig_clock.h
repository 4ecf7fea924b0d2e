#pragma once

namespace viscard {

// CLOCK_MONOTONIC in s.
double monotonic_s();

// The clock of a run. It starts at 0 when it is made and runs at the declared speed of an emulated
// rig times CLOCK_MONOTONIC (speed 1 on a real rig). "Rig time" is this clock; "wall time" is the
// time that passes in the room.
class RigClock {
 public:
  // Throws std::invalid_argument unless speed is positive and finite.
  explicit RigClock(double speed = 1.0);

  double now_s() const { return (monotonic_s() - origin_s_) * speed_; }
  double speed() const { return speed_; }
  // The rig time that passes in wall_s of wall time. Deadlines for answers of processors and cables
  // are wall times.
  double from_wall_s(double wall_s) const { return wall_s * speed_; }

 private:
  double speed_;
  double origin_s_;
};

}  // namespace viscard
