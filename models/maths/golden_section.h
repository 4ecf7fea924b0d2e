#pragma once

#include <numbers>

namespace viscard {

// The interval that golden_section() ends with.
struct GoldenBracket {
  double low = 0.0, high = 0.0;
  double best = 0.0;  // the better one of the two points inside that were tried last
  double middle() const { return 0.5 * (low + high); }
};

// Narrows the interval [low, high] around a minimum of f by golden section, until it is no longer than
// `width`. Each step takes one value of f. If f has several minima there, one of them is found; if it
// has none inside, the interval ends at the lower end of f. Source: Kiefer, Proc. Am. Math. Soc. 4
// (1953) 502.
template <class Function>
GoldenBracket golden_section(const Function& f, double low, double high, double width) {
  constexpr double kGolden = 1.0 / std::numbers::phi;
  double a = high - kGolden * (high - low);
  double b = low + kGolden * (high - low);
  double at_a = f(a);
  double at_b = f(b);
  while (high - low > width) {
    if (at_a < at_b) {
      high = b;
      b = a;
      at_b = at_a;
      a = high - kGolden * (high - low);
      at_a = f(a);
    } else {
      low = a;
      a = b;
      at_a = at_b;
      b = low + kGolden * (high - low);
      at_b = f(b);
    }
  }
  return {low, high, at_a < at_b ? a : b};
}

}  // namespace viscard
