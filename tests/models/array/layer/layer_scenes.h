#pragma once

#include "models/answer/scene_answer.h"
#include "models/array/layer/layer_scene.h"
#include "tests/models/array/space/film_of_the_thesis.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace viscard::test {

constexpr double kE_Pa = 1.8e6;
constexpr double kH_m = 120e-6;
constexpr double kR_m = 3650e-6;

// 120 um of PDMS on the thesis' film under the thesis' profile.
inline LayerScene layer_of_the_thesis(LayerModel model, double depth_m) {
  LayerScene scene;
  scene.model = model;
  scene.pillar.E0_Pa = kE_Pa;
  scene.pillar.nu = 0.33;
  scene.pillar.rho_kg_m3 = 965.0;
  scene.film = pvdf_of_the_thesis();
  scene.press.shape.kind =
      model == LayerModel::kSpace ? ShapeKind::kParaboloid : ShapeKind::kCylinder;
  scene.press.shape.radius_m = kR_m;
  scene.press.depth_m = depth_m;
  return scene;
}

// Rigid bases stand for films of 2e13 Pa, which yield 1e-7 of the layer.
inline LayeredFilm layer_on_rigid_base(double nu, double thickness_m) {
  Medium base = isotropic_medium(2e13, 0.29, 1000.0);
  base.permittivity_F_m = 1e-10 * Eigen::Matrix3d::Identity();
  LayeredFilm stack;
  stack.layers = {{base, 25e-6}, {isotropic_medium(kE_Pa, nu, 965.0), thickness_m}};
  return stack;
}

// Throws std::runtime_error if there is none of that name.
inline const SceneResult& result_of(const SceneAnswer& answer, const std::string& name) {
  const auto found = std::find_if(answer.results.begin(), answer.results.end(),
                                  [&](const SceneResult& one) { return one.name == name; });
  if (found == answer.results.end()) throw std::runtime_error("no result " + name);
  return *found;
}

}  // namespace viscard::test
