#pragma once

#include "rig/emulator/delayed_bytes.h"
#include "rig/emulator/emulated_motion.h"

#include <string>
#include <string_view>
#include <utility>

namespace viscard {

// A motion controller, as a host sees it on the wire, and the stage that it moves. Times on the
// emulated clock; positions in m on the axis that grows toward the specimen, 0 at power-up.
class EmulatedController {
 public:
  explicit EmulatedController(double steps_per_m) : motion_(steps_per_m, 0.0) {}
  virtual ~EmulatedController() = default;
  EmulatedController& operator=(EmulatedController&&) = delete;  // neither copied nor moved

  // Power-up, or the opening of a port that resets the board.
  virtual void reset(double time_s) = 0;
  // Takes bytes from the host in order; they act at time_s.
  virtual void receive(std::string_view bytes, double time_s) = 0;
  // Carries out queued moves and sends delayed answers up to time_s. Call it before asking for the
  // position at any time up to time_s.
  virtual void tick(double time_s) = 0;
  // A limit switch closes now; a controller without limit switches stalls.
  virtual void hit_limit(double time_s) = 0;

  std::string take_output() { return std::exchange(output_, {}); }
  double bench_position_m(double time_s) const { return motion_.position_m(time_s); }
  double next_knot_s(double time_s) const { return motion_.next_knot_s(time_s); }
  bool is_moving(double time_s) const { return motion_.is_moving(time_s); }

 protected:
  EmulatedMotion motion_;
  std::string output_;
  DelayedBytes answers_;
};

}  // namespace viscard
