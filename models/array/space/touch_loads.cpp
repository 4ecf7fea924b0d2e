// The loads of a touch on one grid of the tops, with given steps.
#include "models/array/space/touch_loads.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace viscard {
namespace {

constexpr double kOfForce = 1e-9;  // to which a force is met

// Elastic states of a scene's tops, at depths that do not fall.
class ElasticTops {
 public:
  ElasticTops(const SpaceScene& scene, const SpaceTops& tops)
      : tops_(&tops), reach_m_(first_reach_m(scene)) {}

  SpaceContact at_depth(double depth_m) const { return tops_->at_depth(depth_m); }

  // The state at which elastic tops bear the force, not less deep than `before`.
  SpaceContact at_force(double force_N, const SpaceContact* before, double guess_m) const {
    if (force_N == 0.0) return at_depth(reach_m_);
    if (before != nullptr && before->pressed.force_N >= force_N * (1.0 - kOfForce)) return *before;
    const double low_m = before == nullptr ? reach_m_ : before->pressed.depth_m;
    const double first_m = std::max(guess_m, low_m + 1e-3 * (guess_m - reach_m_));
    SpaceContact state;
    depth_of_force(
        [&](double depth_m) {
          state = at_depth(depth_m);
          return state.pressed.force_N;
        },
        {low_m, first_m, force_N, kOfForce});
    return state;
  }

  double reach_m() const { return reach_m_; }

 private:
  // At most the depth at which the shape reaches the first top.
  static double first_reach_m(const SpaceScene& scene) {
    const std::vector<SpaceClass> classes = classes_of(scene);
    double first_m = HUGE_VAL;
    for (const SpacePillar& one : scene.pillars) {
      const SpaceClass& kind = classes[static_cast<std::size_t>(one.of_class)];
      const double above_m = kind.length_m - scene.length_m;
      first_m = std::min(
          first_m,
          least_height_m(scene.press->shape, one.x_m, one.y_m, 0.5 * kind.diameter_m) - above_m);
    }
    return first_m;
  }

  const SpaceTops* tops_;
  double reach_m_;
};

TopLoads rows_of(const TopLoads& all, const std::vector<std::size_t>& rows) {
  TopLoads some(static_cast<Eigen::Index>(rows.size()), kTopLoads);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    some.row(static_cast<Eigen::Index>(i)) = all.row(static_cast<Eigen::Index>(rows[i]));
  }
  return some;
}

// A top that the shape has turned may be left on one side while the shape is lowered.
bool is_shrinking(const SpaceContact& before, const SpaceContact& after) {
  for (std::size_t i = 0; i < before.pressed.tops.size(); ++i) {
    const TopPressure& a = before.pressed.tops[i];
    const TopPressure& b = after.pressed.tops[i];
    if (b.share < a.share - a.share_error - b.share_error - 1e-9) return true;
  }
  return false;
}

// The force of elastic pillars grows with less than the square of the depth.
double guess_of_depth_m(const SpaceScene& scene, double reach_m, double share_of_force) {
  const FoundationPress deepest = foundation_press(scene);
  return reach_m + (deepest.depth_m - reach_m) * std::sqrt(share_of_force);
}

double sum_N(const SpaceScene& scene, const std::vector<std::size_t>& touched,
             const TopLoads& loads) {
  double sum = 0.0;
  for (std::size_t i = 0; i < touched.size(); ++i) {
    sum += area_of(scene, touched[i]) *
           loads(static_cast<Eigen::Index>(i), static_cast<int>(TopLoad::kPressure));
  }
  return sum;
}

// The last elastic state under its loads as they are then.
SpaceContact relaxed_state(const SpaceScene& scene, const SpaceContact& elastic,
                           const std::vector<std::size_t>& touched, const TopLoads& loads) {
  SpaceContact state = elastic;
  state.pressed.force_N = sum_N(scene, touched, loads);
  state.loads_Pa.setZero();
  for (std::size_t j = 0; j < touched.size(); ++j) {
    const std::size_t i = touched[j];
    TopPressure& top = state.pressed.tops[i];
    const auto load = loads.row(static_cast<Eigen::Index>(j));
    state.loads_Pa.row(static_cast<Eigen::Index>(i)) = load;
    const double area_m2 = area_of(scene, i);
    const double R_m = std::sqrt(area_m2 / std::numbers::pi);
    const double whole_N = top.force_N;
    top.force_N = area_m2 * load[static_cast<int>(TopLoad::kPressure)];
    top.moment_x_Nm = -0.25 * area_m2 * R_m * load[static_cast<int>(TopLoad::kTiltX)];
    top.moment_y_Nm = -0.25 * area_m2 * R_m * load[static_cast<int>(TopLoad::kTiltY)];
    if (whole_N > 0.0) top.largest_Pa *= top.force_N / whole_N;
  }
  return state;
}

}  // namespace

