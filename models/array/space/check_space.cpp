#include "models/answer/scene_mistake.h"
#include "models/array/contact/press_notes.h"
#include "models/array/space/simulate_space.h"
#include "models/array/space/space_contact.h"
#include "models/array/space/space_maps.h"
#include "models/array/space/touch_steps.h"
#include "models/maths/neighbours.h"
#include "models/maths/text_of_number.h"
#include "models/pillar/analyses/buckling_limit.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace viscard {
namespace {

constexpr double kSoftestBacking = 0.1;  // over the softest pillar

void check_loaded_places(const SpaceScene& scene) {
  std::set<RowColumn> seen;
  for (std::size_t i = 0; i < scene.loaded.size(); ++i) {
    const RowColumn place = scene.loaded[i];
    const std::string key = "analysis.load.pillars." + std::to_string(i + 1);
    if (!index_of(scene, place)) {
      const bool is_outside = place.first < 1 || place.first > scene.rows || place.second < 1 ||
                              place.second > scene.columns;
      throw SceneMistake(
          key, is_outside ? "there is no pillar " + name_of(place) +
                                "; rows are numbered from 1 to " + std::to_string(scene.rows) +
                                ", columns from 1 to " + std::to_string(scene.columns)
                          : "pillar " + name_of(place) + " is dead and bears no load");
    }
    if (!seen.insert(place).second) {
      throw SceneMistake(key, "pillar " + name_of(place) + " is named twice");
    }
  }
}

void check_size(const SpaceScene& scene) {
  const double loads[] = {scene.pressure_Pa, scene.shear_x_Pa, scene.shear_y_Pa};
  bool is_finite = true, is_zero = true;
  for (const double load : loads) {
    is_finite = is_finite && std::isfinite(load);
    is_zero = is_zero && load == 0.0;
  }
  if (!is_finite || is_zero) {
    throw SceneMistake("analysis.load",
                       "needs a pressure or a shear, such as pressure = \"1 kPa\" or shear_x = "
                       "\"100 Pa\"");
  }
}

void check_adhesion(const SpaceScene& scene) {
  const ShapePress& press = *scene.press;
  check_adhesion(press);
  if (press.work_of_adhesion_J_m2 == 0.0) return;
  if (scene.backing) {
    throw SceneMistake("shape.work_of_adhesion",
                       "is answered on a rigid backing; remove geometry.film.backing");
  }
  if (scene.touch) {
    throw SceneMistake(
        "analysis.kind",
        "must be static where tops are held by adhesion; shape.before has the depths "
        "that the shape went through");
  }
}

void check_friction(const SpaceScene& scene) {
  const ShapePress& press = *scene.press;
  if (press.friction == Friction::kNone) return;
  if (press.friction == Friction::kCoulomb) {
    if (!(press.friction_coefficient > 0.0)) {
      throw SceneMistake("shape.friction", "must be a positive number, \"none\" or \"stick\"");
    }
    if (scene.touch && scene.touch->is_path() && press.work_of_adhesion_J_m2 == 0.0) return;
    throw SceneMistake("shape.friction",
                       "lets tops slide, which needs a shape that moves, and no adhesion; give "
                       "shape.path, or say friction = \"none\" or \"stick\"");
  }
  const auto refuse = [](const std::string& beside) {
    throw SceneMistake("shape.friction", "sticks, which is not answered " + beside +
                                             "; say friction = \"none\", or remove the other");
  };
  if (scene.backing) refuse("on a backing, where a film also moves sideways");
  if (scene.touch) refuse("in time; full stick is for a depth that only grows");
  if (press.work_of_adhesion_J_m2 > 0.0 || !press.before_m.empty())
    refuse("beside adhesion for arrays in the plane");
}

void check_press(const SpaceScene& scene) {
  const ShapePress& press = *scene.press;
  if (has_load(scene)) {
    throw SceneMistake("analysis.load", "cannot stand beside a shape, which itself loads the tops");
  }
  at_key("shape", [&] { validate(press.shape); });
  check_friction(scene);
  check_adhesion(scene);
  double longest_m = 0.0;
  for (const SpaceClass& one : classes_of(scene)) longest_m = std::max(longest_m, one.length_m);
  check_press_place(press, "a force, such as force = \"5 mN\"", longest_m);
  const FoundationPress pressed = foundation_press(scene);
  check_press_plan(press, {.length_m = longest_m,
                           .touches = pressed.lowest_m < longest_m,
                           .shortening = pressed.shortening,
                           .covers_all = pressed.covers_all,
                           .feels_contact = scene.feels_contact});
}

// Each class that has a loaded pillar must bear the pressure upright.
void check_buckling(const SpaceScene& scene) {
  const std::vector<bool> loaded = is_loaded(scene);
  std::set<int> seen;
  for (std::size_t i = 0; i < loaded.size(); ++i) {
    const SpacePillar& pillar = scene.pillars[i];
    if (!loaded[i] || !seen.insert(pillar.of_class).second) continue;
    const double critical_Pa = engesser_pressure_Pa(single_pillar(scene, class_of(scene, pillar)));
    if (scene.pressure_Pa < critical_Pa) continue;
    throw SceneMistake("analysis.load", "a pressure of " + text_of(scene.pressure_Pa, 5) +
                                            " Pa is beyond the " + text_of(critical_Pa, 5) +
                                            " Pa at which pillar " +
                                            name_of({pillar.row, pillar.column}) +
                                            " buckles (Euler, Engesser); reduce it, or make the "
                                            "pillar shorter or thicker");
  }
}

void check_backing(const SpaceScene& scene) {
  if (!scene.backing) return;
  const Backing& backing = *scene.backing;
  if (!(backing.young_modulus_Pa > 0.0) || !std::isfinite(backing.young_modulus_Pa)) {
    throw SceneMistake("geometry.film.backing.E", "the backing's modulus must be positive");
  }
  if (!(backing.poisson_ratio >= 0.0 && backing.poisson_ratio < 0.5)) {
    throw SceneMistake(
        "geometry.film.backing.nu",
        "the backing's Poisson ratio must lie between 0 and 0.5; say 0.499 for rubber");
  }
  double softest_Pa = HUGE_VAL;
  for (const SpaceClass& one : classes_of(scene)) {
    softest_Pa = std::min(softest_Pa, one.material.E0_Pa);
  }
  if (backing.young_modulus_Pa < kSoftestBacking * softest_Pa) {
    throw SceneMistake(
        "geometry.film.backing.E",
        "the backing is softer than a tenth of the pillars, on which the film floats; "
        "take a stiffer one");
  }
  if (scene.press && !scene.feels_contact) {
    throw SceneMistake("effects.contact", "cannot be off on a backing; a shape only pushes there");
  }
  if (scene.touch) {
    throw SceneMistake("analysis.kind",
                       "relaxation and creep under a shape are answered on a rigid backing; remove "
                       "geometry.film.backing, or make the analysis static");
  }
}

void check_film(const SpaceScene& scene) {
  check_read_film(scene.film, scene.film_thickness_m, "an array in the plane");
  if (!(scene.film_edge_m >= 0.0) || !std::isfinite(scene.film_edge_m)) {
    throw SceneMistake("geometry.film.edge",
                       "the film beyond the outer pillars must not be "
                       "negative");
  }
  if (scene.grounded == FilmFace::kBottom && scene.electrode != SpaceElectrode::kEquipotential) {
    throw SceneMistake(
        "geometry.electrode.face",
        "cannot be the top here: the potential of a charge-free face has a steep rim at "
        "each foot that stands on it, and quarters are read through the film. Read the bottom, or "
        "write kind = \"equipotential\" without quadrants");
  }
  const double beyond_m = electrode_radius_m(scene) - 0.5 * scene.diameter_m;
  if (beyond_m > scene.film_edge_m) {
    throw SceneMistake("geometry.electrode.radius",
                       "the outer electrodes reach beyond the film; make them smaller, or the "
                       "film's edge wider");
  }
}

void check_quarter_gap(const SpaceArray& array, double radius_over_thickness) {
  constexpr double kLeast = 0.02, kMost = 0.5;  // of the radius
  constexpr double kWidest = 8.0;               // radius over the film's thickness
  const double gap_m = array.electrode_gap_m, radius_m = array.electrode_radius_m;
  if (array.electrode != SpaceElectrode::kMetalQuadrants) {
    if (gap_m == 0.0) return;
    throw SceneMistake("geometry.electrode.gap",
                       "lies between quarters of metal: write kind = \"equipotential\" and "
                       "quadrants = true, or remove the gap");
  }
  if (!(gap_m >= kLeast * radius_m && gap_m <= kMost * radius_m)) {
    throw SceneMistake("geometry.electrode.gap",
                       "between quarters of metal must lie between " +
                           micrometres(kLeast * radius_m, 3) + " and " +
                           micrometres(kMost * radius_m, 3) +
                           ", a fiftieth and half of the electrode's radius");
  }
  if (radius_over_thickness > kWidest) {
    throw SceneMistake("geometry.electrode.radius",
                       "of quarters of metal is at most eight times the film's thickness; write "
                       "kind = \"sampled\", whose means over the quarters they approach");
  }
}

double widest_m(const PillarGeometry& pillar) {
  return pillar.diameter_m + 2.0 * std::max({0.0, pillar.foot.width_m, pillar.tip.width_m});
}

}  // namespace

