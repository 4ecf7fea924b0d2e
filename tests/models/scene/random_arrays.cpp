#include "tests/models/scene/random_arrays.h"

#include "models/array/space/simulate_space.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/buckling_limit.h"
#include "tests/models/array/space/film_of_the_thesis.h"
#include "tests/support/random_draw.h"

#include <algorithm>
#include <cmath>

namespace viscard::test {
namespace {

void draw_film(Draw& draw, SpaceScene& scene) {
  scene.film = pvdf_of_the_thesis();
  if (draw.chance(0.4)) return;
  const double E = scene.pillar.E0_Pa * draw.log_uniform(1e3, 1e5);
  const double permittivity = kVacuumPermittivity_F_m * draw.log_uniform(8.0, 2000.0);
  PiezoMatrix d = PiezoMatrix::Zero();
  d(2, 2) = draw.log_uniform(0.02, 0.5) * std::sqrt(permittivity / E);
  d(2, 0) = -draw.uniform(0.1, 0.8) * d(2, 2);
  d(2, 1) = -draw.uniform(0.1, 0.8) * d(2, 2);
  scene.film = piezo_medium(isotropic_moduli_Pa(E, draw.uniform(0.1, 0.4)), d,
                            permittivity * Eigen::Matrix3d::Identity(), 1780.0);
}

void draw_places(Draw& draw, SpaceScene& scene) {
  scene.rows = 1 + draw.below(5);
  scene.columns = 1 + draw.below(5);
  const double pitch_m =
      scene.diameter_m +
      std::max(0.15 * scene.diameter_m, scene.film_thickness_m * draw.log_uniform(0.3, 12.0));
  const bool is_hexagonal = draw.chance(0.3);
  scene.pillars = lattice_places(is_hexagonal ? SpaceLattice::kHexagonal : SpaceLattice::kSquare,
                                 scene.rows, scene.columns, pitch_m);
  if (draw.chance(0.3)) {  // each somewhere in its cell
    const double room_m = 0.4 * (pitch_m - 1.15 * scene.diameter_m);
    for (SpacePillar& one : scene.pillars) {
      one.x_m += room_m * draw.uniform(-1.0, 1.0) / std::sqrt(2.0);
      one.y_m += room_m * draw.uniform(-1.0, 1.0) / std::sqrt(2.0);
    }
  }
  if (scene.pillars.size() > 2 && draw.chance(0.3)) {
    const int dead = draw.below(static_cast<int>(scene.pillars.size()));
    scene.pillars.erase(scene.pillars.begin() + dead);
  }
}

void draw_loads(Draw& draw, SpaceScene& scene) {
  const double critical_Pa = engesser_pressure_Pa(single_pillar(scene, classes_of(scene).back()));
  const double kind = draw.uniform(0.0, 1.0);
  if (kind < 0.75) scene.pressure_Pa = draw.uniform(0.01, 0.3) * critical_Pa;
  if (kind > 0.5) {
    scene.shear_x_Pa = draw.uniform(-0.05, 0.05) * critical_Pa;
    scene.shear_y_Pa = draw.uniform(-0.05, 0.05) * critical_Pa;
  }
  if (draw.chance(0.4)) return;
  for (const SpacePillar& one : scene.pillars) {
    if (draw.chance(0.3)) scene.loaded.emplace_back(one.row, one.column);
  }
}

// A shape whose tilt over a top lies between nothing and its depth, so that tops are touched in whole, in
// part and not at all.
void draw_press(Draw& draw, SpaceScene& scene) {
  ShapePress press;
  RigidShape& shape = press.shape;
  const ShapeKind kinds[] = {ShapeKind::kPlane, ShapeKind::kCylinder, ShapeKind::kSphere,
                             ShapeKind::kParaboloid, ShapeKind::kWedge};
  shape.kind = kinds[draw.below(5)];
  const double critical_Pa = engesser_pressure_Pa(single_pillar(scene, classes_of(scene).front()));
  press.depth_m = draw.log_uniform(0.01, 0.5) * critical_Pa / scene.pillar.E0_Pa * scene.length_m;
  const double wide_m = scene.diameter_m + scene.film_thickness_m * draw.log_uniform(0.1, 30.0);
  shape.radius_m = 0.5 * wide_m * wide_m / press.depth_m;
  shape.slope = press.depth_m / wide_m;
  shape.direction_rad = draw.uniform(0.0, 3.0);
  const double reach_m = scene.pillars.back().x_m;
  shape.x_m = draw.uniform(-1.0, 1.0) * reach_m;
  shape.y_m = draw.uniform(-1.0, 1.0) * reach_m;
  if (shape.kind == ShapeKind::kPlane || draw.chance(0.3)) {
    shape.tilt_x = draw.uniform(-1.0, 1.0) * press.depth_m / wide_m;
    shape.tilt_y = draw.uniform(-1.0, 1.0) * press.depth_m / wide_m;
  }
  scene.press = press;
}

void draw_electrode(Draw& draw, SpaceScene& scene) {
  const double kind = draw.uniform(0.0, 1.0);
  scene.electrode = kind < 0.4   ? SpaceElectrode::kSampled
                    : kind < 0.7 ? SpaceElectrode::kQuadrants
                                 : SpaceElectrode::kEquipotential;
  if (scene.electrode == SpaceElectrode::kEquipotential && draw.chance(0.3)) {
    scene.grounded = FilmFace::kBottom;
  }
}

// Electrodes that influence each other less than the tolerance (eq. S5).
void keep_electrodes_apart(SpaceScene& scene) {
  if (scene.electrode != SpaceElectrode::kEquipotential) return;
  for (int i = 0; i < 8 && electrode_error(scene) > 0.3 * scene.tolerance; ++i) {
    scene.electrode_radius_m = 0.85 * electrode_radius_m(scene);
  }
  if (electrode_error(scene) > 0.3 * scene.tolerance) scene.electrode = SpaceElectrode::kSampled;
}

// Within what the answers state: a foot that the film holds (eq. S7), a film whose edge is not felt (eq. S8).
void keep_limits(Draw& draw, SpaceScene& scene) {
  const double film_Pa = elasticity_of(scene.film).young_Pa;
  const double softer = std::min(1.0, scene.tolerance * film_Pa / scene.pillar.E0_Pa);
  scene.pillar.E0_Pa *= softer;
  for (SpaceClass& one : scene.others) one.material.E0_Pa *= softer;
  scene.pressure_Pa *= softer;
  scene.shear_x_Pa *= softer;
  scene.shear_y_Pa *= softer;
  scene.film_edge_m =
      scene.film_thickness_m * (draw.uniform(1.0, 3.0) + 0.6 * std::log(10.0 / scene.tolerance));
  keep_electrodes_apart(scene);
  if (scene.electrode == SpaceElectrode::kSampled) scene.grounded = FilmFace::kTop;
  if (!draw.chance(0.25)) return;
  scene.backing = Backing{film_Pa * draw.log_uniform(2.0, 50.0), draw.uniform(0.2, 0.45)};
  scene.tolerance = std::max(scene.tolerance, 2e-3);
  scene.film_edge_m *= 10.0;
  keep_electrodes_apart(scene);  // which a backing lets influence each other more
  if (scene.electrode == SpaceElectrode::kSampled) scene.grounded = FilmFace::kTop;
}

}  // namespace

SpaceScene random_touch(std::mt19937_64& random) {
  SpaceScene scene = random_array(random);
  Draw draw(random);
  const bool is_pressed = draw.chance(0.5);
  scene.tolerance = is_pressed ? draw.log_uniform(2e-3, 1e-2) : draw.log_uniform(1e-4, 1e-2);
  draw_electrode(draw, scene);
  keep_limits(draw, scene);
  if (!is_pressed) {
    if (scene.pressure_Pa == 0.0 && scene.shear_x_Pa == 0.0) scene.pressure_Pa = 1e2;
    return scene;
  }
  scene.pressure_Pa = scene.shear_x_Pa = scene.shear_y_Pa = 0.0;
  scene.loaded.clear();
  draw_press(draw, scene);
  if (!scene.backing && draw.chance(0.25)) scene.press->friction = Friction::kStick;
  return scene;
}

SpaceScene random_pressed_array(std::mt19937_64& random) {
  SpaceScene scene = random_array(random);
  scene.pressure_Pa = scene.shear_x_Pa = scene.shear_y_Pa = 0.0;
  scene.loaded.clear();
  Draw draw(random);
  scene.tolerance = draw.log_uniform(2e-3, 3e-2);
  draw_press(draw, scene);
  return scene;
}

SpaceScene random_array(std::mt19937_64& random) {
  Draw draw(random);
  SpaceScene scene;
  scene.tolerance = draw.log_uniform(5e-4, 3e-2);
  scene.pillar.E0_Pa = draw.log_uniform(2e5, 2e6);
  scene.pillar.nu = draw.chance(0.2) ? 0.49 : draw.uniform(0.2, 0.45);
  scene.pillar.rho_kg_m3 = 965.0;
  draw_film(draw, scene);
  scene.diameter_m = draw.log_uniform(10e-6, 80e-6);
  scene.length_m = scene.diameter_m * draw.uniform(1.5, 4.0);
  scene.film_thickness_m = scene.diameter_m * draw.log_uniform(0.15, 1.5);
  scene.film_edge_m = scene.film_thickness_m * draw.uniform(6.0, 12.0);
  draw_places(draw, scene);
  if (draw.chance(0.3)) {
    scene.others = {
        {scene.diameter_m * draw.uniform(0.8, 1.0), 0.9 * scene.length_m, scene.pillar}};
    scene.pillars.front().of_class = 1;
  }
  if (draw.chance(0.4)) scene.electrode = SpaceElectrode::kQuadrants;
  if (draw.chance(0.3)) scene.electrode_radius_m = 0.5 * scene.diameter_m * draw.uniform(0.6, 1.0);
  draw_loads(draw, scene);
  return scene;
}

}  // namespace viscard::test
