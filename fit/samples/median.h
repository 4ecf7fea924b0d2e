#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace viscard {

// The middle one of the sorted values, of an even number the upper; 0 of none.
inline double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Of |x| over the standard deviation, for normal x.
inline constexpr double kMedianOfNormal = 0.6744897501960817;

}  // namespace viscard
