#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace viscard {

// Finds single readings that stand out of their neighbours: a digit garbled on the wire that still
// makes a number, which nothing else in a stream of bare counts can show. A straight line is laid
// through the two readings before and the two behind (least squares). A reading is a spike if it is
// further from that line than 10 times its usual distance (the noise, followed slowly; not less
// than the converter's smallest step) and than 5 times what the four are from it. True forces stay
// below 3 times that: a corner or a peak makes 3, a step 2.5, a ramp 0. Told two readings later.
// What is smaller stays hidden, the first ten readings are learnt from, and two spoilt readings
// within three hide one another.
class SpikeWatch {
 public:
  // least: what noise counts as at least; without it the smallest step between two readings.
  explicit SpikeWatch(double least = 0.0) : least_(least) {}

  // Takes a reading in any unit; returns the index of an earlier one that was a spike.
  std::optional<std::int64_t> take(std::int64_t index, double value);
  // A reading that is known to be none: neighbours across it are not compared.
  void interrupt() { n_ = 0; }

 private:
  struct Reading {
    std::int64_t index = 0;
    double value = 0.0;
  };
  void learn(double distance, double noise);

  double least_;
  std::array<Reading, 5> last_;  // oldest first
  std::size_t n_ = 0;            // of them that count
  double usual_ = 0.0;           // distance, a running median
  double least_step_ = 0.0;      // smallest between two readings that is not 0
  int n_learnt_ = 0;
};

}  // namespace viscard
