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

// At most the depth at which the shape reaches the first top.
double first_reach_m(const SpaceScene& scene) {
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

// The elastic state under a force, or at a depth.
SpaceContact elastic_state(const SpaceScene& scene, const SpaceTops& tops, double value) {
  if (!scene.touch->is_creep) return tops.at_depth(value);
  const double reach_m = first_reach_m(scene);
  if (value == 0.0) return tops.at_depth(reach_m);
  SpaceContact state;
  depth_of_force(
      [&](double depth_m) {
        state = tops.at_depth(depth_m);
        return state.pressed.force_N;
      },
      {reach_m, std::max(foundation_press(scene).depth_m, reach_m + 1e-9), value, kOfForce});
  return state;
}

// A top that the shape has turned may lose contact on one side while the shape is lowered.
bool is_shrinking(const SpaceContact& before, const SpaceContact& after) {
  for (std::size_t i = 0; i < before.pressed.tops.size(); ++i) {
    const TopPressure& a = before.pressed.tops[i];
    const TopPressure& b = after.pressed.tops[i];
    if (b.share < a.share - a.share_error - b.share_error - 1e-9) return true;
  }
  return false;
}

// Elastic states from the first touch to the deepest one, between which loads are linear in the depth.
class ElasticTable {
 public:
  // Nothing if the contact of any top shrinks on the way.
  static std::optional<ElasticTable> of(const SpaceScene& scene, const SpaceTops& tops,
                                        const std::vector<std::size_t>& touched, double largest,
                                        int parts) {
    ElasticTable table;
    table.is_creep_ = scene.touch->is_creep;
    table.deepest_ = elastic_state(scene, tops, largest);
    const double end_m = table.deepest_.pressed.depth_m;
    const double start_m = std::min(first_reach_m(scene), end_m);
    SpaceContact before = tops.at_depth(start_m);
    table.add(before, touched);
    for (int i = 1; i <= parts && start_m < end_m; ++i) {
      SpaceContact next =
          i == parts ? table.deepest_ : tops.at_depth(start_m + (end_m - start_m) * i / parts);
      if (is_shrinking(before, next)) return {};
      table.add(next, touched);
      before = std::move(next);
    }
    return table;
  }

  // At a depth or force that does not lie beyond the largest one.
  struct State {
    double depth_m = 0.0;
    int contacts = 0;
    TopLoads loads_Pa;
  };
  State at(double value) const {
    const std::vector<double>& of = is_creep_ ? force_N_ : depth_m_;
    if (value <= of.front()) {
      return {is_creep_ ? depth_m_.front() : value, contacts_.front(), loads_Pa_.front()};
    }
    const auto next = std::lower_bound(of.begin(), of.end() - 1, value) - of.begin();
    const auto i = static_cast<std::size_t>(next);
    const double share = std::min((value - of[i - 1]) / (of[i] - of[i - 1]), 1.0);
    return {depth_m_[i - 1] + share * (depth_m_[i] - depth_m_[i - 1]),
            share < 1.0 ? contacts_[i - 1] : contacts_[i],
            loads_Pa_[i - 1] + share * (loads_Pa_[i] - loads_Pa_[i - 1])};
  }
  const SpaceContact& deepest() const { return deepest_; }

 private:
  void add(const SpaceContact& state, const std::vector<std::size_t>& touched) {
    depth_m_.push_back(state.pressed.depth_m);
    force_N_.push_back(state.pressed.force_N);
    contacts_.push_back(state.pressed.contacts);
    loads_Pa_.push_back(state.loads_Pa(touched, Eigen::all));
  }

  bool is_creep_ = false;
  SpaceContact deepest_;
  std::vector<double> depth_m_, force_N_;  // ascending
  std::vector<int> contacts_;
  std::vector<TopLoads> loads_Pa_;
};

double sum_N(const SpaceScene& scene, const std::vector<std::size_t>& touched,
             const TopLoads& loads) {
  double sum = 0.0;
  for (std::size_t i = 0; i < touched.size(); ++i) {
    sum += area_of(scene, touched[i]) *
           loads(static_cast<Eigen::Index>(i), static_cast<int>(TopLoad::kPressure));
  }
  return sum;
}

// The last elastic state under its loads at that time.
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

// The tops that a shape may reach on its path, also between two samples of it; under a force, which may creep to any
// depth, all that it passes over.
std::vector<std::size_t> reached_on_path(const SpaceScene& scene,
                                         const std::vector<TouchSample>& samples) {
  const std::vector<SpaceClass> classes = classes_of(scene);
  RigidShape shape = scene.press->shape;
  std::vector<bool> is_reached(scene.pillars.size(), false);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const TouchSample& now = samples[k];
    const TouchSample& before = samples[k == 0 ? 0 : k - 1];
    shape.x_m = 0.5 * (now.x_m + before.x_m);
    shape.y_m = 0.5 * (now.y_m + before.y_m);
    const double half_m = 0.5 * std::hypot(now.x_m - before.x_m, now.y_m - before.y_m);
    const double depth_m = scene.touch->is_creep ? HUGE_VAL : std::max(now.value, before.value);
    for (std::size_t i = 0; i < scene.pillars.size(); ++i) {
      const SpacePillar& one = scene.pillars[i];
      const SpaceClass& kind = classes[static_cast<std::size_t>(one.of_class)];
      is_reached[i] =
          is_reached[i] || least_height_m(shape, one.x_m, one.y_m, 0.5 * kind.diameter_m + half_m) <
                               depth_m + kind.length_m - scene.length_m;
    }
  }
  std::vector<std::size_t> reached;
  for (std::size_t i = 0; i < is_reached.size(); ++i) {
    if (is_reached[i]) reached.push_back(i);
  }
  return reached;
}

