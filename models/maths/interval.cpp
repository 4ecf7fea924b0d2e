#include "models/maths/interval.h"

#include <algorithm>
#include <cstddef>

namespace viscard {

Interval middle_95(std::vector<double> sample) {
  if (sample.empty()) return {};
  std::sort(sample.begin(), sample.end());
  const auto at = [&](double share) {
    const double place = share * static_cast<double>(sample.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, sample.size() - 1);
    return sample[below] + (place - static_cast<double>(below)) * (sample[above] - sample[below]);
  };
  return {at(0.025), at(0.975)};
}

}  // namespace viscard
