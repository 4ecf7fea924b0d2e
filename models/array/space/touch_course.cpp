#include "models/array/space/touch_course.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace viscard {
namespace {

constexpr double kNoLoad_Pa = 1e-300;

// The grid that the deepest state needs, chosen as contact_within() chooses it for a scene at rest.
struct FoundGrid {
  SpaceTops fine, coarse;
};
FoundGrid grid_for(const SpaceScene& scene, double tolerance) {
  // Many places of a path cost more than a finer grid is worth.
  const int grids = scene.touch->is_path() ? kContactGrids - 1 : kContactGrids;
  const SpaceTops first(scene, 0);
  FoundGrid found{first.on_grid(1), first};
  SpaceContact coarse = found.coarse.at_rest();
  for (int grid = 1; grid < grids; ++grid) {
    if (grid > 1) {
      found.coarse = found.fine;
      found.fine = found.fine.on_grid(grid);
    }
    SpaceContact fine = found.fine.at_rest();
    const double change_Pa = (fine.loads_Pa - coarse.loads_Pa).cwiseAbs().maxCoeff();
    if (change_Pa <= tolerance * fine.loads_Pa.cwiseAbs().maxCoeff()) break;
    coarse = std::move(fine);
  }
  return found;
}

double largest_of(const std::vector<TopLoads>& loads_Pa) {
  double largest_Pa = 0.0;
  for (const TopLoads& one : loads_Pa) {
    if (one.size() > 0) largest_Pa = std::max(largest_Pa, one.cwiseAbs().maxCoeff());
  }
  return largest_Pa;
}

// Adds the changes at the samples of `fine` that `coarse` has too; between them the changes at
// their neighbours.
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
    if (!fine.slip_m.empty()) {
      course.slip_change_m.emplace_back(Eigen::VectorXd::Zero(fine.slip_m[k].size()));
      course.sliding_change.push_back(0);
    }
    for (const std::size_t at : {first, last}) {
      if (!fine.slip_m.empty()) {
        Eigen::VectorXd& slip = course.slip_change_m.back();
        slip = slip.cwiseMax((fine.slip_m[at] - coarse.slip_m[twin[at]]).cwiseAbs());
        course.sliding_change.back() = std::max(
            course.sliding_change.back(), std::abs(fine.sliding[at] - coarse.sliding[twin[at]]));
      }
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
    if (fine.slip_m.empty()) continue;
    course.slip_change_m[k] += (fine.slip_m[k] - coarse.slip_m[k]).cwiseAbs();
    course.sliding_change[k] += std::abs(fine.sliding[k] - coarse.sliding[k]);
  }
}

// As that of a scene at rest.
void set_shown(const SpaceScene& scene, const GridCourse& coarse, TouchCourse& course) {
  const std::size_t pillars = scene.pillars.size();
  const std::size_t at = course.shown_at;
  SpaceContact& shown = course.shown;
  shown.change_Pa = all_loads(course, course.change_Pa[at], pillars);
  for (std::size_t i = 0; i < pillars; ++i) {
    const TopPressure& top = shown.pressed.tops[i];
    shown.force_change_N[i] =
        area_of(scene, i) *
        shown.change_Pa(static_cast<Eigen::Index>(i), static_cast<int>(TopLoad::kPressure));
    shown.share_change[i] =
        std::abs(top.share - coarse.shown.pressed.tops[i].share) + top.share_error;
  }
  shown.total_change_N = course.force_change_N[at];
  shown.depth_change_m = course.depth_change_m[at];
  shown.contact_change = course.contact_change[at];
  shown.stiffness_error = course.stiffness_error;
}

// By correspondence as long as no contact shrinks, otherwise step by step.
class Courses {
 public:
  explicit Courses(const SpaceScene& scene) : scene_(&scene), has_shrunk_(scene.touch->is_path()) {}

  GridCourse on(const SpaceTops& tops, const std::vector<TouchSample>& samples,
                const std::vector<std::size_t>& touched, int steps) {
    if (!has_shrunk_) {
      if (auto course = growing_course(*scene_, tops, samples, touched, 2 * steps)) {
        return *std::move(course);
      }
      has_shrunk_ = true;
    }
    return stepped_course(*scene_, tops, samples, touched);
  }
  bool has_shrunk() const { return has_shrunk_; }

 private:
  const SpaceScene* scene_;
  bool has_shrunk_;  // or the shape moves
};

void set_times(const std::vector<TouchSample>& samples, TouchCourse& course) {
  for (const TouchSample& sample : samples) {
    course.time_s.push_back(sample.time_s);
    course.is_new.push_back(sample.is_new);
  }
}

}  // namespace

TouchCourse touch_course(const SpaceScene& scene, double tolerance) {
  constexpr int kFirstSteps = 8, kMostSteps = 64;
  const auto [tops, coarse_tops] = grid_for(scene, tolerance);
  TouchCourse course;
  Courses courses(scene);
  std::vector<TouchSample> samples = touch_samples(scene, kFirstSteps / 2);
  course.touched = touched_in(scene, tops, samples);
  GridCourse fine = courses.on(tops, samples, course.touched, kFirstSteps / 2);
  int last_steps = kFirstSteps;
  for (int steps = kFirstSteps; steps <= kMostSteps; steps *= 2) {
    last_steps = steps;
    const GridCourse coarse = std::move(fine);
    samples = touch_samples(scene, steps);
    fine = courses.on(tops, samples, course.touched, steps);
    course.change_Pa.clear();
    course.depth_change_m.clear();
    course.force_change_N.clear();
    course.slip_change_m.clear();
    course.sliding_change.clear();
    add_step_change(samples, coarse, fine, course);
    const double change =
        largest_of(course.change_Pa) / std::max(largest_of(fine.loads_Pa), kNoLoad_Pa);
    if (std::max(change, change_of_reading(scene, samples, fine.force_N)) <= 0.3 * tolerance) break;
  }
  const GridCourse of_grid = courses.on(coarse_tops, samples, course.touched, last_steps);
  add_grid_change(of_grid, fine, course);
  // The film under the feet does not relax with them.
  course.stiffness_error =
      fine.shown.stiffness_error + fine.shown.settling_share * relaxed_share(scene);
  course.relative_error =
      largest_of(course.change_Pa) / std::max(largest_of(fine.loads_Pa), kNoLoad_Pa) +
      course.stiffness_error;
  set_times(samples, course);
  course.has_shrunk = courses.has_shrunk();
  static_cast<GridCourse&>(course) = std::move(fine);
  set_shown(scene, of_grid, course);
  return course;
}

TopLoads largest_loads(const TouchCourse& course, std::size_t pillars) {
  TopLoads largest = course.loads_Pa.front().cwiseAbs();
  for (const TopLoads& loads : course.loads_Pa) largest = largest.cwiseMax(loads.cwiseAbs());
  return all_loads(course, largest, pillars);
}

TopLoads all_loads(const TouchCourse& course, const TopLoads& of_touched, std::size_t pillars) {
  TopLoads all = TopLoads::Zero(static_cast<Eigen::Index>(pillars), kTopLoads);
  all(course.touched, Eigen::all) = of_touched;
  return all;
}

}  // namespace viscard
