#include "models/answer/scene_mistake.h"
#include "models/array/contact/press_notes.h"
#include "models/array/plane/pressed_row.h"
#include "models/pillar/analyses/buckling_limit.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

void check_row_place(const ArrayScene& scene) {
  if (scene.drive.index() != RowDrive(RowStatic{}).index()) {
    throw SceneMistake("analysis.kind",
                       "must be static beside a shape, which is answered for rows at rest; arrays "
                       "in the plane (model = \"space\") relax and creep under a shape");
  }
  if (scene.load_Pa != 0.0 || !scene.loaded.empty()) {
    throw SceneMistake("analysis.load", "cannot stand beside a shape, which itself loads the tops");
  }
  if (scene.geometry.ends == FilmEnds::kMirror) {
    throw SceneMistake("geometry.film.ends",
                       "cannot be mirrors under a shape, which they would repeat; say \"free\"");
  }
  check_in_section(scene.press->shape);
}

}  // namespace

void check_row_press(const ArrayScene& scene) {
  check_row_place(scene);
  const ShapePress& press = *scene.press;
  at_key("shape", [&] { validate(press.shape); });
  check_adhesion(press);
  if (press.friction == Friction::kCoulomb) {
    throw SceneMistake("shape.friction",
                       "lets tops slide, which is answered for arrays (kind = \"array\" with rows "
                       "and columns) under a shape that moves; say \"none\" or \"stick\"");
  }
  const double length_m = scene.geometry.length_m;
  check_press_place(press, "a force per metre across the row, such as force = \"5 N\"", length_m);
  const FoundationPress pressed = row_foundation(scene);
  check_press_plan(press, {.length_m = length_m,
                           .touches = std::isfinite(pressed.lowest_m),
                           .shortening = pressed.shortening,
                           .covers_all = pressed.covers_all,
                           .feels_contact = scene.feels_contact});
}

std::vector<std::string> row_contact_notes(const ArrayScene& scene, const RowContact& contact) {
  const PillarScene one = single_pillar(scene);
  const double width_m = scene.geometry.diameter_m;
  const double half_gap_m = scene.geometry.count < 2 ? HUGE_VAL : 0.5 * scene.geometry.spacing_m;
  PressState state{.body = "row", .force_unit = "N/m", .touches = contact.contacts > 0};
  state.sticks = scene.press->friction == Friction::kStick;
  state.free_Pa = engesser_pressure_Pa(one, TopEnd::kFree);
  state.held_Pa = engesser_pressure_Pa(one, state.sticks ? TopEnd::kSticks : TopEnd::kSlides);
  state.adheres = scene.press->work_of_adhesion_J_m2 > 0.0;
  // Without adhesion, beside two surfaces of the pillars' own.
  state.work_J_m2 =
      state.adheres ? scene.press->work_of_adhesion_J_m2 : 2.0 * scene.surface_energy_J_m2;
  const double pull_off_N_m = row_pull_off_N_m(scene, state.work_J_m2);
  for (std::size_t i = 0; i < contact.tops.size(); ++i) {
    const StripPressure& top = contact.tops[i];
    const std::string place = std::to_string(i + 1);
    const double pressure_Pa = top.force_N_m / width_m;
    state.pressure.consider(place, pressure_Pa, state.sticks ? state.held_Pa : state.free_Pa);
    state.shortening.consider(place, pressure_Pa / scene.pillar.E0_Pa, kLargestStrain);
    state.stretch.consider(place, -pressure_Pa / scene.pillar.E0_Pa, kLargestStrain);
    state.sideways.consider(place, std::abs(contact.sideways_m[static_cast<Eigen::Index>(i)]),
                            half_gap_m);
    state.pull.consider(place, -top.force_N_m, pull_off_N_m);
    if (top.share > 0.0) {
      const double slope = largest_slope(
          scene.press->shape, place_m(scene.geometry, static_cast<int>(i)), 0.0, 0.5 * width_m);
      if (std::isfinite(slope)) state.slope.consider(place, slope, kLargestSlope);
    }
    if (std::isnan(top.release_m)) continue;
    const bool is_gone = contact.depth_m < top.release_m;
    state.let_go += is_gone ? 1 : 0;
    state.held += !is_gone && top.force_N_m < 0.0 ? 1 : 0;
  }
  return press_notes(state);
}

}  // namespace viscard
