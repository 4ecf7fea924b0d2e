#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace viscard {

// Finds single readings that stand out of their neighbours: a digit garbled on the wire that still
// makes a number, which nothing else in a stream of bare counts can show. A reading s_i is a spike
// if
//   d_i = s_i - (s_{i-1} + s_{i+1})/2
// exceeds 10 times its own usual size (noise, followed slowly; not less than the smallest step
// seen, which is the converter's own) and 4 times every difference between its neighbours (steps,
// ramps and peaks of true force have those). It can be told two readings later. What is smaller
// than that stays hidden, and two spoilt readings in a row hide one another.
class SpikeWatch {
 public:
  // Takes a reading in any unit; returns the index of an earlier one that was a spike.
  std::optional<std::int64_t> take(std::int64_t index, double value);
  // A reading that is known to be none: neighbours across it are not compared.
  void interrupt() { n_ = 0; }

 private:
  struct Reading {
    std::int64_t index = 0;
    double value = 0.0;
  };
  std::array<Reading, 5> last_;  // oldest first
  std::size_t n_ = 0;            // of them that count
  double usual_ = 0.0;           // mean of |d|, spikes left out
  double least_step_ = 0.0;      // smallest between two readings that is not 0
  int n_learnt_ = 0;
};

}  // namespace viscard
