#include "models/array/contact/press_array.h"

#include "models/array/contact/point_waves.h"
#include "models/maths/require.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

// The surface stays above the whole top.
bool is_out_of_reach(const RigidShape& shape, const TouchedPillar& one, double radius_m,
                     double depth_m) {
  return least_height_m(shape, one.x_m, one.y_m, radius_m) > depth_m + one.above_m;
}

// Depth at which the first pillar is touched, from samples of each top.
double first_touch_m(const std::vector<TouchedPillar>& pillars,
                     const std::vector<TopContact>& classes, const RigidShape& shape) {
  double first_m = HUGE_VAL;
  for (const TouchedPillar& one : pillars) {
    const TopContact& contact = classes[static_cast<std::size_t>(one.of_class)];
    first_m = std::min(first_m, first_touch_of(shape, one, contact.compliance()).depth_m);
    // The tip may lie between these.
    const auto tip = round_tip(shape, one.x_m, one.y_m, contact.radius_m(), HUGE_VAL);
    if (!tip) continue;
    first_m =
        std::min(first_m, height_m(shape, one.x_m + tip->x_m, one.y_m + tip->y_m) - one.above_m);
  }
  return first_m;
}

}  // namespace

FirstTouch first_touch_of(const RigidShape& shape, const TouchedPillar& one,
                          const TopCompliance& top) {
  FirstTouch first;
  for (const double r_m : top.radius_m) {
    for (int a = 0; a < top.angles; ++a) {
      const double angle = point_angle(a, top.angles);
      const double at_m =
          height_m(shape, one.x_m + r_m * std::cos(angle), one.y_m + r_m * std::sin(angle)) -
          one.above_m;
      first.depth_m = std::min(first.depth_m, at_m);
      first.covers = first.covers && std::isfinite(at_m);
    }
  }
  return first;
}

PressedArray press_to_depth(const std::vector<TouchedPillar>& pillars,
                            const std::vector<TopContact>& classes, const RigidShape& shape,
                            double depth_m, TopBond bond, std::vector<Eigen::MatrixXd>* last) {
  if (last != nullptr) last->resize(pillars.size());
  PressedArray array;
  array.depth_m = depth_m;
  array.tops.reserve(pillars.size());
  for (const TouchedPillar& one : pillars) {
    const TopContact& contact = classes[static_cast<std::size_t>(one.of_class)];
    TopPressure top;
    const Overlap overlap = [&](double x_m, double y_m) {
      return depth_m + one.above_m - height_m(shape, one.x_m + x_m, one.y_m + y_m);
    };
    if (bond == TopBond::kFollows) {
      top = contact.follow(overlap);
    } else if (!is_out_of_reach(shape, one, contact.radius_m(), depth_m)) {
      top = contact.press(
          overlap, round_tip(shape, one.x_m, one.y_m, contact.radius_m(), depth_m + one.above_m),
          last != nullptr ? &(*last)[array.tops.size()] : nullptr);
    }
    array.add(top);
  }
  return array;
}

void PressedArray::add(const TopPressure& top) {
  force_N += top.force_N;
  contacts += top.share > 0.0 ? 1 : 0;
  has_partial = has_partial || top.is_partial;
  tops.push_back(top);
}

void narrow_depths(DepthBracket at, double found_N, double enough_N,
                   const std::function<double(double)>& excess_N_at) {
  constexpr int kMostSteps = 100;
  int side = 0;  // of the last point: 1 above, -1 below
  for (int step = 0; step < kMostSteps && std::abs(found_N) > enough_N; ++step) {
    const double middle_m =
        (at.low_m * at.above_N - at.high_m * at.below_N) / (at.above_N - at.below_N);
    if (!(middle_m > at.low_m && middle_m < at.high_m)) break;  // rounding
    found_N = excess_N_at(middle_m);
    const int now = found_N > 0.0 ? 1 : -1;
    (now == 1 ? at.high_m : at.low_m) = middle_m;
    (now == 1 ? at.above_N : at.below_N) = found_N;
    if (now == side) (now == 1 ? at.below_N : at.above_N) *= 0.5;
    side = now;
  }
}

void depth_of_force(const std::function<double(double)>& force_N_at, const DepthSearch& search) {
  constexpr int kMostDoublings = 200;
  const auto excess_N_at = [&](double depth_m) { return force_N_at(depth_m) - search.force_N; };
  DepthBracket at{search.low_m, search.guess_m};
  at.below_N = excess_N_at(at.low_m);
  at.above_N = excess_N_at(at.high_m);
  double step_m = at.high_m - at.low_m;
  for (int step = 0; step < kMostDoublings && at.above_N < 0.0; ++step) {
    at.low_m = at.high_m;
    at.below_N = at.above_N;
    step_m *= 2.0;
    at.high_m += step_m;
    at.above_N = excess_N_at(at.high_m);
  }
  narrow_depths(at, at.above_N, search.accuracy * search.force_N, excess_N_at);
}

PressedArray press_with_force(const std::vector<TouchedPillar>& pillars,
                              const std::vector<TopContact>& classes, const RigidShape& shape,
                              double force_N, TopBond bond, std::optional<double> near_m) {
  constexpr double kOfForce = 1e-12;
  constexpr double kAround = 0.01;  // of the way from the first touch
  require(force_N > 0.0, "the force on a shape must be positive");
  const double low_m = first_touch_m(pillars, classes, shape);
  require(std::isfinite(low_m), "there is no pillar under the shape");
  // One pillar alone would bear the force at this depth.
  double step_m = 0.0;
  for (const TopContact& one : classes) {
    step_m = std::max(step_m, force_N * one.compliance().sinking_m_N());
  }
  PressedArray array;
  std::vector<Eigen::MatrixXd> last;
  const auto force_at = [&](double depth_m) {
    array = press_to_depth(pillars, classes, shape, depth_m, bond, &last);
    return array.force_N;
  };
  DepthSearch search{
      .low_m = low_m, .guess_m = low_m + step_m, .force_N = force_N, .accuracy = kOfForce};
  if (near_m && *near_m > low_m) {
    const double around_m = kAround * (*near_m - low_m);
    const bool is_below = force_at(*near_m - around_m) < force_N;
    search.guess_m = *near_m + (is_below ? around_m : -around_m);
    if (is_below) search.low_m = *near_m - around_m;
  }
  depth_of_force(force_at, search);
  return array;
}

}  // namespace viscard
