#pragma once

namespace viscard {

// How late this program is. It looks at its clock all the time, so a look that comes later than the
// wait before it explains was delayed by the computer: by other programs or by a freeze of this
// one. In the meantime nothing could be watched. Wall times in s.
class HostLateness {
 public:
  // The program is about to wait for this long.
  void expect_wait(double wait_s) { expected_s_ += wait_s; }
  // The program looks at its clock.
  void look(double wall_s);

  double total_s() const { return total_s_; }

  // Delays that are long enough to be reported.
  int n_long() const { return n_long_; }
  double newest_long_s() const { return newest_long_s_; }
  // The newest of them if it ended less than within_s before the newest look, otherwise 0.
  double recent_s(double within_s) const;

 private:
  double last_look_s_ = -1.0;
  double expected_s_ = 0.0;
  double total_s_ = 0.0;
  int n_long_ = 0;
  double newest_long_s_ = 0.0;
  double newest_ended_s_ = -1e300;
};

}  // namespace viscard
