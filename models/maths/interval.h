#pragma once

#include <vector>

namespace viscard {

// 95 % interval of one parameter.
struct Interval {
  double low = 0.0;   // in the unit of the parameter
  double high = 0.0;  // likewise
};

// Half-width of a 95 % interval of a normal deviate in standard deviations: its 97.5 % quantile.
inline constexpr double kNormal95 = 1.959963984540054;

// The 2.5 % and 97.5 % quantiles of a sample in any order, linear between its values (Hyndman & Fan, Am.
// Stat. 50 (1996) 361, type 7); zero for an empty one. `share_beyond` of all values are not in the sample,
// because nothing is known of them; each counts as below the low end and above the high one. With more
// than 2.5 % of them the ends are infinite.
Interval middle_95(std::vector<double> sample, double share_beyond = 0.0);

}  // namespace viscard
