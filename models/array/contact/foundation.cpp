#include "models/array/contact/foundation.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

// By bisection; infinite if no column lies under the shape.
double depth_of_columns_m(const std::vector<FoundationColumn>& columns, double force_N) {
  double low_m = HUGE_VAL, softest_N_m = HUGE_VAL;
  for (const FoundationColumn& column : columns) {
    low_m = std::min(low_m, column.mean_m);
    softest_N_m = std::min(softest_N_m, column.stiffness_Pa_m * column.area_m2);
  }
  if (!std::isfinite(low_m)) return low_m;
  double high_m = low_m + force_N / softest_N_m;  // one column alone bears it
  for (int i = 0; i < 60; ++i) {
    const double middle_m = 0.5 * (low_m + high_m);
    double sum_N = 0.0;
    for (const FoundationColumn& column : columns) sum_N += column.force_N(middle_m);
    (sum_N < force_N ? low_m : high_m) = middle_m;
  }
  return high_m;
}

// Largest mean pull on the column from where it is touched to the end of the path, at most its limit. 0 for a top
// that is not touched, or not covered.
double largest_pull_Pa(const FoundationColumn& column, const std::vector<double>& path_m,
                       bool lets_go) {
  if (!std::isfinite(column.highest_m)) return 0.0;
  const auto touched = std::find_if(path_m.begin(), path_m.end(),
                                    [&](double depth_m) { return depth_m > column.lowest_m; });
  if (touched == path_m.end()) return 0.0;
  if (lets_go) return column.limit_Pa;
  const double least_m = *std::min_element(touched, path_m.end());
  return std::clamp(column.stiffness_Pa_m * (column.mean_m - least_m), 0.0, column.limit_Pa);
}

}  // namespace

double FoundationColumn::force_N(double depth_m) const {
  return std::max(depth_m - mean_m, 0.0) * stiffness_Pa_m * area_m2;
}

FoundationPress foundation_press(const std::vector<FoundationColumn>& columns,
                                 const ShapePress& press, bool wants_release) {
  FoundationPress answer;
  const double depth_m =
      press.force_N > 0.0 ? depth_of_columns_m(columns, press.force_N) : press.depth_m;
  answer.depth_m = depth_m;
  double overlap_m = 0.0, lifted_m = 0.0, turned_m = 0.0;
  answer.lowest_m = columns.front().lowest_m;
  for (const FoundationColumn& column : columns) {
    answer.lowest_m = std::min(answer.lowest_m, column.lowest_m);
    answer.shortening = std::max(answer.shortening, (depth_m - column.mean_m) / column.length_m);
    answer.covers_all = answer.covers_all && std::isfinite(column.highest_m);
    answer.largest_Pa = std::max(answer.largest_Pa, column.force_N(depth_m) / column.area_m2);
    answer.pull_Pa =
        std::max(answer.pull_Pa, largest_pull_Pa(column, path_of(press), wants_release));
    overlap_m = std::max(overlap_m, depth_m - column.lowest_m);
    const double pulled_m =
        kPullOfBend * column.bent_m * column.length_m / column.radius_m + column.mean_m;
    lifted_m = std::max(lifted_m, std::max(column.highest_m, pulled_m) - depth_m);
    turned_m = std::max(turned_m, 0.5 * (std::min(column.highest_m, depth_m) - column.lowest_m));
  }
  if (!(overlap_m > 0.0)) return answer;
  answer.lift = std::min(lifted_m / overlap_m, 1.0);
  answer.turn = std::min(turned_m / overlap_m, 1.0);
  return answer;
}

}  // namespace viscard
