#include "models/array/space/touch_course.h"

#include "models/array/space/touch_steps.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace viscard {
namespace {

constexpr double kOfForce = 1e-9;  // to which a force is met
constexpr double kNoLoad_Pa = 1e-300;

std::string words_for(const SpacePillar& one) {
  return "[" + std::to_string(one.row) + ", " + std::to_string(one.column) + "]";
}

// Elastic states of a scene's tops on one grid, at depths that do not fall.
class ElasticTops {
 public:
  ElasticTops(const SpaceScene& scene, int grid)
      : at_depth_(contact_at_depths(scene, grid)), reach_m_(first_reach_m(scene)) {}

  SpaceContact at_depth(double depth_m) const { return at_depth_(depth_m); }

  // The state at which elastic tops bear the force, not less deep than `before`: a secant within bounds.
  SpaceContact at_force(double force_N, const SpaceContact* before, double guess_m) const {
    double low_m = before == nullptr ? reach_m_ : before->pressed.depth_m;
    if (force_N == 0.0) return at_depth(reach_m_);
    double low_N = before == nullptr ? 0.0 : before->pressed.force_N;
    if (before != nullptr && low_N >= force_N * (1.0 - kOfForce)) return *before;
    double high_m = 0.0, high_N = 0.0;  // once the force has been exceeded
    double at_m = std::max(guess_m, low_m + 1e-3 * (guess_m - reach_m_));
    SpaceContact state;
    constexpr int kMostSteps = 80;
    for (int step = 0; step < kMostSteps; ++step) {
      state = at_depth(at_m);
      const double found_N = state.pressed.force_N;
      if (std::abs(found_N - force_N) <= kOfForce * force_N) return state;
      (found_N < force_N ? std::tie(low_m, low_N) : std::tie(high_m, high_N)) =
          std::make_pair(at_m, found_N);
      if (high_m == 0.0) {
        at_m = reach_m_ + 2.0 * (at_m - reach_m_);
        continue;
      }
      // Every third step halves, so that neither end stays for ever.
      const double secant_m = low_m + (high_m - low_m) * (force_N - low_N) / (high_N - low_N);
      at_m = step % 3 == 2 ? 0.5 * (low_m + high_m) : secant_m;
      if (!(at_m > low_m && at_m < high_m)) return state;  // rounding
    }
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

  std::function<SpaceContact(double)> at_depth_;
  double reach_m_;
};

struct GridCourse {
  std::vector<double> depth_m, force_N;
  std::vector<int> contacts;
  std::vector<TopLoads> loads_Pa;
  SpaceContact last;  // elastic
};

TopLoads rows_of(const TopLoads& all, const std::vector<std::size_t>& rows) {
  TopLoads some(static_cast<Eigen::Index>(rows.size()), kTopLoads);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    some.row(static_cast<Eigen::Index>(i)) = all.row(static_cast<Eigen::Index>(rows[i]));
  }
  return some;
}

void refuse_shrinking(const SpaceScene& scene, const SpaceContact& before,
                      const SpaceContact& after, double time_s) {
  for (std::size_t i = 0; i < scene.pillars.size(); ++i) {
    const TopPressure& a = before.pressed.tops[i];
    const TopPressure& b = after.pressed.tops[i];
    if (b.share >= a.share - a.share_error - b.share_error - 1e-9) continue;
    throw std::runtime_error(
        "the contact on pillar " + words_for(scene.pillars[i]) + " shrinks from about " +
        text_of(time_s, 4) +
        " s on, although the shape is lowered; pillars that relax are followed while contacts "
        "grow or stay. End the history before, or press with a flatter shape");
  }
}

double area_of(const SpaceScene& scene, std::size_t pillar) {
  const double d_m = class_of(scene, scene.pillars[pillar]).diameter_m;
  return 0.25 * std::numbers::pi * d_m * d_m;
}

GridCourse course_on(const SpaceScene& scene, const ElasticTops& tops,
                     const std::vector<TouchSample>& samples,
                     const std::vector<std::size_t>& touched) {
  GridCourse course;
  std::vector<TopLoads> elastic;
  SpaceContact state;
  const FoundationPress deepest = foundation_press(scene);
  const double largest = largest_value(samples);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const double value = samples[k].elastic;
    if (k == 0 || value != samples[k - 1].elastic) {
      const double guess_m =
          tops.reach_m() + (deepest.depth_m - tops.reach_m()) * std::sqrt(value / largest);
      SpaceContact next = scene.touch->is_creep
                              ? tops.at_force(value, k == 0 ? nullptr : &state, guess_m)
                              : tops.at_depth(value);
      if (k > 0) refuse_shrinking(scene, state, next, samples[k].time_s);
      state = std::move(next);
    }
    course.depth_m.push_back(state.pressed.depth_m);
    course.contacts.push_back(state.pressed.contacts);
    elastic.push_back(rows_of(state.loads_Pa, touched));
  }
  course.loads_Pa = relaxed(scene.pillar.terms, samples, elastic);
  for (const TopLoads& loads : course.loads_Pa) {
    double sum_N = 0.0;
    for (std::size_t i = 0; i < touched.size(); ++i) {
      sum_N += area_of(scene, touched[i]) *
               loads(static_cast<Eigen::Index>(i), static_cast<int>(TopLoad::kPressure));
    }
    course.force_N.push_back(sum_N);
  }
  course.last = std::move(state);
  return course;
}

