#include "fit/assembly/two_point_modulus.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

struct Point {
  double time_s = 0.0, force_N = 0.0, depth_m = 0.0, count = 0.0;
};

// Mean of the readings near a depth, or the nearest reading if there are none.
Point point_near(const std::vector<double>& time_s, const std::vector<double>& force_N,
                 const std::vector<double>& depth_m, double wanted_m, double reach_m) {
  Point point;
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    if (std::abs(depth_m[i] - wanted_m) < std::abs(depth_m[nearest] - wanted_m)) nearest = i;
    if (std::abs(depth_m[i] - wanted_m) > reach_m) continue;
    point.time_s += time_s[i];
    point.force_N += force_N[i];
    point.depth_m += depth_m[i];
    point.count += 1.0;
  }
  if (point.count == 0.0) return {time_s[nearest], force_N[nearest], depth_m[nearest], 1.0};
  point.time_s /= point.count;
  point.force_N /= point.count;
  point.depth_m /= point.count;
  return point;
}

}  // namespace

std::optional<TwoPointModulus> two_point_modulus(const std::vector<double>& time_s,
                                                 const std::vector<double>& force_N,
                                                 const std::vector<double>& depth_m,
                                                 const PunchContact& contact, double sigma_N) {
  if (depth_m.size() < 6) return std::nullopt;
  const double full_m = *std::max_element(depth_m.begin(), depth_m.end());
  const Point low = point_near(time_s, force_N, depth_m, 0.2 * full_m, 0.02 * full_m);
  const Point high = point_near(time_s, force_N, depth_m, 0.9 * full_m, 0.02 * full_m);
  const double span_m = high.depth_m - low.depth_m;
  if (!(span_m > 0.0)) return std::nullopt;
  const double slope_N_m = (high.force_N - low.force_N) / span_m;
  const double nu = contact.poisson_ratio;
  TwoPointModulus result;
  result.modulus_Pa = slope_N_m / force_per_modulus_and_depth_m(contact);
  result.half_space_modulus_Pa = slope_N_m * (1.0 - nu * nu) / (2.0 * contact.punch_radius_m);
  result.se_Pa = result.modulus_Pa * sigma_N * std::sqrt(1.0 / low.count + 1.0 / high.count) /
                 std::abs(high.force_N - low.force_N);
  result.bias = "relaxation during the " + text_of(high.time_s - low.time_s, 3) +
                " s between the two points is ignored, so this lies below E0";
  return result;
}

}  // namespace viscard
