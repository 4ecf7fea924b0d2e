#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace viscard {

// Median; the upper of the two middle values if their number is even, 0 if there are none.
inline double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Median of |x| over the standard deviation, for normally distributed x.
inline constexpr double kMedianOfNormal = 0.6744897501960817;

}  // namespace viscard
