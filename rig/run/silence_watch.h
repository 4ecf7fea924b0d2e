#pragma once

namespace viscard {

// Tells when a stream of readings has stopped, on the wall clock, within a few periods and yet not
// for every hiccup of the machine. Only time spent listening counts: whatever the device sent while
// this process or the whole machine stood still is there at the next look, so a long pass of the
// loop counts as a short one. The limit is three periods, or twice the longest silence heard while
// the stage stood, but at least 50 ms (an FTDI adapter's latency timer of 16 ms, and schedulers)
// and that allowance at most 250 ms.
class SilenceWatch {
 public:
  // floor_s: replaces the 100 ms where the readings come from an emulated rig in a hurry.
  explicit SilenceWatch(double floor_s = 0.1) : floor_s_(floor_s) {}

  // One pass of the loop, ended at wall_s; has_arrived: it brought a reading.
  void pass(double wall_s, bool has_arrived, bool is_moving);

  double silent_s() const { return silent_s_; }
  // period_s on the wall.
  double limit_s(double period_s) const;
  bool is_silent(double period_s) const { return silent_s_ >= limit_s(period_s); }

 private:
  double floor_s_;
  double last_pass_s_ = -1.0;
  double silent_s_ = 0.0;
  double longest_at_rest_s_ = 0.0;
};

}  // namespace viscard
