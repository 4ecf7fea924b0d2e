#pragma once

#include <cmath>
#include <random>

namespace viscard::test {

// Random numbers from a seeded generator. The distributions of <random> differ between standard
// libraries, so the formulas are written out here.
class Draw {
 public:
  explicit Draw(std::mt19937_64& random) : random_(random) {}
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }
  double log_uniform(double low, double high) {
    return std::exp(uniform(std::log(low), std::log(high)));
  }
  bool chance(double p) { return uniform(0.0, 1.0) < p; }
  int below(int n) { return static_cast<int>(uniform(0.0, n)); }

 private:
  std::mt19937_64& random_;
};

}  // namespace viscard::test
