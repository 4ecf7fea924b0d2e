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
  // Box & Muller, Ann. Math. Stat. 29 (1958) 610.
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(uniform(1e-300, 1.0)));
    return radius * std::cos(6.283185307179586 * uniform(0.0, 1.0));
  }
  bool chance(double p) { return uniform(0.0, 1.0) < p; }
  int below(int n) { return static_cast<int>(uniform(0.0, n)); }

 private:
  std::mt19937_64& random_;
};

}  // namespace viscard::test
