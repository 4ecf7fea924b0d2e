#include "models/array/contact/pull_off.h"

#include "models/maths/require.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace viscard {
namespace {

Overlap overlap_at(const RigidShape& shape, const TouchedPillar& one, double depth_m) {
  return [&shape, one, depth_m](double x_m, double y_m) {
    return depth_m + one.above_m - height_m(shape, one.x_m + x_m, one.y_m + y_m);
  };
}

}  // namespace

bool is_held_after(const TopHold& hold, const std::vector<double>& path_m) {
  bool is_held = false;
  for (const double depth_m : path_m) {
    if (depth_m < hold.released_m) {
      is_held = false;
    } else if (depth_m > hold.touched_m) {
      is_held = true;
    }
  }
  return is_held;
}

bool is_ever_held(const TopHold& hold, const std::vector<double>& path_m) {
  const double deepest_m = *std::max_element(path_m.begin(), path_m.end());
  return deepest_m > hold.touched_m && deepest_m >= hold.released_m;
}

double strip_pull_off_N_m(double width_m, double plane_modulus_Pa, double work_J_m2) {
  require_positive("width of a strip", width_m, "m");
  require_positive("modulus of a strip", plane_modulus_Pa, "Pa");
  require_not_negative("work of adhesion", work_J_m2, "J/m2");
  return std::sqrt(std::numbers::pi * plane_modulus_Pa * work_J_m2 * width_m);
}

std::vector<TopHold> holds_of(const std::vector<TouchedPillar>& pillars,
                              const std::vector<TopContact>& classes, const RigidShape& shape,
                              const std::vector<double>& pull_off_N) {
  std::vector<TopHold> holds;
  holds.reserve(pillars.size());
  for (const TouchedPillar& one : pillars) {
    const auto of_class = static_cast<std::size_t>(one.of_class);
    const TopContact& contact = classes[of_class];
    const FirstTouch first = first_touch_of(shape, one, contact.compliance());
    TopHold hold{.touched_m = first.depth_m};
    if (first.covers) {
      // The force of a top that follows grows by 1/sinking per depth.
      const double at_0_N = contact.follow(overlap_at(shape, one, 0.0)).force_N;
      hold.released_m = -(pull_off_N[of_class] + at_0_N) * contact.compliance().sinking_m_N();
    }
    holds.push_back(hold);
  }
  return holds;
}

PressedArray press_along(const std::vector<TouchedPillar>& pillars,
                         const std::vector<TopContact>& classes, const RigidShape& shape,
                         const std::vector<TopHold>& holds, const std::vector<double>& path_m) {
  PressedArray array;
  array.depth_m = path_m.back();
  array.tops.reserve(pillars.size());
  for (std::size_t i = 0; i < pillars.size(); ++i) {
    const TopContact& contact = classes[static_cast<std::size_t>(pillars[i].of_class)];
    const Overlap overlap = overlap_at(shape, pillars[i], array.depth_m);
    TopPressure top;
    if (is_held_after(holds[i], path_m)) {
      top = contact.follow(overlap);
    } else if (array.depth_m > holds[i].touched_m) {
      top =
          contact.press(overlap, round_tip(shape, pillars[i].x_m, pillars[i].y_m,
                                           contact.radius_m(), array.depth_m + pillars[i].above_m));
    }
    array.add(top);
  }
  return array;
}

}  // namespace viscard
