#pragma once

namespace viscard {

// Detects that a stream of readings has stopped, within a few periods of wall time, without a false
// alarm at every delay of the machine. Only time spent listening counts: what the device sent while
// this process or the whole machine stood still has arrived by the next pass, so a long pass counts
// as a short one. The limit is the larger of three periods and twice the longest silence seen while
// the stage was at rest; the latter is kept between floor_s, because an FTDI adapter holds bytes
// back for 16 ms and schedulers delay the process, and 250 ms.
class SilenceWatch {
 public:
  // floor_s: larger for an emulated rig whose clock runs fast.
  explicit SilenceWatch(double floor_s = 0.1) : floor_s_(floor_s) {}

  // One pass of the loop, ended at wall_s; has_arrived: a reading arrived in it.
  void pass(double wall_s, bool has_arrived, bool is_moving);

  double silent_s() const { return silent_s_; }
  // period_s: time between readings on the wall clock.
  double limit_s(double period_s) const;
  bool is_silent(double period_s) const { return silent_s_ >= limit_s(period_s); }

 private:
  double floor_s_;
  double last_pass_s_ = -1.0;
  double silent_s_ = 0.0;
  double longest_at_rest_s_ = 0.0;
};

}  // namespace viscard
