#pragma once

#include "rig/emulator/delayed_bytes.h"
#include "rig/emulator/emulated_motion.h"

#include <string>
#include <string_view>
#include <utility>

namespace viscard {

// What can happen to the answers of a controller. Times on the emulated clock.
struct AnswerHabits {
  int lose_every = 0;  // every n-th is not sent
  int late_every = 0;  // every n-th comes after late_s
  double late_s = 0.8;
  double delay_s = 0.0;  // of all others
};

// A motion controller, as a host sees it on the wire, and the stage that it moves. Times on the
// emulated clock; positions in m on the axis that grows toward the specimen.
class EmulatedController {
 public:
  // position_m: at power-up.
  explicit EmulatedController(double steps_per_m, double position_m = 0.0)
      : motion_(steps_per_m, position_m) {}
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

  // Its processor is kept busy: the stage stands, and the move goes on afterwards. The rig keeps
  // back the bytes of both directions meanwhile.
  void stall(double time_s, double for_s) { motion_.stand_still(time_s, for_s); }

  std::string take_output() { return std::exchange(output_, {}); }
  double bench_position_m(double time_s) const { return motion_.position_m(time_s); }
  double next_knot_s(double time_s) const { return motion_.next_knot_s(time_s); }
  bool is_moving(double time_s) const { return motion_.is_moving(time_s); }
  // What the motor has counted and not travelled so far: a switch is found at another count then.
  void set_lost_m(double lost_m) { lost_m_ = lost_m; }

 protected:
  // bytes: with the end of the line.
  void send_answer(std::string bytes, double time_s, const AnswerHabits& habits) {
    ++n_answers_;
    const auto is_nth = [&](int every) { return every > 0 && n_answers_ % every == 0; };
    if (is_nth(habits.lose_every)) return;
    answers_.add(time_s + (is_nth(habits.late_every) ? habits.late_s : habits.delay_s),
                 std::move(bytes));
  }

  EmulatedMotion motion_;
  std::string output_;
  DelayedBytes answers_;
  double lost_m_ = 0.0;

 private:
  int n_answers_ = 0;
};

}  // namespace viscard