// The finest grid that the deepest state needs, as contact_within() finds it for a scene at rest.
int grid_for(const SpaceScene& scene, double tolerance) {
  SpaceContact coarse = contact_on(scene, 0);
  for (int grid = 1; grid < kContactGrids - 1; ++grid) {
    SpaceContact fine = contact_on(scene, grid);
    const double change_Pa = (fine.loads_Pa - coarse.loads_Pa).cwiseAbs().maxCoeff();
    if (change_Pa <= tolerance * fine.loads_Pa.cwiseAbs().maxCoeff()) return grid;
    coarse = std::move(fine);
  }
  return kContactGrids - 1;
}

double largest_of(const std::vector<TopLoads>& loads_Pa) {
  double largest_Pa = 0.0;
  for (const TopLoads& one : loads_Pa) {
    if (one.size() > 0) largest_Pa = std::max(largest_Pa, one.cwiseAbs().maxCoeff());
  }
  return largest_Pa;
}

// Adds what the samples of `fine` that `coarse` has too changed; between them what their neighbours did.
void add_step_change(const std::vector<TouchSample>& samples, const GridCourse& coarse,
                     const GridCourse& fine, TouchCourse& course) {
  std::vector<std::size_t> twin;  // in coarse, of the sample itself or of the one after it
  std::size_t next = 0;
  for (const TouchSample& sample : samples) twin.push_back(sample.is_new ? next : next++);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const std::size_t first = samples[k].is_new ? k - 1 : k;
    const std::size_t last = samples[k].is_new ? k + 1 : k;
    TopLoads change = TopLoads::Zero(fine.loads_Pa[k].rows(), kTopLoads);
    double depth_m = 0.0, force_N = 0.0;
    for (const std::size_t at : {first, last}) {
      change = change.cwiseMax((fine.loads_Pa[at] - coarse.loads_Pa[twin[at]]).cwiseAbs());
      depth_m = std::max(depth_m, std::abs(fine.depth_m[at] - coarse.depth_m[twin[at]]));
      force_N = std::max(force_N, std::abs(fine.force_N[at] - coarse.force_N[twin[at]]));
    }
    course.change_Pa.push_back(std::move(change));
    course.depth_change_m.push_back(depth_m);
    course.force_change_N.push_back(force_N);
  }
}

void add_grid_change(const GridCourse& coarse, const GridCourse& fine, TouchCourse& course) {
  for (std::size_t k = 0; k < fine.loads_Pa.size(); ++k) {
    course.change_Pa[k] += (fine.loads_Pa[k] - coarse.loads_Pa[k]).cwiseAbs();
    course.depth_change_m[k] += std::abs(fine.depth_m[k] - coarse.depth_m[k]);
    course.force_change_N[k] += std::abs(fine.force_N[k] - coarse.force_N[k]);
    course.contact_change.push_back(std::abs(fine.contacts[k] - coarse.contacts[k]));
  }
}

