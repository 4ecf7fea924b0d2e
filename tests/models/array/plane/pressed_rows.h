#pragma once

// Rows of the thesis under rigid shapes.
#include "models/array/plane/array_scene.h"
#include "tests/models/array/space/film_of_the_thesis.h"

namespace viscard::test {

inline ArrayScene pressed_row(const ShapePress& press, int count = 8,
                              PlaneState plane = PlaneState::kStress) {
  ArrayScene scene;
  scene.tolerance = 1e-3;
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = 0.33;
  scene.pillar.rho_kg_m3 = 965.0;
  scene.film = pvdf_of_the_thesis();
  scene.plane = plane;
  scene.geometry.count = count;
  scene.geometry.film_edge_m = 200e-6;
  scene.press = press;
  return scene;
}

// The profile of chapter 8: between the fourth and the fifth of eight pillars.
inline ShapePress cylinder(double depth_m, Friction friction = Friction::kNone,
                           double radius_m = 3650e-6) {
  return {.shape = {.kind = ShapeKind::kCylinder, .radius_m = radius_m, .table = {}},
          .depth_m = depth_m,
          .friction = friction};
}

}  // namespace viscard::test
