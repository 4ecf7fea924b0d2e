#include "models/array/space/contact_maps.h"

#include "models/array/space/space_maps.h"
#include "models/maths/text_of_number.h"
#include "models/pillar/analyses/buckling_limit.h"
#include "models/pillar/mesh/scene_mistake.h"

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
  double (*error)(const SpaceContact&, std::size_t pillar, double quarter_area_m3);
};

double moment_change(const SpaceContact& contact, std::size_t pillar, TopLoad load,
                     double quarter_area_m3) {
  return std::abs(contact.change_Pa(static_cast<Eigen::Index>(pillar), static_cast<int>(load))) *
         quarter_area_m3;
}

const std::vector<TopMap>& top_maps() {
  static const std::vector<TopMap> kMaps = {
      {"pillar_force", "N", [](const TopPressure& top) { return top.force_N; },
       [](const SpaceContact& c, std::size_t i, double) {
         return c.force_change_N[i] + c.stiffness_error * std::abs(c.pressed.tops[i].force_N);
       }},
      {"contact_share_percent", "%", [](const TopPressure& top) { return 100.0 * top.share; },
       [](const SpaceContact& c, std::size_t i, double) { return 100.0 * c.share_change[i]; }},
      {"moment_x", "N m", [](const TopPressure& top) { return top.moment_x_Nm; },
       [](const SpaceContact& c, std::size_t i, double area) {
         return moment_change(c, i, TopLoad::kTiltX, area);
       }},
      {"moment_y", "N m", [](const TopPressure& top) { return top.moment_y_Nm; },
       [](const SpaceContact& c, std::size_t i, double area) {
         return moment_change(c, i, TopLoad::kTiltY, area);
       }}};
  return kMaps;
}

constexpr const char* kReleaseDepth = "release_depth";

// As a column E A/l.
double stretch_at_release_m(const SpaceScene& scene, double pull_N, std::size_t pillar) {
  const SpaceClass one = class_of(scene, scene.pillars[pillar]);
  return pull_N * one.length_m /
         (0.25 * std::numbers::pi * one.diameter_m * one.diameter_m * one.material.E0_Pa);
}

std::string name_of(const SpacePillar& one) {
  return "[" + std::to_string(one.row) + ", " + std::to_string(one.column) + "]";
}

double largest_pressure_Pa(const SpaceContact& contact) {
  return std::max(contact.loads_Pa.col(kPressureColumn).maxCoeff(), 0.0);
}

// The pillar that uses the largest share of the limit of its class.
struct Worst {
  std::size_t pillar = 0;
  double value = 0.0;
  double limit = 0.0;
};
template <typename Value, typename Limit>
Worst worst_of(const SpaceScene& scene, const Value& value, const Limit& limit_of_class) {
  std::vector<double> limits;
  for (const SpaceClass& one : classes_of(scene)) limits.push_back(limit_of_class(one));
  Worst worst;
  double largest = 0.0;
  for (std::size_t i = 0; i < scene.pillars.size(); ++i) {
    const double limit = limits[static_cast<std::size_t>(scene.pillars[i].of_class)];
    if (value(i) / limit <= largest) continue;
    largest = value(i) / limit;
    worst = {i, value(i), limit};
  }
  return worst;
}

void note_buckling(const SpaceScene& scene, const SpaceContact& contact,
                   std::vector<std::string>& notes) {
  const Worst worst = worst_of(
      scene,
      [&](std::size_t i) {
        return contact.loads_Pa(static_cast<Eigen::Index>(i), kPressureColumn);
      },
      [&](const SpaceClass& one) { return engesser_pressure_Pa(single_pillar(scene, one)); });
  if (worst.value <= worst.limit) return;
  const bool is_beyond_plate = worst.value > 4.0 * worst.limit;
  notes.push_back("beyond buckling: pillar " + name_of(scene.pillars[worst.pillar]) + " bears " +
                  text_of(worst.value, 4) + " Pa; with a free top it buckles at " +
                  text_of(worst.limit, 4) + " Pa, under a plate that slides at about " +
                  text_of(4.0 * worst.limit, 3) +
                  (is_beyond_plate ? " Pa, which is exceeded too" : " Pa") +
                  ". The answer is that of pillars that stay straight");
}

void note_strain(const SpaceScene& scene, const SpaceContact& contact,
                 std::vector<std::string>& notes) {
  constexpr double kLargest = 0.05;
  const Worst worst = worst_of(
      scene,
      [&](std::size_t i) {
        return contact.loads_Pa(static_cast<Eigen::Index>(i), kPressureColumn);
      },
      [&](const SpaceClass& one) { return kLargest * one.material.E0_Pa; });
  if (worst.value <= worst.limit) return;
  notes.push_back("large strain: pillar " + name_of(scene.pillars[worst.pillar]) + " shortens by " +
                  text_of(100.0 * kLargest * worst.value / worst.limit, 3) +
                  " %; the answer is that of small strains");
}

