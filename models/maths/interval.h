#pragma once

namespace viscard {

// 95 % interval of one parameter.
struct Interval {
  double low = 0.0;   // in the unit of the parameter
  double high = 0.0;  // likewise
};

// Half-width of a 95 % interval of a normal deviate in standard deviations: its 97.5 % quantile.
inline constexpr double kNormal95 = 1.959963984540054;

}  // namespace viscard
