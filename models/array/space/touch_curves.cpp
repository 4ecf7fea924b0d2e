#include "models/array/space/touch_curves.h"

#include "models/array/space/space_maps.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace viscard {
namespace {

// Reference value for the tolerance of a voltage: the largest of its map, now and at the end.
double size_in_map(const SceneAnswer& answer, const std::string& name,
                   const std::vector<double>& values) {
  double size = largest_size(values);
  for (const SceneMap& map : answer.maps) {
    if (map.name == name) size = std::max(size, size_of(map));
  }
  return size;
}

void add_peak_and_end(const SceneCurve& curve, bool has_end, SceneAnswer& answer) {
  const auto peak = std::max_element(curve.value.begin(), curve.value.end(),
                                     [](double a, double b) { return std::abs(a) < std::abs(b); });
  const auto at = static_cast<std::size_t>(peak - curve.value.begin());
  const double scale = curve.allowed.empty() ? std::abs(*peak) : curve.allowed.front();
  answer.results.push_back({curve.name + "_peak", *peak, curve.unit, curve.error[at], scale});
  if (!has_end) return;
  answer.results.push_back(
      {curve.name + "_end", curve.value.back(), curve.unit, curve.error.back(), scale});
}

SceneCurve shape_curve(const TouchCourse& course, const std::string& name, const std::string& unit,
                       std::vector<double> values, std::vector<double> error) {
  SceneCurve curve{.name = name, .unit = unit, .x = course.time_s, .value = std::move(values)};
  curve.error = std::move(error);
  return curve;
}

std::vector<double> plus_share(std::vector<double> change, double relative,
                               const std::vector<double>& of) {
  for (std::size_t k = 0; k < change.size(); ++k) change[k] += relative * std::abs(of[k]);
  return change;
}

void add_shape_curves(const SpaceScene& scene, const TouchCourse& course, SceneAnswer& answer) {
  const double of_force = scene.touch->is_creep ? 0.0 : course.stiffness_error;
  const double of_depth = scene.touch->is_creep ? course.stiffness_error : 0.0;
  if (asks_for(scene, "depth")) {
    answer.curves.push_back(
        shape_curve(course, "depth", "m", course.depth_m,
                    plus_share(course.depth_change_m, of_depth, course.depth_m)));
  }
  if (asks_for(scene, "contact_force")) {
    answer.curves.push_back(
        shape_curve(course, "contact_force", "N", course.force_N,
                    plus_share(course.force_change_N, of_force, course.force_N)));
    add_peak_and_end(answer.curves.back(), false, answer);
  }
  if (asks_for(scene, "contacts")) {
    answer.curves.push_back(
        shape_curve(course, "contacts", "1", {course.contacts.begin(), course.contacts.end()},
                    {course.contact_change.begin(), course.contact_change.end()}));
  }
  if (!asks_for_map(scene, "pillar_force")) return;
  for (const std::size_t pillar : followed_pillars(scene, course)) {
    const auto found = std::lower_bound(course.touched.begin(), course.touched.end(), pillar);
    const bool is_touched = found != course.touched.end() && *found == pillar;
    const auto row = static_cast<Eigen::Index>(found - course.touched.begin());
    const double d_m = class_of(scene, scene.pillars[pillar]).diameter_m;
    const double area_m2 = 0.25 * std::numbers::pi * d_m * d_m;
    constexpr int kColumn = static_cast<int>(TopLoad::kPressure);
    std::vector<double> force_N, change_N;
    for (std::size_t k = 0; k < course.time_s.size(); ++k) {
      force_N.push_back(is_touched ? area_m2 * course.loads_Pa[k](row, kColumn) : 0.0);
      change_N.push_back(is_touched ? area_m2 * course.change_Pa[k](row, kColumn) : 0.0);
    }
    change_N = plus_share(std::move(change_N), course.stiffness_error, force_N);
    answer.curves.push_back(shape_curve(course,
                                        "pillar_force" + place_ending(scene.pillars[pillar]), "N",
                                        std::move(force_N), std::move(change_N)));
  }
}

}  // namespace

std::vector<std::string> touch_results(const SpaceScene& scene) {
  if (!scene.touch || !scene.touch->readout) return {};
  return {kTouchReading};
}

void add_voltage_curves(const SpaceScene& scene, const SpaceResponse& response,
                        const TouchCourse& course, SceneAnswer& answer) {
  for (PillarCurve& one : curves_of(scene, response, course, course.loads_Pa, false)) {
    SceneCurve curve{.name = one.map + place_ending(scene.pillars[one.pillar]),
                     .unit = "V",
                     .x = course.time_s,
                     .value = std::move(one.value)};
    curve.left_out = std::move(one.step_change);
    // If the curves of two meshes cross, their difference is no error estimate.
    curve.span = course.time_s.back();
    curve.allowed.assign(curve.x.size(), size_in_map(answer, one.map, curve.value));
    answer.curves.push_back(std::move(curve));
  }
}

void finish_curves(const SpaceScene& scene, const TouchCourse& course, double relative,
                   SceneAnswer& answer) {
  const SpaceArray array = array_of(scene);
  SpaceAccuracy accuracy = without_coupling(space_accuracies(array)[1]);
  if (!scene.feels_neighbours) accuracy.potential.reach_m = 2.0 * array.electrode_radius_m;
  const SpaceResponse response(array, accuracy);
  const std::vector<PillarCurve> changes =
      curves_of(scene, response, course, course.change_Pa, true);
  for (std::size_t c = 0; c < changes.size(); ++c) {
    SceneCurve& curve = answer.curves[c];
    const bool is_reading = changes[c].map == kTouchReading;
    double share = relative + course.stiffness_error;
    if (is_reading && scene.feels_neighbours) {
      share += std::pow(influence_of_neighbours(scene, changes[c].pillar), 2);
    }
    for (std::size_t k = 0; k < curve.error.size(); ++k) {
      curve.error[k] += share * curve.allowed[k] + std::abs(changes[c].value[k]);
    }
    add_peak_and_end(curve, is_reading, answer);
  }
  add_shape_curves(scene, course, answer);
}

}  // namespace viscard
