#include "models/array/plane/pressed_row.h"
#include "models/maths/text_of_number.h"
#include "models/pillar/analyses/buckling_limit.h"
#include "models/pillar/mesh/scene_mistake.h"

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

bool is_in_section(const RigidShape& shape) {
  return shape.y_m == 0.0 && shape.tilt_y == 0.0 && shape.direction_rad == 0.0;
}

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
  if (!is_in_section(scene.press->shape)) {
    throw SceneMistake("shape",
                       "lies in the section of x and z: at and tilt along y must be 0, and there "
                       "is no direction");
  }
}

// Upright pillars buckle at the first of these under a free top, and at multiples of it under others.
struct RowEnd {
  const char* words;
  double times;
};

void note_row_buckling(const ArrayScene& scene, const RowContact& contact,
                       std::vector<std::string>& notes) {
  const double width_m = scene.geometry.diameter_m;
  std::size_t worst = 0;
  for (std::size_t i = 0; i < contact.tops.size(); ++i) {
    if (contact.tops[i].force_N_m > contact.tops[worst].force_N_m) worst = i;
  }
  const double pressure_Pa = contact.tops[worst].force_N_m / width_m;
  const double free_Pa = engesser_pressure_Pa(single_pillar(scene));
  // Half waves of twice the length, the length, and half of it: Timoshenko & Gere, Theory of Elastic
  // Stability (1961), 2.1.
  const bool sticks = scene.press->friction == Friction::kStick;
  const RowEnd end = sticks ? RowEnd{"under a shape that it sticks to", 16.0}
                            : RowEnd{"under a plate that slides", 4.0};
  if (pressure_Pa <= (sticks ? end.times : 1.0) * free_Pa) return;
  const bool is_beyond = pressure_Pa > end.times * free_Pa;
  notes.push_back("beyond buckling: pillar " + std::to_string(worst + 1) + " bears " +
                  text_of(pressure_Pa, 4) + " Pa; with a free top it buckles at " +
                  text_of(free_Pa, 4) + " Pa, " + end.words + " at about " +
                  text_of(end.times * free_Pa, 3) +
                  (is_beyond && !sticks ? " Pa, which is exceeded too" : " Pa") +
                  ". The answer is that of pillars that stay straight");
}

void note_row_strain(const ArrayScene& scene, const RowContact& contact,
                     std::vector<std::string>& notes) {
  constexpr double kLargest = 0.05;
  for (std::size_t i = 0; i < contact.tops.size(); ++i) {
    const double strain =
        contact.tops[i].force_N_m / scene.geometry.diameter_m / scene.pillar.E0_Pa;
    if (!(std::abs(strain) > kLargest) ||
        std::abs(contact.tops[i].force_N_m) < contact.largest_force_N_m()) {
      continue;
    }
    notes.push_back("large strain: pillar " + std::to_string(i + 1) +
                    (strain > 0.0 ? " shortens by " : " is stretched by ") +
                    text_of(100.0 * std::abs(strain), 3) +
                    " %; the answer is that of small strains");
    return;
  }
}

void note_row_slope(const ArrayScene& scene, const RowContact& contact,
                    std::vector<std::string>& notes) {
  constexpr double kLargest = 0.2;
  const double half_m = 0.5 * scene.geometry.diameter_m;
  double steepest = 0.0;
  std::size_t at = 0;
  for (std::size_t i = 0; i < contact.tops.size(); ++i) {
    if (contact.tops[i].share == 0.0) continue;
    const double slope = largest_slope(scene.press->shape,
                                       place_m(scene.geometry, static_cast<int>(i)), 0.0, half_m);
    if (!std::isfinite(slope) || slope <= steepest) continue;
    steepest = slope;
    at = i;
  }
  if (steepest <= kLargest) return;
  notes.push_back("steep shape: its surface rises by " + text_of(steepest, 2) + " over pillar " +
                  std::to_string(at + 1) +
                  "; tops are taken to be nearly level, and their sides do not touch");
}

void note_row_sideways(const ArrayScene& scene, const RowContact& contact,
                       std::vector<std::string>& notes) {
  const double gap_m = scene.geometry.spacing_m;
  Eigen::Index at = 0;
  const double largest_m = contact.sideways_m.cwiseAbs().maxCoeff(&at);
  if (scene.geometry.count < 2 || !(largest_m > 0.5 * gap_m)) return;
  notes.push_back("neighbours meet: the top of pillar " + std::to_string(at + 1) + " moves " +
                  micrometres(largest_m, 3) + " sideways, more than half of the gap of " +
                  micrometres(gap_m, 4) + "; contact of their sides is not followed");
}

