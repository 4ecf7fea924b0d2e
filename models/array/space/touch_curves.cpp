#include "models/array/space/touch_curves.h"

#include "models/array/space/space_maps.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
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

// One quantity of a touched top at a time, and its change; `row` among those that are touched.
struct TopCurve {
  const char* name;
  const char* unit;
  double (*value)(const TouchCourse&, std::size_t at, Eigen::Index row, double area_m2);
  double (*change)(const TouchCourse&, std::size_t at, Eigen::Index row, double area_m2);
  bool turns = true;  // from one step to the next, where a top begins to slide or to touch
};

// What half as many steps miss where they have no sample: there a curve is a straight line to them.
void add_missed_turns(const TouchCourse& course, const std::vector<double>& values,
                      std::vector<double>& changes) {
  for (std::size_t k = 1; k + 1 < values.size(); ++k) {
    if (!course.is_new[k]) continue;
    const double part =
        (course.time_s[k] - course.time_s[k - 1]) / (course.time_s[k + 1] - course.time_s[k - 1]);
    changes[k] += std::abs(values[k] - values[k - 1] - part * (values[k + 1] - values[k - 1]));
  }
}

template <TopLoad kLoad>
TopCurve load_curve(const char* name, bool turns = true) {
  return {name, "N",
          [](const TouchCourse& course, std::size_t at, Eigen::Index row, double area_m2) {
            return area_m2 * course.loads_Pa[at](row, static_cast<int>(kLoad));
          },
          [](const TouchCourse& course, std::size_t at, Eigen::Index row, double area_m2) {
            return area_m2 * course.change_Pa[at](row, static_cast<int>(kLoad));
          },
          turns};
}

std::vector<TopCurve> top_curves(const TouchCourse& course) {
  std::vector<TopCurve> curves = {load_curve<TopLoad::kPressure>("pillar_force", false)};
  if (course.slip_m.empty()) return curves;
  curves.push_back(load_curve<TopLoad::kShearX>("shear_force_x"));
  curves.push_back(load_curve<TopLoad::kShearY>("shear_force_y"));
  curves.push_back({"slip", "m",
                    [](const TouchCourse& one, std::size_t at, Eigen::Index row, double) {
                      return one.slip_m[at][row];
                    },
                    [](const TouchCourse& one, std::size_t at, Eigen::Index row, double) {
                      return one.slip_change_m[at][row];
                    }});
  return curves;
}

// Where the pillar is among those that are touched, or -1.
Eigen::Index row_of(const TouchCourse& course, std::size_t pillar) {
  const auto found = std::lower_bound(course.touched.begin(), course.touched.end(), pillar);
  const bool is_touched = found != course.touched.end() && *found == pillar;
  return is_touched ? static_cast<Eigen::Index>(found - course.touched.begin()) : -1;
}

void add_top_curve(const SpaceScene& scene, const TouchCourse& course, const TopCurve& one,
                   SceneAnswer& answer) {
  for (const std::size_t pillar : followed_pillars(scene, course)) {
    const Eigen::Index row = row_of(course, pillar);
    const double area_m2 = area_of(scene, pillar);
    std::vector<double> values, changes;
    for (std::size_t k = 0; k < course.time_s.size(); ++k) {
      values.push_back(row >= 0 ? one.value(course, k, row, area_m2) : 0.0);
      changes.push_back(row >= 0 ? std::abs(one.change(course, k, row, area_m2)) : 0.0);
    }
    changes = plus_share(std::move(changes), course.stiffness_error, values);
    if (one.turns) add_missed_turns(course, values, changes);
    answer.curves.push_back(shape_curve(course, one.name + place_ending(scene.pillars[pillar]),
                                        one.unit, std::move(values), std::move(changes)));
  }
}

