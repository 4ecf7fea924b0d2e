#pragma once

#include "models/material/prony_series.h"

#include <span>
#include <vector>

namespace viscard {

// How deep the surface stood before the contact that is fitted: pressed by an earlier touch, then recovering
// without force. The relaxation that the touch began goes on in the fitted contact, which meets the surface
// where it then stands. Depths count from the contact position. Between its points the course is linear; before
// the first the surface rests at 0, after the last it stays.
struct EarlierTouch {
  std::vector<double> time_s, depth_m;

  bool is_empty() const { return time_s.empty(); }
  double depth_at_m(double time_s) const;

  // State of a branch, q = int exp(-(t - s)/tau) d(depth), and dq/d ln tau.
  struct Memory {
    double value_m = 0.0, slope_m = 0.0;
  };
  Memory memory_at(double time_s, double tau_s) const;
};

// depth_m: of the punch, below 0 out of contact. Empty if it never touches. The scale of the series does not
// matter.
EarlierTouch earlier_touch(std::span<const double> time_s, std::span<const double> depth_m,
                           const PronySeries& series);

// Largest difference of two courses over the deepest point of both.
double relative_change(const EarlierTouch& a, const EarlierTouch& b);
inline constexpr double kSameTouch =
    1e-3;  // of it: what such a change does to a modulus is beyond any reading

}  // namespace viscard
