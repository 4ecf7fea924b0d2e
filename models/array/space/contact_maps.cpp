#include "models/array/space/contact_maps.h"

#include "models/array/space/space_maps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace viscard {
namespace {

constexpr int kPressureColumn = static_cast<int>(TopLoad::kPressure);

// Maps of the tops, by pillar. Errors are relative to these sizes: the largest force, and that
// force at half a radius, where a top begins to lift.
struct TopMap {
  const char* name;
  const char* unit;
  double (*value)(const TopPressure&);
  double (*error)(const SpaceContact&, std::size_t pillar, double R_m);
};

template <TopLoad kLoad>
double moment_change(const SpaceContact& contact, std::size_t pillar, double R_m) {
  return std::abs(contact.change_Pa(static_cast<Eigen::Index>(pillar), static_cast<int>(kLoad))) *
         0.25 * std::numbers::pi * R_m * R_m * R_m;
}

template <TopLoad kLoad>
double shear_change(const SpaceContact& contact, std::size_t pillar, double R_m) {
  const auto row = static_cast<Eigen::Index>(pillar);
  const auto load = static_cast<int>(kLoad);
  return (std::abs(contact.change_Pa(row, load)) +
          contact.stiffness_error * std::abs(contact.loads_Pa(row, load))) *
         std::numbers::pi * R_m * R_m;
}

// Those of tops that stick are the last two.
std::vector<TopMap> top_maps(const SpaceScene& scene) {
  static const std::vector<TopMap> kMaps = {
      {"pillar_force", "N", [](const TopPressure& top) { return top.force_N; },
       [](const SpaceContact& c, std::size_t i, double) {
         return c.force_change_N[i] + c.stiffness_error * std::abs(c.pressed.tops[i].force_N);
       }},
      {"contact_share_percent", "%", [](const TopPressure& top) { return 100.0 * top.share; },
       [](const SpaceContact& c, std::size_t i, double) { return 100.0 * c.share_change[i]; }},
      {"moment_x", "N m", [](const TopPressure& top) { return top.moment_x_Nm; },
       moment_change<TopLoad::kTiltX>},
      {"moment_y", "N m", [](const TopPressure& top) { return top.moment_y_Nm; },
       moment_change<TopLoad::kTiltY>},
      {"shear_force_x", "N", [](const TopPressure& top) { return top.shear_x_N; },
       shear_change<TopLoad::kShearX>},
      {"shear_force_y", "N", [](const TopPressure& top) { return top.shear_y_N; },
       shear_change<TopLoad::kShearY>}};
  std::vector<TopMap> maps = kMaps;
  if (scene.press->friction == Friction::kNone) maps.resize(maps.size() - 2);
  return maps;
}

constexpr const char* kReleaseDepth = "release_depth";

// As a column E A/l.
double stretch_at_release_m(const SpaceScene& scene, double pull_N, std::size_t pillar) {
  const SpaceClass one = class_of(scene, scene.pillars[pillar]);
  return pull_N * one.length_m /
         (0.25 * std::numbers::pi * one.diameter_m * one.diameter_m * one.material.E0_Pa);
}

double largest_pressure_Pa(const SpaceContact& contact) {
  return std::max(contact.loads_Pa.col(kPressureColumn).maxCoeff(), 0.0);
}

// Where tops that are or were held let go.
void add_release(const SpaceScene& scene, const SpaceContact& contact, SceneAnswer& answer) {
  SceneMap map{.name = kReleaseDepth, .unit = "m", .is_watched = false};
  for (std::size_t i = 0; i < contact.release_m.size(); ++i) {
    if (std::isnan(contact.release_m[i])) continue;
    map.pillar.push_back(i);
    map.value.push_back(contact.release_m[i]);
    // The stretch at which it lets go is wrong as the stiffness is.
    map.error.push_back(contact.stiffness_error *
                        stretch_at_release_m(scene, contact.pull_off_N[i], i));
  }
  if (!map.value.empty()) answer.maps.push_back(std::move(map));
}

}  // namespace

std::vector<std::string> contact_maps(const SpaceScene& scene) {
  std::vector<std::string> names;
  for (const TopMap& map : top_maps(scene)) names.emplace_back(map.name);
  return names;
}

std::vector<std::string> contact_results() {
  return {"contact_force",  "contacts",  "depth",      "largest_pressure",
          kPressureProfile, kGapProfile, kReleaseDepth};
}

double contact_error(const SpaceContact& contact) {
  const double largest_Pa = contact.loads_Pa.cwiseAbs().maxCoeff();
  if (!(largest_Pa > 0.0)) return 0.0;
  return contact.change_Pa.cwiseAbs().maxCoeff() / largest_Pa + contact.stiffness_error;
}

void add_contact(const SpaceScene& scene, const SpaceContact& contact, SceneAnswer& answer) {
  const double largest_N = largest_pressure_Pa(contact) > 0.0 ? contact.largest_force_N() : 0.0;
  for (const TopMap& one : top_maps(scene)) {
    if (!asks_for_map(scene, one.name)) continue;
    SceneMap map{.name = one.name, .unit = one.unit};
    for (std::size_t i = 0; i < scene.pillars.size(); ++i) {
      const double R_m = 0.5 * class_of(scene, scene.pillars[i]).diameter_m;
      map.pillar.push_back(i);
      map.value.push_back(one.value(contact.pressed.tops[i]));
      map.error.push_back(one.error(contact, i, R_m));
    }
    if (map.unit == "N m") map.scale = 0.25 * scene.diameter_m * largest_N;
    if (map.name.starts_with("shear_")) map.scale = 0.25 * largest_N;  // as for a row
    map.is_watched = map.unit != "%";
    answer.maps.push_back(std::move(map));
  }
  if (asks_for_map(scene, kReleaseDepth)) add_release(scene, contact, answer);
  if (scene.columns > 1 && !scene.wanted.empty()) add_profiles(scene, contact, answer);
  const auto add = [&](const char* name, double value, const char* unit, double error,
                       double scale = 0.0) {
    if (asks_for(scene, name)) answer.results.push_back({name, value, unit, error, scale});
  };
  const bool is_force_given = scene.press->force_N > 0.0;
  const double of_force = is_force_given ? 0.0 : contact.stiffness_error;
  add("contact_force", contact.pressed.force_N, "N",
      contact.total_change_N + of_force * std::abs(contact.pressed.force_N),
      contact.largest_force_N());
  if (asks_for(scene, "contacts")) {
    answer.results.push_back({"contacts", static_cast<double>(contact.pressed.contacts), "",
                              static_cast<double>(contact.contact_change), 0.0, false});
  }
  const double of_depth = is_force_given ? contact.stiffness_error : 0.0;
  add("depth", contact.pressed.depth_m, "m",
      contact.depth_change_m + of_depth * std::abs(contact.pressed.depth_m));
  add("largest_pressure", largest_pressure_Pa(contact), "Pa",
      contact.change_Pa.col(kPressureColumn).cwiseAbs().maxCoeff() +
          contact.stiffness_error * largest_pressure_Pa(contact),
      contact.loads_Pa.col(kPressureColumn).cwiseAbs().maxCoeff());
}

}  // namespace viscard