// Without adhesion, beside two surfaces of the pillars' own.
void note_row_pull(const ArrayScene& scene, const RowContact& contact,
                   std::vector<std::string>& notes) {
  const double work_J_m2 = scene.press->work_of_adhesion_J_m2 > 0.0
                               ? scene.press->work_of_adhesion_J_m2
                               : 2.0 * scene.surface_energy_J_m2;
  const double limit_N_m = row_pull_off_N_m(scene, work_J_m2);
  std::size_t worst = 0;
  for (std::size_t i = 0; i < contact.tops.size(); ++i) {
    if (contact.tops[i].force_N_m < contact.tops[worst].force_N_m) worst = i;
  }
  const double pull_N_m = -contact.tops[worst].force_N_m;
  if (pull_N_m <= limit_N_m) return;
  notes.push_back("beyond pull-off: pillar " + std::to_string(worst + 1) + " is pulled by " +
                  text_of(pull_N_m, 4) + " N/m, and at a work of adhesion of " +
                  text_of(work_J_m2, 3) + " J/m2 its top lets go at " + text_of(limit_N_m, 4) +
                  " N/m");
}

void note_row_held(const ArrayScene& scene, const RowContact& contact,
                   std::vector<std::string>& notes) {
  if (scene.press->work_of_adhesion_J_m2 == 0.0) return;
  int pulled = 0, let_go = 0;
  for (const StripPressure& top : contact.tops) {
    if (std::isnan(top.release_m)) continue;
    const bool is_gone = contact.depth_m < top.release_m;
    let_go += is_gone ? 1 : 0;
    pulled += !is_gone && top.force_N_m < 0.0 ? 1 : 0;
  }
  notes.push_back("adhesion pulls " + std::to_string(pulled) + " tops, and " +
                  std::to_string(let_go) + " have let go; tops that touch are taken to lie flat");
}

}  // namespace

void check_row_press(const ArrayScene& scene) {
  check_row_place(scene);
  const ShapePress& press = *scene.press;
  at_key("shape", [&] { validate(press.shape); });
  check_adhesion(press);
  if ((press.depth_m > 0.0 || !press.before_m.empty()) == (press.force_N > 0.0)) {
    throw SceneMistake("shape",
                       "needs either a depth, such as depth = \"3 um\", or a force per metre "
                       "across the row, such as force = \"5 N\"");
  }
  const double length_m = scene.geometry.length_m;
  const std::vector<double> path_m = path_of(press);
  if (*std::max_element(path_m.begin(), path_m.end()) > length_m) {
    throw SceneMistake("shape.depth",
                       "is more than the pillars' length of " + micrometres(length_m));
  }
  const RowFoundation pressed = row_foundation(scene);
  if (press.force_N > 0.0 && !pressed.touches) {
    throw SceneMistake("shape", "there is no pillar under the shape; move it with shape.at");
  }
  if (pressed.shortening >= 1.0) {
    throw SceneMistake(press.force_N > 0.0 ? "shape.force" : "shape.depth",
                       "would press the pillars flat; they are " + micrometres(length_m) + " long");
  }
  if (!scene.feels_contact && !pressed.covers_all) {
    throw SceneMistake(
        "effects.contact",
        "cannot be off: the shape does not cover all tops, which could not follow it");
  }
}

std::vector<std::string> row_contact_notes(const ArrayScene& scene, const RowContact& contact) {
  std::vector<std::string> notes;
  if (contact.contacts == 0) {
    note_row_held(scene, contact, notes);
    notes.emplace_back("the shape touches no pillar; lower it, or move it over the row");
    return notes;
  }
  if (scene.press->friction == Friction::kStick) {
    notes.emplace_back(
        "full stick: what touches at the end is held as if it had never slid, in one step; this is "
        "for a depth that only grows");
  }
  note_row_buckling(scene, contact, notes);
  note_row_strain(scene, contact, notes);
  note_row_slope(scene, contact, notes);
  note_row_sideways(scene, contact, notes);
  note_row_pull(scene, contact, notes);
  note_row_held(scene, contact, notes);
  return notes;
}

}  // namespace viscard
