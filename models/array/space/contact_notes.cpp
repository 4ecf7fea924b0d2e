// What a linear answer of tops under a shape does not include.
#include "models/array/contact/press_notes.h"
#include "models/array/space/contact_maps.h"
#include "models/array/space/space_maps.h"
#include "models/pillar/analyses/buckling_limit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace viscard {
namespace {

constexpr int kPressure = static_cast<int>(TopLoad::kPressure);

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

}  // namespace

std::vector<std::string> contact_notes(const SpaceScene& scene, const SpaceContact& contact) {
  std::vector<std::string> notes;
  note_table(scene, notes);
  const ShapePress& press = *scene.press;
  const std::vector<SpaceClass> classes = classes_of(scene);
  const double half_gap_m = 0.5 * smallest_gap_m(scene);
  constexpr double kWorthAMesh = 0.7;  // of the limit by Engesser's formula
  std::size_t worst_class = 0;
  PressState state{.touches = contact.pressed.contacts > 0};
  state.sticks = press.friction == Friction::kStick;
  state.adheres = !contact.release_m.empty();
  // Without a shape that only pushes, the work of adhesion of two of the pillars' surfaces.
  state.work_J_m2 = press.work_of_adhesion_J_m2 > 0.0 ? press.work_of_adhesion_J_m2
                                                      : 2.0 * scene.surface_energy_J_m2;
  struct Limits {
    double free_Pa, held_Pa, pull_off_N;
  };
  std::vector<Limits> limits;
  for (const SpaceClass& one : classes) {
    const PillarScene alone = single_pillar(scene, one);
    limits.push_back({engesser_pressure_Pa(alone, TopEnd::kFree),
                      engesser_pressure_Pa(alone, state.sticks ? TopEnd::kSticks : TopEnd::kSlides),
                      class_pull_off_N(one, state.work_J_m2)});
  }
  for (std::size_t i = 0; i < scene.pillars.size(); ++i) {
    const SpacePillar& pillar = scene.pillars[i];
    const auto of = static_cast<std::size_t>(pillar.of_class);
    const Limits& limit = limits[of];
    const std::string place = name_of({pillar.row, pillar.column});
    const double pressure_Pa = contact.loads_Pa(static_cast<Eigen::Index>(i), kPressure);
    const double share = state.pressure.value / state.pressure.limit;
    state.pressure.consider(place, pressure_Pa, state.sticks ? limit.held_Pa : limit.free_Pa);
    if (state.pressure.value / state.pressure.limit > share) {
      worst_class = of;
    }
    const double strain = pressure_Pa / classes[of].material.E0_Pa;
    state.shortening.consider(place, strain, kLargestStrain);
    state.stretch.consider(place, -strain, kLargestStrain);
    state.sideways.consider(place, contact.sideways_m[i], half_gap_m);
    if (press.friction == Friction::kCoulomb) {
      state.lean.consider(place, contact.sideways_m[i] / classes[of].length_m, kLargestLean);
    }
    state.pull.consider(place, -contact.pressed.tops[i].force_N, limit.pull_off_N);
    if (contact.pressed.tops[i].share > 0.0) {
      const double slope =
          largest_slope(press.shape, pillar.x_m, pillar.y_m, 0.5 * classes[of].diameter_m);
      if (std::isfinite(slope)) state.slope.consider(place, slope, kLargestSlope);
    }
    if (!state.adheres || std::isnan(contact.release_m[i])) continue;
    const bool is_gone = contact.pressed.depth_m < contact.release_m[i];
    state.held += !is_gone && contact.pressed.tops[i].force_N < 0.0 ? 1 : 0;
    state.let_go += is_gone ? 1 : 0;
  }
  if (state.pressure.value > kWorthAMesh * state.pressure.limit) {
    const PillarScene alone = single_pillar(scene, classes[worst_class]);
    state.free_Pa = pillar_buckling_pressure_Pa(alone, TopEnd::kFree);
    state.held_Pa =
        pillar_buckling_pressure_Pa(alone, state.sticks ? TopEnd::kSticks : TopEnd::kSlides);
    state.pressure.limit = state.sticks ? state.held_Pa : state.free_Pa;
  }
  const std::vector<std::string> others = press_notes(state);
  notes.insert(notes.end(), others.begin(), others.end());
  return notes;
}

}  // namespace viscard
