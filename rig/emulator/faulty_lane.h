#pragma once

#include "rig/emulator/line_faults.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <random>
#include <string>

namespace viscard {

// One direction of a disturbed line: takes bytes, applies faults at random and gives out what is
// due. Times are wall times.
class FaultyLane {
 public:
  FaultyLane(const FaultRates& rates, double longest_delay_s, std::uint64_t seed)
      : rates_(rates), longest_delay_s_(longest_delay_s), random_(seed) {}

  void take(std::string bytes, double now_s, FaultCounts& counts);
  std::string due(double now_s);
  void clear() { pieces_.clear(); }
  void heal() { rates_ = {}; }
  bool wants_hang_up() const { return wants_hang_up_; }

 private:
  struct Piece {
    double due_s;
    std::string bytes;
  };
  bool happens(double chance, FaultCounts& counts) {
    const bool does = std::bernoulli_distribution(chance)(random_);
    counts.faults += does ? 1 : 0;
    return does;
  }
  std::size_t below(std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_);
  }
  double upto(double most) { return std::uniform_real_distribution<double>(0.0, most)(random_); }
  void corrupt(std::string& bytes, FaultCounts& counts);
  void push(std::string bytes, double due_s);

  FaultRates rates_;
  double longest_delay_s_;
  std::mt19937_64 random_;
  std::deque<Piece> pieces_;
  bool wants_hang_up_ = false;
};

}  // namespace viscard
