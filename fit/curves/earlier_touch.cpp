#include "fit/curves/earlier_touch.h"

#include "fit/curves/contact_course.h"
#include "models/material/hereditary.h"

#include <algorithm>
#include <cmath>

namespace viscard {

double EarlierTouch::depth_at_m(double at_s) const {
  if (is_empty() || at_s <= time_s.front()) return 0.0;
  if (at_s >= time_s.back()) return depth_m.back();
  const auto next = std::upper_bound(time_s.begin(), time_s.end(), at_s);
  const auto i = static_cast<std::size_t>(next - time_s.begin());
  const double share = (at_s - time_s[i - 1]) / (time_s[i] - time_s[i - 1]);
  return depth_m[i - 1] + share * (depth_m[i] - depth_m[i - 1]);
}

// d phi_1/d ln tau = x (phi_1 - phi_2).
EarlierTouch::Memory EarlierTouch::memory_at(double at_s, double tau_s) const {
  Memory memory;
  for (std::size_t i = 1; i <= time_s.size() && time_s[i - 1] < at_s; ++i) {
    const double end_s = i < time_s.size() ? std::min(time_s[i], at_s) : at_s;
    const double x = (end_s - time_s[i - 1]) / tau_s;
    const double change_m = depth_at_m(end_s) - depth_m[i - 1];
    const double decay = std::exp(-x), p1 = phi1(x);
    memory.slope_m = decay * (memory.slope_m + x * memory.value_m) + change_m * x * (p1 - phi2(x));
    memory.value_m = decay * memory.value_m + p1 * change_m;
  }
  return memory;
}

EarlierTouch earlier_touch(std::span<const double> time_s, std::span<const double> depth_m,
                           const PronySeries& series) {
  EarlierTouch touch;
  const auto touched =
      std::find_if(depth_m.begin(), depth_m.end(), [](double z) { return z > 0.0; });
  const auto first = static_cast<std::size_t>(touched - depth_m.begin());
  if (first == depth_m.size()) return touch;
  const ContactCourse course = contact_course(time_s, depth_m, 0.0, first, series);
  if (first > 0) {
    touch.time_s.push_back(time_s[first - 1]);
    touch.depth_m.push_back(0.0);
  }
  touch.time_s.insert(touch.time_s.end(), time_s.begin() + static_cast<std::ptrdiff_t>(first),
                      time_s.end());
  touch.depth_m.insert(touch.depth_m.end(),
                       course.surface_m.begin() + static_cast<std::ptrdiff_t>(first),
                       course.surface_m.end());
  return touch;
}

double relative_change(const EarlierTouch& a, const EarlierTouch& b) {
  double change_m = 0.0, deepest_m = 0.0;
  for (const EarlierTouch* course : {&a, &b}) {
    for (std::size_t i = 0; i < course->time_s.size(); ++i) {
      const double at_s = course->time_s[i];
      change_m = std::max(change_m, std::abs(a.depth_at_m(at_s) - b.depth_at_m(at_s)));
      deepest_m = std::max(deepest_m, std::abs(course->depth_m[i]));
    }
  }
  return deepest_m > 0.0 ? change_m / deepest_m : 0.0;
}

}  // namespace viscard