// Tops that a moving shape drags along, with the shears that follow from its way and the forces that press on them.
class DraggedTops {
 public:
  DraggedTops(const SpaceScene& scene, const SpaceTops& tops,
              const std::vector<std::size_t>& touched)
      : scene_(&scene), tops_(tops.dragged(touched)), furthest_m_(tops_.size(), 0.0) {}

  // Adds the shears at the end of a step to the tops of `now`.
  void move(const TouchSample& from, const TouchSample& to, const RelaxingTops& relaxing,
            PressedArray& now) {
    const double dt_s = to.time_s - from.time_s;
    const std::vector<MaterialTerm>& terms = scene_->pillar.terms;
    const Eigen::Vector2d way_m(to.x_m - from.x_m, to.y_m - from.y_m);
    const RelaxationStep whole = relaxation_step(terms, dt_s);
    sliding_ = 0;
    for (std::size_t i = 0; i < tops_.size(); ++i) {
      TopPressure& top = now.tops[i];
      const double part = top.force_N > 0.0 ? relaxing.touched_part(i) : 0.0;
      if (part < 1.0)
        tops_[i].leave(part > 0.0 ? relaxation_step(terms, (1.0 - part) * dt_s) : whole);
      if (part > 0.0) {
        tops_[i].drag(part < 1.0 ? relaxation_step(terms, part * dt_s) : whole, part * way_m,
                      scene_->press->friction_coefficient * top.force_N);
      }
      top.shear_x_N = tops_[i].force_N().x();
      top.shear_y_N = tops_[i].force_N().y();
      furthest_m_[i] = std::max(furthest_m_[i], tops_[i].motion_m().norm());
      sliding_ += tops_[i].slides() ? 1 : 0;
    }
  }

  void add_to(GridCourse& course) const {
    course.sliding.push_back(sliding_);
    course.slip_m.emplace_back(static_cast<Eigen::Index>(tops_.size()));
    for (std::size_t i = 0; i < tops_.size(); ++i) {
      course.slip_m.back()[static_cast<Eigen::Index>(i)] = tops_[i].slip_m();
    }
  }
  // How far each top was from its foot at most.
  double furthest_m(std::size_t i) const { return furthest_m_[i]; }

 private:
  const SpaceScene* scene_;
  std::vector<SlidingTop> tops_;
  std::vector<double> furthest_m_;
  int sliding_ = 0;
};

}  // namespace