// As that of a scene at rest.
void set_end(const SpaceScene& scene, const GridCourse& coarse, TouchCourse& course) {
  const std::size_t pillars = scene.pillars.size();
  SpaceContact& end = course.end = course.deepest;
  end.loads_Pa = all_loads(course, course.loads_Pa.back(), pillars);
  end.change_Pa = all_loads(course, course.change_Pa.back(), pillars);
  for (std::size_t i = 0; i < pillars; ++i) {
    TopPressure& top = end.pressed.tops[i];
    const auto row = static_cast<Eigen::Index>(i);
    const double whole = course.deepest.loads_Pa(row, static_cast<int>(TopLoad::kPressure));
    const double left =
        whole > 0.0 ? end.loads_Pa(row, static_cast<int>(TopLoad::kPressure)) / whole : 1.0;
    const double area_m2 = area_of(scene, i);
    const double R_m = std::sqrt(area_m2 / std::numbers::pi);
    top.force_N = area_m2 * end.loads_Pa(row, static_cast<int>(TopLoad::kPressure));
    top.moment_x_Nm = -0.25 * area_m2 * R_m * end.loads_Pa(row, static_cast<int>(TopLoad::kTiltX));
    top.moment_y_Nm = -0.25 * area_m2 * R_m * end.loads_Pa(row, static_cast<int>(TopLoad::kTiltY));
    top.largest_Pa *= left;
    end.force_change_N[i] = area_m2 * end.change_Pa(row, static_cast<int>(TopLoad::kPressure));
    end.share_change[i] = std::abs(top.share - coarse.last.pressed.tops[i].share) + top.share_error;
  }
  end.pressed.force_N = course.force_N.back();
  end.total_change_N = course.force_change_N.back();
  end.depth_change_m = course.depth_change_m.back();
  end.contact_change = course.contact_change.back();
  end.stiffness_error = course.stiffness_error;
}

// It is the last one, since depths do not fall.
SpaceContact deepest_state(const SpaceScene& scene, const ElasticTops& tops,
                           const std::vector<TouchSample>& samples) {
  const double value = samples.back().elastic;
  if (!scene.touch->is_creep) return tops.at_depth(value);
  return tops.at_force(value, nullptr, foundation_press(scene).depth_m);
}

std::vector<std::size_t> touched_by(const SpaceContact& deepest) {
  std::vector<std::size_t> touched;
  for (std::size_t i = 0; i < deepest.pressed.tops.size(); ++i) {
    if (deepest.pressed.tops[i].share > 0.0) touched.push_back(i);
  }
  return touched;
}

}  // namespace

TouchCourse touch_course(const SpaceScene& scene, double tolerance) {
  constexpr int kFirstSteps = 8, kMostSteps = 64;
  const int grid = grid_for(scene, tolerance);
  const ElasticTops tops(scene, grid);
  TouchCourse course;
  std::vector<TouchSample> samples = touch_samples(scene, kFirstSteps / 2);
  course.touched = touched_by(deepest_state(scene, tops, samples));
  GridCourse fine = course_on(scene, tops, samples, course.touched);
  for (int steps = kFirstSteps; steps <= kMostSteps; steps *= 2) {
    const GridCourse coarse = std::move(fine);
    samples = touch_samples(scene, steps);
    fine = course_on(scene, tops, samples, course.touched);
    course.change_Pa.clear();
    course.depth_change_m.clear();
    course.force_change_N.clear();
    add_step_change(samples, coarse, fine, course);
    const double change =
        largest_of(course.change_Pa) / std::max(largest_of(fine.loads_Pa), kNoLoad_Pa);
    if (std::max(change, change_of_reading(scene, samples, fine.force_N)) <= 0.3 * tolerance) break;
  }
  const GridCourse of_grid =
      course_on(scene, ElasticTops(scene, grid - 1), samples, course.touched);
  add_grid_change(of_grid, fine, course);
  // The film under the feet does not relax with them.
  course.stiffness_error =
      fine.last.stiffness_error + fine.last.settling_share * relaxed_share(scene);
  course.relative_error =
      largest_of(course.change_Pa) / std::max(largest_of(fine.loads_Pa), kNoLoad_Pa) +
      course.stiffness_error;
  for (const TouchSample& sample : samples) {
    course.time_s.push_back(sample.time_s);
    course.is_new.push_back(sample.is_new);
  }
  course.depth_m = std::move(fine.depth_m);
  course.force_N = std::move(fine.force_N);
  course.contacts = std::move(fine.contacts);
  course.loads_Pa = std::move(fine.loads_Pa);
  course.deepest = std::move(fine.last);
  set_end(scene, of_grid, course);
  return course;
}

TopLoads all_loads(const TouchCourse& course, const TopLoads& of_touched, std::size_t pillars) {
  TopLoads all = TopLoads::Zero(static_cast<Eigen::Index>(pillars), kTopLoads);
  for (std::size_t i = 0; i < course.touched.size(); ++i) {
    all.row(static_cast<Eigen::Index>(course.touched[i])) =
        of_touched.row(static_cast<Eigen::Index>(i));
  }
  return all;
}

}  // namespace viscard
