// Errors of an array in the plane that do not depend on the accuracy level.
#include "models/array/film/disc_charge.h"
#include "models/array/space/potential_spectrum.h"
#include "models/array/space/simulate_space.h"
#include "models/maths/text_of_number.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/mesh/scene_mistake.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace viscard {

double neighbour_influence(double x, double thickness_over_diameter) {
  const double field = 1.4 * thickness_over_diameter * std::exp(-0.5 * std::numbers::pi * x);
  return std::min(1.0, field + 0.45 * std::exp(-0.9215 * x));
}

double rigid_foot_error(const SpaceScene& scene) {
  double stiffest_Pa = 0.0;
  for (const SpaceClass& one : classes_of(scene)) {
    stiffest_Pa = std::max(stiffest_Pa, one.material.E0_Pa);
  }
  constexpr double kPressed = 0.12, kSheared = 0.2;
  // A shape turns the tops, which bends the pillars as a shear does.
  const bool is_sheared = scene.shear_x_Pa != 0.0 || scene.shear_y_Pa != 0.0 || scene.press ||
                          scene.quadrants.measured_V.size() > 0;
  return (is_sheared ? kSheared : kPressed) * stiffest_Pa / elasticity_of(scene.film).young_Pa;
}

double electrode_error(const SpaceScene& scene) {
  const double pitch_m = smallest_pitch_m(scene);
  if (scene.electrode != SpaceElectrode::kEquipotential || scene.pillars.size() < 2) return 0.0;
  const SpaceArray array = array_of(scene);
  const PotentialAccuracy accuracy = space_accuracies(array)[1].potential;
  const DiscCharge charge(array.film, array.electrode_radius_m, 1, 4, accuracy.film_degree);
  const double influence = mutual_influence(array.film, charge, pitch_m, accuracy);
  return influence * influence;
}

std::vector<double> film_edge_errors(const SpaceScene& scene) {
  const FilmExtent film = film_extent(scene);
  const std::vector<bool> loaded = is_loaded(scene);
  const std::vector<SpaceClass> classes = classes_of(scene);
  std::vector<double> to_edge_m;
  double nearest_m = HUGE_VAL;  // of the loaded pillars
  for (std::size_t i = 0; i < scene.pillars.size(); ++i) {
    const SpacePillar& one = scene.pillars[i];
    const double radius_m = 0.5 * classes[static_cast<std::size_t>(one.of_class)].diameter_m;
    to_edge_m.push_back(std::min({one.x_m - film.left_m, film.right_m - one.x_m,
                                  one.y_m - film.low_m, film.high_m - one.y_m}) -
                        radius_m);
    if (loaded[i]) nearest_m = std::min(nearest_m, to_edge_m.back());
  }
  for (double& one : to_edge_m) {
    const double way = (one + nearest_m) / scene.film_thickness_m;
    one = way < 2.0 ? 2.0 : std::exp(-0.9215 * way);
  }
  return to_edge_m;
}

// At its edge the endless film carries stress that a free edge cannot bear. Relieving it changes
// the voltages by at most about the reading of the endless film there, with a factor taken from
// finite films (eq. S12).
BackingEffect backing_effect(const SpaceScene& scene, const TopLoads& loads_Pa) {
  constexpr double kOfEdge = 1.0;
  BackingEffect effect;
  SpaceArray array = array_of(scene);
  const FilmExtent film = film_extent(scene);
  SpaceAccuracy accuracy = space_accuracies(array)[1];
  accuracy.potential.far_m = std::hypot(film.right_m - film.left_m, film.high_m - film.low_m);
  const SpaceResponse response(array, accuracy);
  const Eigen::VectorXd voltages_V = response.voltages_V(loads_Pa).col(0);
  Eigen::Index largest = 0;
  const double largest_V = voltages_V.cwiseAbs().maxCoeff(&largest);
  if (!(largest_V > 0.0)) return effect;
  const double x_m = 0.5 * (film.left_m + film.right_m), y_m = 0.5 * (film.low_m + film.high_m);
  for (const double x : {film.left_m, x_m, film.right_m}) {
    for (const double y : {film.low_m, y_m, film.high_m}) {
      if (x == x_m && y == y_m) continue;
      effect.edge = std::max(effect.edge, std::abs(response.voltage_at_V(x, y, loads_Pa)));
    }
  }
  effect.edge *= kOfEdge / largest_V;
  array.film.backing.reset();
  const Eigen::VectorXd rigid_V =
      SpaceResponse(array, space_accuracies(array)[1]).voltages_V(loads_Pa).col(0);
  effect.pillar = static_cast<std::size_t>(largest);
  effect.voltage_V = voltages_V[largest];
  effect.rigid_V = rigid_V[largest];
  return effect;
}

void check_edge(const SpaceScene& scene, const BackingEffect& effect, double other_errors,
                double most) {
  if (effect.edge + other_errors <= most) return;
  throw SceneMistake("geometry.film.edge",
                     "the film is solved without its edge, " + micrometres(scene.film_edge_m, 4) +
                         " from the outer pillars, but on this backing it is stretched as far as "
                         "that. That leaves a relative error of about " +
                         text_of(effect.edge + other_errors, 2) + ", too much for a tolerance of " +
                         text_of(scene.tolerance, 2) +
                         "; ask for a larger one, for a wider film, or for a stiffer backing");
}

void add_stretching_note(const SpaceScene& scene, const BackingEffect& effect,
                         SceneAnswer& answer) {
  constexpr double kStretchingFrom = 0.1;  // of the voltage on a rigid base
  const double change_V = effect.voltage_V - effect.rigid_V;
  if (!(std::abs(change_V) > kStretchingFrom * std::abs(effect.rigid_V))) return;
  const SpacePillar& one = scene.pillars[effect.pillar];
  answer.notes.push_back(
      "stretching: pillar [" + std::to_string(one.row) + ", " + std::to_string(one.column) +
      "] reads " + text_of(effect.voltage_V, 4) + " V, on a rigid base " +
      text_of(effect.rigid_V, 4) + " V (" +
      text_of(100.0 * change_V / std::abs(effect.rigid_V), 3) +
      " %): on this backing the film reads how it is stretched by all pillars, not the pressure on "
      "one; take a stiffer backing");
}

}  // namespace viscard
