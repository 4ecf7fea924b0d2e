#pragma once

#include "fit/intervals/fit_result.h"

#include <algorithm>
#include <string>

namespace viscard::test {

inline bool has_flag(const FitResult& fit, const std::string& name) {
  return std::any_of(fit.flags.begin(), fit.flags.end(),
                     [&](const MaterialFlag& flag) { return flag.name == name; });
}

inline bool holds(const Interval& interval, double value) {
  return value >= interval.low && value <= interval.high;
}

}  // namespace viscard::test
