#include "fit/samples/depth_course.h"

#include <algorithm>
#include <cmath>

namespace viscard {

std::vector<char> moved_samples(std::span<const double> depth_m) {
  constexpr double kShare = 0.02;
  std::vector<char> moved(depth_m.size(), 0);
  if (depth_m.empty()) return moved;
  const auto [low, high] = std::minmax_element(depth_m.begin(), depth_m.end());
  const double far_m = kShare * (*high - *low);
  double last_m = depth_m.front();
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    if (std::abs(depth_m[i] - last_m) <= far_m) continue;
    moved[i] = 1;
    last_m = depth_m[i];
  }
  return moved;
}

FirstLoading first_loading(std::span<const double> depth_m) {
  constexpr double kBack = 0.2, kNearly = 0.02;
  const auto [low, high] = std::minmax_element(depth_m.begin(), depth_m.end());
  const double far_m = kBack * (*high - *low);
  double lowest_m = depth_m.front(), peak_m = depth_m.front();
  FirstLoading loading;
  for (const double depth : depth_m) {
    if (depth > peak_m) peak_m = depth;
    const bool has_risen = peak_m - lowest_m >= far_m;
    if (has_risen && depth < peak_m - far_m) {
      loading.goes_back = true;
      break;
    }
    if (!has_risen && depth < lowest_m) lowest_m = peak_m = depth;
  }
  const double nearly_m = peak_m - kNearly * (peak_m - lowest_m);
  // After the lowest point before the peak, so that a record that begins deep is not misread.
  const auto lowest = std::find(depth_m.begin(), depth_m.end(), lowest_m);
  const auto loaded = std::find_if(lowest, depth_m.end(), [&](double d) { return d >= nearly_m; });
  loading.loaded = static_cast<std::size_t>(loaded - depth_m.begin());
  return loading;
}

}  // namespace viscard
