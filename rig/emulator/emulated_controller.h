#pragma once

#include <string>
#include <string_view>

namespace viscard {

// A motion controller as seen on its wire, with the stage it moves. Times on the emulated clock,
// positions in m on the axis that grows toward the specimen, 0 at power-up.
class EmulatedController {
 public:
  virtual ~EmulatedController() = default;

  // Power-up or opening of the port of a board that resets then.
  virtual void reset(double time_s) = 0;
  // Bytes from the host, in order, and what they do at time_s.
  virtual void receive(std::string_view bytes, double time_s) = 0;
  // Lets queued moves and delayed answers happen up to time_s. Call before the position is asked
  // for any time up to time_s.
  virtual void tick(double time_s) = 0;
  virtual std::string take_output() = 0;

  virtual double bench_position_m(double time_s) const = 0;
  virtual double next_knot_s(double time_s) const = 0;
  virtual bool is_moving(double time_s) const = 0;
  // A limit switch closes now, or the motor stalls where there is none.
  virtual void hit_limit(double time_s) = 0;
};

}  // namespace viscard