double area_of(const SpaceScene& scene, std::size_t pillar) {
  const double d_m = class_of(scene, scene.pillars[pillar]).diameter_m;
  return 0.25 * std::numbers::pi * d_m * d_m;
}

std::vector<std::size_t> touched_in(const SpaceScene& scene, const SpaceTops& tops,
                                    const std::vector<TouchSample>& samples) {
  const ElasticTops elastic(scene, tops);
  const double value = bound_on_elastic(scene, samples);
  const SpaceContact deepest =
      scene.touch->is_creep
          ? elastic.at_force(value, nullptr, guess_of_depth_m(scene, elastic.reach_m(), 1.0))
          : elastic.at_depth(largest_value(samples));
  std::vector<std::size_t> touched;
  for (std::size_t i = 0; i < deepest.pressed.tops.size(); ++i) {
    if (deepest.pressed.tops[i].share > 0.0) touched.push_back(i);
  }
  return touched;
}

std::optional<GridCourse> growing_course(const SpaceScene& scene, const SpaceTops& tops,
                                         const std::vector<TouchSample>& samples,
                                         const std::vector<std::size_t>& touched) {
  if (!is_growing(samples)) return {};
  const ElasticTops elastic_tops(scene, tops);
  GridCourse course;
  std::vector<TopLoads> elastic;
  SpaceContact state;
  const double largest = largest_value(samples);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double value = samples[k].elastic;
    if (k == 0 || value != samples[k - 1].elastic) {
      const double guess_m = guess_of_depth_m(scene, elastic_tops.reach_m(), value / largest);
      SpaceContact next = scene.touch->is_creep
                              ? elastic_tops.at_force(value, k == 0 ? nullptr : &state, guess_m)
                              : elastic_tops.at_depth(value);
      if (k > 0 && is_shrinking(state, next)) return {};
      state = std::move(next);
    }
    course.depth_m.push_back(state.pressed.depth_m);
    course.contacts.push_back(state.pressed.contacts);
    elastic.push_back(rows_of(state.loads_Pa, touched));
  }
  course.loads_Pa = relaxed(scene.pillar.terms, samples, elastic);
  for (const TopLoads& loads : course.loads_Pa) {
    course.force_N.push_back(sum_N(scene, touched, loads));
  }
  course.shown_at = samples.size() - 1;
  course.shown = relaxed_state(scene, state, touched, course.loads_Pa.back());
  course.largest = std::move(state);
  return course;
}

GridCourse stepped_course(const SpaceScene& scene, const SpaceTops& tops,
                          const std::vector<TouchSample>& samples,
                          const std::vector<std::size_t>& touched) {
  RelaxingTops relaxing = tops.relaxing(touched);
  const double guess_m = foundation_press(scene).depth_m;
  GridCourse course;
  PressedArray shown;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const RelaxationStep step = relaxation_step(
        scene.pillar.terms, k == 0 ? 0.0 : samples[k].time_s - samples[k - 1].time_s);
    PressedArray now = scene.touch->is_creep ? relaxing.with_force(step, samples[k].value, guess_m)
                                             : relaxing.to_depth(step, samples[k].value);
    course.depth_m.push_back(now.depth_m);
    course.force_N.push_back(now.force_N);
    course.contacts.push_back(now.contacts);
    course.loads_Pa.push_back(loads_of_tops(scene, now.tops, touched));
    if (now.force_N >= (1.0 - 1e-6) * shown.force_N) {
      course.shown_at = k;
      shown = std::move(now);
    }
  }
  course.shown = course.largest = tops.contact_of(shown, touched);
  return course;
}

}  // namespace viscard
