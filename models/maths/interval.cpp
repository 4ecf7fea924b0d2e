#include "models/maths/interval.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace viscard {

Interval middle_95(std::vector<double> sample, double share_beyond) {
  constexpr double kBeyond = 0.025;
  if (sample.empty()) return {};
  if (share_beyond > kBeyond) {
    const double infinity = std::numeric_limits<double>::infinity();
    return {-infinity, infinity};
  }
  std::sort(sample.begin(), sample.end());
  const auto at = [&](double share) {
    const auto last = static_cast<double>(sample.size() - 1);
    const double place = std::clamp(share * last, 0.0, last);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, sample.size() - 1);
    return sample[below] + (place - static_cast<double>(below)) * (sample[above] - sample[below]);
  };
  const double low = (kBeyond - share_beyond) / (1.0 - share_beyond);
  return {at(low), at(1.0 - low)};
}

}  // namespace viscard
