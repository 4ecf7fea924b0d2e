#pragma once

// Scenes of shapes that press on arrays in time, and what their answers say.
#include "models/array/space/touch_steps.h"
#include "models/scene/simulate.h"
#include "tests/models/array/space/film_of_the_thesis.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace viscard::test {

using History = Course;
constexpr double kShare = 0.3, kTau_s = 0.2;  // of the only term

inline RigidShape plane() {
  return {.kind = ShapeKind::kPlane, .table = {}};
}
inline RigidShape paraboloid(double radius_m) {
  return {.kind = ShapeKind::kParaboloid, .radius_m = radius_m, .table = {}};
}

inline SpaceScene touched(int rows, int columns, const RigidShape& shape, bool is_creep,
                          const History& history) {
  SpaceScene scene;
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = 0.33;
  scene.pillar.rho_kg_m3 = 965.0;
  scene.pillar.terms = {{kShare, kShare, kTau_s}};
  scene.film = pvdf_of_the_thesis();
  scene.rows = rows;
  scene.columns = columns;
  scene.pillars = lattice_places(SpaceLattice::kSquare, rows, columns, 100e-6);
  scene.film_edge_m = 300e-6;
  scene.tolerance = 5e-3;
  scene.press = ShapePress{.shape = shape};
  press_in_time(scene, {.is_creep = is_creep, .history = history, .readout = {}});
  return scene;
}

inline const SceneCurve& curve_of(const SceneAnswer& answer, const std::string& name) {
  const auto found = std::find_if(answer.curves.begin(), answer.curves.end(),
                                  [&](const SceneCurve& one) { return one.name == name; });
  if (found == answer.curves.end()) throw std::runtime_error("no curve " + name);
  return *found;
}

inline double result_of(const SceneAnswer& answer, const std::string& name) {
  for (const SceneResult& one : answer.results) {
    if (one.name == name) return one.value;
  }
  throw std::runtime_error("no result " + name);
}

// At a time of a curve without jumps.
inline double at(const SceneCurve& curve, double time_s) {
  const auto next = std::upper_bound(curve.x.begin(), curve.x.end(), time_s) - curve.x.begin();
  const auto k =
      static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(next, 1, std::ssize(curve.x) - 1));
  const double share = (time_s - curve.x[k - 1]) / (curve.x[k] - curve.x[k - 1]);
  return curve.value[k - 1] + share * (curve.value[k] - curve.value[k - 1]);
}

}  // namespace viscard::test
