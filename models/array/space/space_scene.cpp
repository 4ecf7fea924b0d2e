#include "models/array/space/space_scene.h"

#include "models/maths/neighbours.h"
#include "models/sensor/sensor_design.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace viscard {
namespace {

double widest_pillar_m(const SpaceScene& scene) {
  double widest_m = scene.diameter_m;
  for (const SpaceClass& one : scene.others) widest_m = std::max(widest_m, one.diameter_m);
  return widest_m;
}

}  // namespace

std::vector<SpacePillar> lattice_places(SpaceLattice lattice, int rows, int columns,
                                        double pitch_m) {
  const bool is_hexagonal = lattice == SpaceLattice::kHexagonal;
  const double row_pitch_m = is_hexagonal ? 0.5 * std::sqrt(3.0) * pitch_m : pitch_m;
  std::vector<SpacePillar> places;
  places.reserve(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
  for (int row = 1; row <= rows; ++row) {
    // Half of the shift to either side, so that the array stays around its middle.
    const double side = row % 2 == 0 ? 0.25 : -0.25;
    const double shift_m = is_hexagonal && rows > 1 ? side * pitch_m : 0.0;
    for (int column = 1; column <= columns; ++column) {
      places.push_back({row, column, (column - 0.5 * (columns + 1)) * pitch_m + shift_m,
                        (row - 0.5 * (rows + 1)) * row_pitch_m, 0});
    }
  }
  return places;
}

std::optional<std::size_t> index_of(const SpaceScene& scene, RowColumn place) {
  const auto found = std::lower_bound(
      scene.pillars.begin(), scene.pillars.end(), place,
      [](const SpacePillar& one, RowColumn at) { return RowColumn(one.row, one.column) < at; });
  if (found == scene.pillars.end() || RowColumn(found->row, found->column) != place) return {};
  return static_cast<std::size_t>(found - scene.pillars.begin());
}

std::string name_of(RowColumn place) {
  return "[" + std::to_string(place.first) + ", " + std::to_string(place.second) + "]";
}

bool has_load(const SpaceScene& scene) {
  return scene.pressure_Pa != 0.0 || scene.shear_x_Pa != 0.0 || scene.shear_y_Pa != 0.0 ||
         !scene.loaded.empty();
}

bool is_sheared(const SpaceScene& scene) {
  return scene.shear_x_Pa != 0.0 || scene.shear_y_Pa != 0.0 || scene.press.has_value() ||
         scene.quadrants.measured_V.size() > 0;
}

std::vector<SpaceClass> classes_of(const SpaceScene& scene) {
  std::vector<SpaceClass> all = {{scene.diameter_m, scene.length_m, scene.pillar}};
  all.insert(all.end(), scene.others.begin(), scene.others.end());
  return all;
}

SpaceClass class_of(const SpaceScene& scene, const SpacePillar& pillar) {
  if (pillar.of_class == 0) return {scene.diameter_m, scene.length_m, scene.pillar};
  return scene.others.at(static_cast<std::size_t>(pillar.of_class - 1));
}

double electrode_radius_m(const SpaceScene& scene) {
  return scene.electrode_radius_m > 0.0 ? scene.electrode_radius_m : 0.5 * scene.diameter_m;
}

SpaceArray array_of(const SpaceScene& scene) {
  SpaceArray array;
  for (const SpaceClass& one : classes_of(scene)) {
    array.classes.push_back(
        {{.diameter_m = one.diameter_m, .length_m = one.length_m},
         isotropic_medium(one.material.E0_Pa, one.material.nu, one.material.rho_kg_m3)});
  }
  array.pillars.reserve(scene.pillars.size());
  for (const SpacePillar& one : scene.pillars) {
    array.pillars.push_back({one.x_m, one.y_m, one.of_class});
  }
  array.film.layers = {{scene.film, scene.film_thickness_m}};
  array.film.grounded = scene.grounded;
  if (scene.feels_backing) array.film.backing = scene.backing;
  array.electrode = scene.electrode;
  array.electrode_radius_m = electrode_radius_m(scene);
  array.electrode_gap_m = scene.electrode_gap_m;
  return array;
}

std::vector<bool> is_loaded(const SpaceScene& scene) {
  std::vector<bool> loaded(scene.pillars.size(), scene.loaded.empty());
  for (const RowColumn& place : scene.loaded) {
    if (const auto index = index_of(scene, place)) loaded[*index] = true;
  }
  return loaded;
}

TopLoads loads_of(const SpaceScene& scene) {
  TopLoads loads = TopLoads::Zero(static_cast<Eigen::Index>(scene.pillars.size()), kTopLoads);
  const std::vector<bool> loaded = is_loaded(scene);
  for (std::size_t i = 0; i < loaded.size(); ++i) {
    if (!loaded[i]) continue;
    const auto row = static_cast<Eigen::Index>(i);
    loads(row, static_cast<int>(TopLoad::kPressure)) = scene.pressure_Pa;
    loads(row, static_cast<int>(TopLoad::kShearX)) = scene.shear_x_Pa;
    loads(row, static_cast<int>(TopLoad::kShearY)) = scene.shear_y_Pa;
  }
  return loads;
}

PillarScene single_pillar(const SpaceScene& scene, const SpaceClass& one) {
  PillarScene single;
  single.tolerance = scene.tolerance;
  single.geometry.diameter_m = one.diameter_m;
  single.geometry.length_m = one.length_m;
  single.pillar = one.material;
  return single;
}

FilmExtent film_extent(const SpaceScene& scene) {
  const double far_m = std::numeric_limits<double>::infinity();
  FilmExtent extent{far_m, -far_m, far_m, -far_m};
  const std::vector<SpaceClass> classes = classes_of(scene);
  for (const SpacePillar& one : scene.pillars) {
    const double half_m =
        0.5 * classes[static_cast<std::size_t>(one.of_class)].diameter_m + scene.film_edge_m;
    extent.left_m = std::min(extent.left_m, one.x_m - half_m);
    extent.right_m = std::max(extent.right_m, one.x_m + half_m);
    extent.low_m = std::min(extent.low_m, one.y_m - half_m);
    extent.high_m = std::max(extent.high_m, one.y_m + half_m);
  }
  return extent;
}

double smallest_pitch_m(const SpaceScene& scene) {
  const double within_m = 2.0 * widest_pillar_m(scene);
  return scene.pillars.size() < 2 ? within_m : nearest_distance_m(scene.pillars, within_m);
}

double smallest_gap_m(const SpaceScene& scene) {
  if (scene.pillars.size() < 2) return std::numeric_limits<double>::infinity();
  // Pairs farther apart than the nearest one may have a smaller gap if they are wider.
  const std::vector<SpaceClass> classes = classes_of(scene);
  const auto diameter_m = [&](const SpacePillar& one) {
    return classes[static_cast<std::size_t>(one.of_class)].diameter_m;
  };
  double smallest_m = std::numeric_limits<double>::infinity();
  const Neighbours near(scene.pillars, smallest_pitch_m(scene) + widest_pillar_m(scene));
  for (const SpacePillar& one : scene.pillars) {
    near.visit(one.x_m, one.y_m, [&](std::size_t j) {
      const SpacePillar& other = scene.pillars[j];
      if (&other <= &one) return;
      smallest_m = std::min(smallest_m, std::hypot(other.x_m - one.x_m, other.y_m - one.y_m) -
                                            0.5 * (diameter_m(one) + diameter_m(other)));
    });
  }
  return smallest_m;
}

double class_pull_off_N(const SpaceClass& one, double work_J_m2) {
  return pull_off_force_N(one.diameter_m, {.young_modulus_Pa = one.material.E0_Pa,
                                           .poisson_ratio = one.material.nu,
                                           .work_of_adhesion_J_m2 = work_J_m2});
}

}  // namespace viscard