void note_slope(const SpaceScene& scene, const SpaceContact& contact,
                std::vector<std::string>& notes) {
  constexpr double kLargest = 0.2;
  double steepest = 0.0;
  std::size_t at = 0;
  for (std::size_t i = 0; i < scene.pillars.size(); ++i) {
    if (contact.pressed.tops[i].share == 0.0) continue;
    const SpacePillar& one = scene.pillars[i];
    const double slope =
        largest_slope(scene.press->shape, one.x_m, one.y_m, 0.5 * class_of(scene, one).diameter_m);
    if (std::isfinite(slope) && slope > steepest) {
      steepest = slope;
      at = i;
    }
  }
  if (steepest <= kLargest) return;
  notes.push_back("steep shape: its surface rises by " + text_of(steepest, 2) + " over pillar " +
                  name_of(scene.pillars[at]) +
                  "; tops are taken to be nearly level, and their sides do not touch");
}

void note_sideways(const SpaceScene& scene, const SpaceContact& contact,
                   std::vector<std::string>& notes) {
  const double gap_m = smallest_gap_m(scene);
  const auto largest = std::max_element(contact.sideways_m.begin(), contact.sideways_m.end());
  if (!(*largest > 0.5 * gap_m)) return;
  const auto at = static_cast<std::size_t>(largest - contact.sideways_m.begin());
  notes.push_back("neighbours meet: the top of pillar " + name_of(scene.pillars[at]) + " moves " +
                  micrometres(*largest, 3) + " sideways, more than half of the smallest gap of " +
                  micrometres(gap_m, 4) + "; contact of their sides is not followed");
}

void note_table(const SpaceScene& scene, std::vector<std::string>& notes) {
  if (scene.press->shape.kind != ShapeKind::kTable) return;
  const auto outside =
      std::count_if(scene.pillars.begin(), scene.pillars.end(), [&](const SpacePillar& one) {
        return !std::isfinite(height_m(scene.press->shape, one.x_m, one.y_m));
      });
  if (outside == 0) return;
  notes.push_back(std::to_string(outside) + " of " + std::to_string(scene.pillars.size()) +
                  " pillars lie outside the table of heights, where nothing presses on them");
}

// Without a shape that only pushes, the work of adhesion of two of the pillars' surfaces.
void note_pull(const SpaceScene& scene, const SpaceContact& contact,
               std::vector<std::string>& notes) {
  const double work_J_m2 = scene.press->work_of_adhesion_J_m2 > 0.0
                               ? scene.press->work_of_adhesion_J_m2
                               : 2.0 * scene.surface_energy_J_m2;
  const Worst worst = worst_of(
      scene, [&](std::size_t i) { return -contact.pressed.tops[i].force_N; },
      [&](const SpaceClass& one) { return class_pull_off_N(one, work_J_m2); });
  if (worst.value <= worst.limit) return;
  notes.push_back("beyond pull-off: pillar " + name_of(scene.pillars[worst.pillar]) +
                  " is pulled by " + text_of(worst.value, 4) + " N, and at a work of adhesion of " +
                  text_of(work_J_m2, 3) + " J/m2 its top lets go at " + text_of(worst.limit, 4) +
                  " N");
}

void note_held(const SpaceContact& contact, std::vector<std::string>& notes) {
  if (contact.release_m.empty()) return;
  int held = 0, let_go = 0;
  for (std::size_t i = 0; i < contact.release_m.size(); ++i) {
    if (std::isnan(contact.release_m[i])) continue;
    const bool is_gone = contact.pressed.depth_m < contact.release_m[i];
    let_go += is_gone ? 1 : 0;
    held += !is_gone && contact.pressed.tops[i].force_N < 0.0 ? 1 : 0;
  }
  notes.push_back("adhesion pulls " + std::to_string(held) + " tops, and " +
                  std::to_string(let_go) + " have let go; tops that touch are taken to lie flat");
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

std::vector<std::string> contact_maps() {
  std::vector<std::string> names;
  for (const TopMap& map : top_maps()) names.emplace_back(map.name);
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
  for (const TopMap& one : top_maps()) {
    if (!asks_for_map(scene, one.name)) continue;
    SceneMap map{.name = one.name, .unit = one.unit};
    for (std::size_t i = 0; i < scene.pillars.size(); ++i) {
      const double R_m = 0.5 * class_of(scene, scene.pillars[i]).diameter_m;
      map.pillar.push_back(i);
      map.value.push_back(one.value(contact.pressed.tops[i]));
      map.error.push_back(one.error(contact, i, 0.25 * std::numbers::pi * R_m * R_m * R_m));
    }
    if (map.unit == "N m") map.scale = 0.25 * scene.diameter_m * largest_N;
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

std::vector<std::string> contact_notes(const SpaceScene& scene, const SpaceContact& contact) {
  std::vector<std::string> notes;
  note_table(scene, notes);
  if (contact.pressed.contacts == 0) {
    note_held(contact, notes);
    notes.emplace_back("the shape touches no pillar; lower it, or move it over the array");
    return notes;
  }
  note_buckling(scene, contact, notes);
  note_strain(scene, contact, notes);
  note_slope(scene, contact, notes);
  note_sideways(scene, contact, notes);
  note_pull(scene, contact, notes);
  note_held(contact, notes);
  return notes;
}

}  // namespace viscard