// How many tops slide and stick, and the largest slip.
void add_slip_curves(const SpaceScene& scene, const TouchCourse& course, SceneAnswer& answer) {
  std::vector<double> sticking, slip_m, change, slip_change_m;
  for (std::size_t k = 0; k < course.slip_m.size(); ++k) {
    sticking.push_back(course.contacts[k] - course.sliding[k]);
    change.push_back(course.contact_change[k] + course.sliding_change[k]);
    const bool any = course.slip_m[k].size() > 0;
    slip_m.push_back(any ? course.slip_m[k].maxCoeff() : 0.0);
    slip_change_m.push_back(any ? course.slip_change_m[k].maxCoeff() : 0.0);
  }
  if (slip_m.empty()) return;
  if (asks_for(scene, "sliding_tops")) {
    answer.curves.push_back(
        shape_curve(course, "sliding_tops", "1", {course.sliding.begin(), course.sliding.end()},
                    {course.sliding_change.begin(), course.sliding_change.end()}));
  }
  if (asks_for(scene, "sticking_tops")) {
    answer.curves.push_back(
        shape_curve(course, "sticking_tops", "1", std::move(sticking), std::move(change)));
  }
  if (!asks_for(scene, "largest_slip")) return;
  slip_change_m = plus_share(std::move(slip_change_m), course.stiffness_error, slip_m);
  answer.results.push_back({"largest_slip", slip_m.back(), "m", slip_change_m.back(), 0.0, false});
  answer.curves.push_back(
      shape_curve(course, "largest_slip", "m", std::move(slip_m), std::move(slip_change_m)));
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
  for (const TopCurve& one : top_curves(course)) {
    if (asks_for_map(scene, one.name)) add_top_curve(scene, course, one, answer);
  }
  add_slip_curves(scene, course, answer);
}

}  // namespace

std::vector<std::string> touch_results(const SpaceScene& scene) {
  std::vector<std::string> names;
  if (scene.touch && scene.touch->readout) names.emplace_back(kTouchReading);
  if (scene.touch && scene.press->friction == Friction::kCoulomb) {
    names.insert(names.end(), {"slip", "largest_slip", "sliding_tops", "sticking_tops"});
  }
  return names;
}

void add_slip(const SpaceScene& scene, const TouchCourse& course, SceneAnswer& answer) {
  if (course.slip_m.empty() || !asks_for_map(scene, "slip")) return;
  SceneMap map{.name = "slip", .unit = "m", .is_watched = false};
  for (std::size_t i = 0; i < scene.pillars.size(); ++i) {
    const Eigen::Index row = row_of(course, i);
    const double slip_m = row >= 0 ? course.slip_m.back()[row] : 0.0;
    const double change_m = row >= 0 ? course.slip_change_m.back()[row] : 0.0;
    map.pillar.push_back(i);
    map.value.push_back(slip_m);
    map.error.push_back(change_m + course.stiffness_error * slip_m);
  }
  answer.maps.push_back(std::move(map));
}

void add_voltage_curves(const SpaceScene& scene, const SpaceResponse& response,
                        const TouchCourse& course, SceneAnswer& answer) {
  std::vector<PillarCurve> curves = curves_of(scene, response, course, course.loads_Pa, false);
  // All pillars of a path are read, also those that it hardly touches.
  std::map<std::string, double> largest_V;
  for (const PillarCurve& one : curves) {
    double& size_V = largest_V[one.map];
    size_V = std::max(size_V, scene.touch->is_path() ? largest_size(one.value) : 0.0);
  }
  for (PillarCurve& one : curves) {
    SceneCurve curve{.name = one.map + place_ending(scene.pillars[one.pillar]),
                     .unit = "V",
                     .x = course.time_s,
                     .value = std::move(one.value)};
    curve.left_out = std::move(one.step_change);
    // If the curves of two meshes cross, their difference is no error estimate.
    curve.span = course.time_s.back();
    curve.allowed.assign(curve.x.size(),
                         std::max(largest_V[one.map], size_in_map(answer, one.map, curve.value)));
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
  std::vector<std::size_t> read;
  for (const PillarCurve& one : changes) {
    if (one.map == kTouchReading && scene.feels_neighbours) read.push_back(one.pillar);
  }
  std::vector<double> influences;
  if (!read.empty()) influences = influence_of_neighbours(scene, read);
  auto influence = influences.begin();
  for (std::size_t c = 0; c < changes.size(); ++c) {
    SceneCurve& curve = answer.curves[c];
    const bool is_reading = changes[c].map == kTouchReading;
    double share = relative + course.stiffness_error;
    if (is_reading && scene.feels_neighbours) {
      share += std::pow(*influence++, 2);
    }
    for (std::size_t k = 0; k < curve.error.size(); ++k) {
      curve.error[k] += share * curve.allowed[k] + std::abs(changes[c].value[k]);
    }
    add_peak_and_end(curve, is_reading, answer);
  }
  add_shape_curves(scene, course, answer);
}

}  // namespace viscard
