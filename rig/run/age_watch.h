#pragma once

#include <array>
#include <cstddef>

namespace viscard {

// How old a reading may be while the stage presses. The force at this moment is the one of the
// newest reading plus what has come since, so the age allowed is the force left until the limit over
// the rate at which the force grows, at most 0.25 s. That rate is the larger of the stiffness assumed
// times the speed, and what the last readings show.
class AgeWatch {
 public:
  // least_s: shortest age allowed, for an emulated rig whose clock runs fast.
  AgeWatch(double capacity_N, double least_s) : capacity_N_(capacity_N), least_s_(least_s) {}

  // A move toward the specimen that may press up to limit_N; assumed_N_s: stiffness times speed.
  void begin_move(double limit_N, double assumed_N_s);
  void take(double force_N, double made_at_s);

  // True if readings are so rare that the force could pass its limit between two of them: then the
  // stage has to move in steps and wait for a reading after each.
  bool needs_steps(double period_s) const;
  // Never shorter than it takes to read, judge and answer a reading: two periods and 25 ms.
  double allowed_s(double period_s) const;

 private:
  struct Reading {
    double force_N = 0.0;
    double made_at_s = 0.0;
  };
  double young_s(double force_N, double rate_N_s) const;
  double seen_rate_N_s() const;
  double newest_N() const;

  static constexpr std::size_t kSeen = 6;
  double capacity_N_, least_s_;
  double allowed_N_ = 0.0;
  double assumed_N_s_ = 0.0;
  std::array<Reading, kSeen> seen_{};  // the last ones, oldest first
  std::size_t n_ = 0;
};

}  // namespace viscard
