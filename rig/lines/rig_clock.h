#pragma once

#include "rig/lines/host_lateness.h"

namespace viscard {

// CLOCK_MONOTONIC in s.
double monotonic_s();

// An emulated rig whose time waits for this program: it passes only in pass(). However busy the
// computer is, the program is never late for such a rig.
class WaitingRig {
 public:
  virtual ~WaitingRig() = default;
  WaitingRig& operator=(WaitingRig&&) = delete;  // neither copied nor moved

  virtual double now_s() const = 0;
  // Lets time pass until the rig has sent bytes, at most longest_s.
  virtual void pass(double longest_s) = 0;

 protected:
  WaitingRig() = default;
};

// The clock of a run. It starts at 0 when it is made and runs at the declared speed of an emulated
// rig times CLOCK_MONOTONIC (speed 1 on a real rig), or is the time of a rig that waits. "Rig time"
// is this clock; "wall time" is the time that passes in the room. For a rig that waits both are the
// same. Not for two threads at once.
class RigClock {
 public:
  // Throws std::invalid_argument unless speed is positive and finite.
  explicit RigClock(double speed = 1.0);
  // The rig must outlive the clock.
  explicit RigClock(WaitingRig& rig) : rig_(&rig), origin_s_(rig.now_s()) {}

  double now_s() const { return (look_s() - origin_s_) * speed_; }
  double speed() const { return speed_; }
  // The rig time that passes in wall_s of wall time. Deadlines for answers of processors and cables
  // are wall times.
  double from_wall_s(double wall_s) const { return wall_s * speed_; }
  // Wall time in which this program could listen: for deadlines, which a delay of the computer must
  // not end.
  double awake_s() const;
  const HostLateness& lateness() const { return lateness_; }
  // All delays of this program so far, in rig time.
  double late_s() const { return from_wall_s(lateness_.total_s()); }

  bool waits() const { return rig_ != nullptr; }
  // Precondition: waits().
  void pass(double longest_s) const { rig_->pass(longest_s); }
  // The program is about to wait for this long (wall time); this is no lateness.
  void expect_wait(double wait_s) const { lateness_.expect_wait(wait_s); }

 private:
  double look_s() const;

  WaitingRig* rig_ = nullptr;
  double speed_ = 1.0;
  double origin_s_;
  mutable HostLateness lateness_;
};

}  // namespace viscard
