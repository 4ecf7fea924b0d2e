// Arrays in the plane at extremes: whole answers with the error that they claim, against finer ones.
#include "models/array/space/simulate_space.h"
#include "tests/models/array/space/film_of_the_thesis.h"
#include "tests/models/pillar/stability/stability_cases.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace viscard::test {
namespace {

SpaceScene thesis_array(int rows, int columns, double pitch_m = 100e-6) {
  SpaceScene scene;
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = 0.33;
  scene.pillar.rho_kg_m3 = 965.0;
  scene.film = pvdf_of_the_thesis();
  scene.rows = rows;
  scene.columns = columns;
  scene.pillars = lattice_places(SpaceLattice::kSquare, rows, columns, pitch_m);
  scene.film_edge_m = 300e-6;
  scene.tolerance = 1e-3;
  scene.wanted = {"mean_voltage", "centre_voltage"};
  return scene;
}

SpaceScene pressed_middle(SpaceScene scene) {
  scene.pressure_Pa = 1e3;
  scene.loaded = {{(scene.rows + 1) / 2, (scene.columns + 1) / 2}};
  return scene;
}

SpaceScene under(SpaceScene scene, const RigidShape& shape, double depth_m) {
  scene.press = ShapePress{.shape = shape, .depth_m = depth_m};
  scene.tolerance = 1e-2;
  scene.wanted.push_back("pillar_force");
  return scene;
}

// Every map of an answer against a finer one.
Seen maps_of_answers(const SceneAnswer& answer, const SceneAnswer& fine) {
  Seen worst{0.0, 0.0};
  for (const SceneMap& map : answer.maps) {
    const auto exact = std::find_if(fine.maps.begin(), fine.maps.end(),
                                    [&](const SceneMap& one) { return one.name == map.name; });
    const double size = size_of(*exact);
    for (std::size_t i = 0; i < map.value.size() && size > 0.0; ++i) {
      const double error = std::abs(map.value[i] - exact->value[i]);
      worst.error = std::max(worst.error, error / size);
      worst.of_claim = std::max(*worst.of_claim, error / (map.error[i] + 1e-12 * size));
    }
  }
  return worst;
}

Seen against_finest(const SpaceScene& scene) {
  return maps_of_answers(simulate_space(scene), space_answer_on(scene, space_meshes(scene)[5]));
}

Seen against_tenth(SpaceScene scene) {
  const SceneAnswer answer = simulate_space(scene);
  scene.tolerance *= 0.2;
  return maps_of_answers(answer, simulate_space(scene));
}

// All forces and voltages of a shape that touches nothing are zero.
Seen of_nothing(const SpaceScene& scene) {
  double largest = 0.0;
  for (const SceneMap& map : simulate_space(scene).maps) {
    largest = std::max(largest, largest_size(map.value));
  }
  return largest;
}

// A plane at a small depth: k depth on every pillar, whatever the depth.
Seen scaled_with_depth(double depth_m) {
  const auto force_N = [](double at_m) {
    const SceneAnswer answer = simulate_space(under(thesis_array(2, 2), {}, at_m));
    return answer.maps.back().value.front();
  };
  return std::abs(force_N(depth_m) / depth_m / (force_N(1e-6) / 1e-6) - 1.0);
}

SpaceScene film_beyond_pitch() {
  SpaceScene scene = thesis_array(3, 3, 40e-6);
  scene.diameter_m = 20e-6;
  scene.length_m = 60e-6;
  scene.film_thickness_m = 60e-6;
  scene.film_edge_m = 500e-6;
  return pressed_middle(scene);
}

// A ceramic with a coupling of 0.7, poled across the film.
Medium strong_film() {
  PiezoMatrix d = PiezoMatrix::Zero();
  d(2, 0) = d(2, 1) = -171e-12;
  d(2, 2) = 374e-12;
  return piezo_medium(isotropic_moduli_Pa(60e9, 0.31), d,
                      1700.0 * kVacuumPermittivity_F_m * Eigen::Matrix3d::Identity(), 7750.0);
}

// One needle of heights between flat ground: half a micrometre wide, on the axis of a pillar.
RigidShape needle() {
  RigidShape shape;
  shape.kind = ShapeKind::kTable;
  shape.table.x_m = shape.table.y_m = {-200e-6, -0.25e-6, 0.0, 0.25e-6, 200e-6};
  shape.table.height_m.assign(25, 2e-6);
  shape.table.height_m[12] = 0.0;
  return shape;
}

// A spike between the nodes of a top must be resolved or refused: 0 if refused, otherwise the claim is judged.
Seen of_needle() {
  try {
    return against_tenth(under(thesis_array(1, 1), needle(), 1e-6));
  } catch (const std::exception&) {
    return {0.0, 0.0};
  }
}

}  // namespace

std::vector<StabilityCase> touch_stability_cases() {
  RigidShape edge;  // over x > 0, from the very rim of the pillar at x = 0 + 20 um
  edge.kind = ShapeKind::kEdge;
  edge.x_m = 30e-6;  // pillars at -50 and 50 um
  RigidShape far;
  far.kind = ShapeKind::kSphere;
  far.radius_m = 1e-3;
  far.x_m = far.y_m = 5e-3;
  SpaceScene ceramic = pressed_middle(thesis_array(3, 3));
  ceramic.film = strong_film();
  SpaceScene round = pressed_middle(thesis_array(3, 3));
  round.film = pvdf_of_the_thesis(12.5e-12, 12.5e-12);
  return {
      {"array of one pillar: voltages",
       [] { return against_finest(pressed_middle(thesis_array(1, 1))); }, 8e-5},
      {"array with gaps of 0.15 diameters: voltages",
       [] { return against_finest(pressed_middle(thesis_array(3, 3, 46e-6))); }, 8e-5},
      {"array on a film thicker than its pitch: voltages",
       [] { return against_finest(film_beyond_pitch()); }, 1e-4},
      {"array on a film with d31 = d32: voltages", [=] { return against_finest(round); }, 8e-5},
      {"array on a film of PZT: voltages", [=] { return against_finest(ceramic); }, 9e-5},
      {"edge of a shape at the very rim of a top: forces",
       [=] { return against_tenth(under(thesis_array(1, 2), edge, 1e-6)); }, 1e-12},
      {"shape that touches nothing: forces and voltages",
       [=] { return of_nothing(under(thesis_array(2, 2), far, 1e-6)); }, 1e-15},
      {"spike of half a micrometre on a top: refused or within its claim",
       [] { return of_needle(); }, 1e-2},
      {"shape 1e-9 times as deep: force over depth", [] { return scaled_with_depth(1e-15); }, 1e-9},
  };
}

}  // namespace viscard::test
