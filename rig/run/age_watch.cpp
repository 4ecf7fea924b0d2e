#include "rig/run/age_watch.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

constexpr double kOldest_s = 0.25;
// Of the capacity: by so much the force may pass its limit before it is seen.
constexpr double kBeyond = 0.05;
constexpr double kAnswer_s =
    0.025;  // bytes held back by an adapter (16 ms), and the stage's answer
constexpr double kPeriods = 2.0;

// One garbled reading among three does not count.
double median(double a, double b, double c) {
  return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

}  // namespace

void AgeWatch::begin_move(double limit_N, double assumed_N_s) {
  allowed_N_ = limit_N + kBeyond * capacity_N_;
  assumed_N_s_ = assumed_N_s;
}

void AgeWatch::take(double force_N, double made_at_s) {
  std::rotate(seen_.begin(), seen_.begin() + 1, seen_.end());
  seen_.back() = {std::abs(force_N), made_at_s};
  n_ = std::min(n_ + 1, kSeen);
}

double AgeWatch::newest_N() const {
  return n_ < 3 ? seen_[5].force_N : median(seen_[3].force_N, seen_[4].force_N, seen_[5].force_N);
}

double AgeWatch::seen_rate_N_s() const {
  if (n_ < kSeen) return 0.0;
  const double before_N = median(seen_[0].force_N, seen_[1].force_N, seen_[2].force_N);
  const double between_s = seen_[4].made_at_s - seen_[1].made_at_s;
  return between_s > 0.0 ? (newest_N() - before_N) / between_s : 0.0;
}

double AgeWatch::young_s(double force_N, double rate_N_s) const {
  const double room_N = std::max(0.0, allowed_N_ - force_N);
  return rate_N_s > 0.0 ? std::min(kOldest_s, room_N / rate_N_s) : kOldest_s;
}

bool AgeWatch::needs_steps(double period_s) const {
  return period_s > std::max(least_s_, young_s(newest_N(), assumed_N_s_));
}

double AgeWatch::allowed_s(double period_s) const {
  const double young = young_s(newest_N(), std::max(assumed_N_s_, seen_rate_N_s()));
  return std::max({young, least_s_, kPeriods * period_s + kAnswer_s});
}

}  // namespace viscard