void validate(const SpaceArray& array) {
  if (array.pillars.empty()) throw SceneMistake("geometry", "the array has no pillars");
  for (const PillarClass& one : array.classes) validate(one.geometry);
  validate(array.film);
  if (!(array.electrode_radius_m > 0.0)) {
    throw SceneMistake("geometry.electrode.radius", "the electrode's radius must be positive");
  }
  const double radius_m = array.electrode_radius_m;
  const double t_m = array.film.layers.front().thickness_m;
  const double least_m = is_metal(array.electrode) ? least_gap_m(t_m, radius_m) : 0.0;
  check_quarter_gap(array, radius_m / t_m);
  double widest = 2.0 * radius_m + least_m;
  for (const PillarClass& one : array.classes)
    widest = std::max(widest, 1.1 * widest_m(one.geometry));
  if (array.film.backing && !OffsetSums::can_sum(sources_of(array))) {
    throw SceneMistake(
        "geometry.film.backing",
        "lets all pillars feel each other, which is answered for lattices (also with "
        "dead pillars) of any size and for at most 500 pillars elsewhere; place the "
        "pillars on a lattice, or say backing = \"rigid\"");
  }
  const Neighbours near(array.pillars, widest);
  for (std::size_t i = 0; i < array.pillars.size(); ++i) {
    const PlacedPillar& one = array.pillars[i];
    near.visit(one.x_m, one.y_m, [&](std::size_t j) {
      if (j <= i) return;
      const PlacedPillar& other = array.pillars[j];
      const double distance_m = std::hypot(other.x_m - one.x_m, other.y_m - one.y_m);
      const double width_m =
          0.5 * (widest_m(array.classes[static_cast<std::size_t>(one.of_class)].geometry) +
                 widest_m(array.classes[static_cast<std::size_t>(other.of_class)].geometry));
      const std::string pair = "pillars " + std::to_string(i + 1) + " and " + std::to_string(j + 1);
      if (distance_m < 1.1 * width_m) {
        throw SceneMistake("geometry.spacing",
                           "the gap between " + pair + " is " + micrometres(distance_m - width_m) +
                               "; it must be at least a tenth of their diameter, because feet that "
                               "nearly touch change each other's traction");
      }
      check_electrode_gap("geometry.electrode.radius", pair, distance_m, radius_m, least_m);
    });
  }
}

void validate(const SpaceScene& scene) {
  check_tolerance(scene.tolerance, SpaceScene::kTolerances);
  at_key("materials.pillar", [&] { validate(scene.pillar); });
  for (const SpaceClass& one : scene.others) {
    at_key("geometry.classes", [&] { validate(one.material); });
  }
  check_film(scene);
  check_backing(scene);
  at_key("geometry", [&] { validate(array_of(scene)); });
  if (!(scene.surface_energy_J_m2 > 0.0)) {
    throw SceneMistake("materials.surface_energy", "the surface energy must be positive");
  }
  check_heat_and_noise(scene);
  check_quadrants(scene);
  if (scene.quadrants.measured_V.size() > 0) return;
  if (scene.press) {
    check_press(scene);
    check_touch(scene);
    return;
  }
  check_size(scene);
  check_loaded_places(scene);
  check_buckling(scene);
}

}  // namespace viscard
