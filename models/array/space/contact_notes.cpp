// What a linear answer of tops under a shape does not include.
#include "models/array/space/contact_maps.h"
#include "models/array/space/space_maps.h"
#include "models/maths/text_of_number.h"
#include "models/pillar/analyses/buckling_limit.h"
#include "models/pillar/mesh/scene_mistake.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace viscard {
namespace {

constexpr int kPressure = static_cast<int>(TopLoad::kPressure);

std::string place_of(const SpacePillar& one) {
  return "[" + std::to_string(one.row) + ", " + std::to_string(one.column) + "]";
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
      [&](std::size_t i) { return contact.loads_Pa(static_cast<Eigen::Index>(i), kPressure); },
      [&](const SpaceClass& one) { return engesser_pressure_Pa(single_pillar(scene, one)); });
  // Half waves of twice the length, the length, and half of it: Timoshenko & Gere, Theory of Elastic
  // Stability (1961), 2.1.
  const bool sticks = scene.press->friction == Friction::kStick;
  const double times = sticks ? 16.0 : 4.0;
  if (worst.value <= (sticks ? times : 1.0) * worst.limit) return;
  const bool is_beyond_plate = !sticks && worst.value > times * worst.limit;
  notes.push_back(
      "beyond buckling: pillar " + place_of(scene.pillars[worst.pillar]) + " bears " +
      text_of(worst.value, 4) + " Pa; with a free top it buckles at " + text_of(worst.limit, 4) +
      " Pa, under a " + (sticks ? "shape that it sticks to" : "plate that slides") + " at about " +
      text_of(times * worst.limit, 3) + (is_beyond_plate ? " Pa, which is exceeded too" : " Pa") +
      ". The answer is that of pillars that stay straight");
}

void note_strain(const SpaceScene& scene, const SpaceContact& contact,
                 std::vector<std::string>& notes) {
  constexpr double kLargest = 0.05;
  const Worst worst = worst_of(
      scene,
      [&](std::size_t i) { return contact.loads_Pa(static_cast<Eigen::Index>(i), kPressure); },
      [&](const SpaceClass& one) { return kLargest * one.material.E0_Pa; });
  if (worst.value <= worst.limit) return;
  notes.push_back("large strain: pillar " + place_of(scene.pillars[worst.pillar]) +
                  " shortens by " + text_of(100.0 * kLargest * worst.value / worst.limit, 3) +
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
                  place_of(scene.pillars[at]) +
                  "; tops are taken to be nearly level, and their sides do not touch");
}

void note_sideways(const SpaceScene& scene, const SpaceContact& contact,
                   std::vector<std::string>& notes) {
  const double gap_m = smallest_gap_m(scene);
  const auto largest = std::max_element(contact.sideways_m.begin(), contact.sideways_m.end());
  if (!(*largest > 0.5 * gap_m)) return;
  const auto at = static_cast<std::size_t>(largest - contact.sideways_m.begin());
  notes.push_back("neighbours meet: the top of pillar " + place_of(scene.pillars[at]) + " moves " +
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
  notes.push_back("beyond pull-off: pillar " + place_of(scene.pillars[worst.pillar]) +
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

}  // namespace

std::vector<std::string> contact_notes(const SpaceScene& scene, const SpaceContact& contact) {
  std::vector<std::string> notes;
  note_table(scene, notes);
  if (contact.pressed.contacts == 0) {
    note_held(contact, notes);
    notes.emplace_back("the shape touches no pillar; lower it, or move it over the array");
    return notes;
  }
  if (scene.press->friction == Friction::kStick) {
    notes.emplace_back(
        "full stick: what touches at the end is held as if it had never slid, in one step; this is "
        "for a depth that only grows");
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