double area_of(const SpaceScene& scene, std::size_t pillar) {
  const double d_m = class_of(scene, scene.pillars[pillar]).diameter_m;
  return 0.25 * std::numbers::pi * d_m * d_m;
}

std::vector<std::size_t> touched_in(const SpaceScene& scene, const SpaceTops& tops,
                                    const std::vector<TouchSample>& samples) {
  if (scene.touch->is_path()) return reached_on_path(scene, samples);
  const double largest =
      scene.touch->is_creep ? bound_on_elastic(scene, samples) : largest_value(samples);
  const SpaceContact deepest = elastic_state(scene, tops, largest);
  std::vector<std::size_t> touched;
  for (std::size_t i = 0; i < deepest.pressed.tops.size(); ++i) {
    if (deepest.pressed.tops[i].share > 0.0) touched.push_back(i);
  }
  return touched;
}

std::optional<GridCourse> growing_course(const SpaceScene& scene, const SpaceTops& tops,
                                         const std::vector<TouchSample>& samples,
                                         const std::vector<std::size_t>& touched, int parts) {
  if (!is_growing(samples)) return {};
  const auto table = ElasticTable::of(scene, tops, touched, largest_value(samples), parts);
  if (!table) return {};
  GridCourse course;
  std::vector<TopLoads> elastic;
  for (const TouchSample& sample : samples) {
    ElasticTable::State state = table->at(sample.elastic);
    course.depth_m.push_back(state.depth_m);
    course.contacts.push_back(state.contacts);
    elastic.push_back(std::move(state.loads_Pa));
  }
  course.loads_Pa = relaxed(scene.pillar.terms, samples, elastic);
  for (const TopLoads& loads : course.loads_Pa) {
    course.force_N.push_back(sum_N(scene, touched, loads));
  }
  course.shown_at = samples.size() - 1;
  course.shown = relaxed_state(scene, table->deepest(), touched, course.loads_Pa.back());
  course.largest = table->deepest();
  return course;
}

GridCourse stepped_course(const SpaceScene& scene, const SpaceTops& tops,
                          const std::vector<TouchSample>& samples,
                          const std::vector<std::size_t>& touched) {
  RelaxingTops relaxing = tops.relaxing(touched);
  DraggedTops dragged(scene, tops, touched);
  const double guess_m = foundation_press(scene).depth_m;
  const bool is_path = scene.touch->is_path();
  const bool drags = is_path && scene.press->friction == Friction::kCoulomb;
  GridCourse course;
  PressedArray largest;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const TouchSample& before = samples[k == 0 ? 0 : k - 1];
    const RelaxationStep step =
        relaxation_step(scene.pillar.terms, samples[k].time_s - before.time_s);
    if (is_path) relaxing.move_shape(samples[k].x_m, samples[k].y_m);
    PressedArray now = scene.touch->is_creep ? relaxing.with_force(step, samples[k].value, guess_m)
                                             : relaxing.to_depth(step, samples[k].value);
    if (drags) {
      dragged.move(before, samples[k], relaxing, now);
      dragged.add_to(course);
    }
    course.depth_m.push_back(now.depth_m);
    course.force_N.push_back(now.force_N);
    course.contacts.push_back(now.contacts);
    course.loads_Pa.push_back(loads_of_tops(scene, now.tops, touched));
    const bool is_largest = now.force_N >= (1.0 - 1e-6) * largest.force_N;
    const bool is_end = is_path && k + 1 == samples.size() && now.force_N > 0.5 * largest.force_N;
    if (is_largest || is_end) course.shown_at = k;
    if (is_end) course.shown = tops.contact_of(now, touched);
    if (is_largest) largest = std::move(now);
  }
  course.largest = tops.contact_of(largest, touched);
  if (course.shown.pressed.tops.empty()) course.shown = course.largest;
  for (std::size_t i = 0; drags && i < touched.size(); ++i) {
    double& sideways_m = course.largest.sideways_m[touched[i]];
    sideways_m = std::max(sideways_m, dragged.furthest_m(i));
  }
  return course;
}

}  // namespace viscard
