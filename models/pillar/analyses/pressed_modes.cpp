#include "models/pillar/analyses/pressed_modes.h"

#include "models/answer/error_control.h"
#include "models/maths/text_of_number.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/buckling_limit.h"

#include <stdexcept>
#include <string>

namespace viscard {
namespace {

double pressure_on_modes_Pa(const PillarScene& scene) {
  return std::get<ModalDrive>(scene.drive).pressure_Pa;
}

// The pressure at which the pillar buckles with the stress and the moduli of its modes.
SceneResult converged_buckling(const PillarScene& scene) {
  constexpr double kTolerance = 3e-4;
  const auto on_mesh = [&](const Discretisation& mesh) {
    SceneAnswer answer;
    answer.discretisation = mesh;
    answer.discretisation.grades_top = true;
    const auto axial = pressed_model(scene, answer.discretisation);
    const PillarModel lateral = model_of(scene, Motion::kLateral, answer.discretisation);
    answer.results.push_back({"buckling_pressure", buckling(*axial, lateral).pressure_Pa, "Pa"});
    return answer;
  };
  const ErrorControl control{
      kTolerance, stressed_mesh_sequence(scene.geometry), {}, kShareLeftOfStress};
  return answer_within(control, on_mesh).results.front();
}

// What the model of the stress is made of.
PillarMedia pressed_media(const PillarScene& scene) {
  const PillarScene relaxed = long_term_scene(scene);
  const bool lasts = pressure_on_modes_Pa(scene) < 0.9 * engesser_pressure_Pa(relaxed);
  return media_of(lasts ? relaxed : scene);
}

}  // namespace

bool is_pressed(const PillarScene& scene) {
  return pressure_on_modes_Pa(scene) != 0.0 && !scene.plane;
}

std::unique_ptr<PillarModel> pressed_model(const PillarScene& scene, const Discretisation& mesh) {
  if (!is_pressed(scene)) return nullptr;
  const NearbyPillar* nearby =
      nearby_of(scene, Motion::kLongitudinal, false, NearbyRole::kPrestress);
  return std::make_unique<PillarModel>(scene.geometry, mesh, pressed_media(scene),
                                       options_of(scene, Motion::kLongitudinal),
                                       nearby == nullptr ? nullptr : &nearby->model(),
                                       nearby == nullptr ? nullptr : &nearby->solutions());
}

std::unique_ptr<NearbyPillar> nearby_pressed_model(const PillarScene& scene,
                                                   const Discretisation& mesh) {
  auto model = std::make_unique<NearbyPillar>(scene.geometry, mesh, pressed_media(scene),
                                              options_of(scene, Motion::kLongitudinal),
                                              NearbyRole::kPrestress);
  model->solve();
  return model;
}

void judge_buckling(const PillarScene& scene, const BeyondBuckling& here) {
  const SceneResult limit = converged_buckling(scene);
  const double pressure_Pa = pressure_on_modes_Pa(scene);
  const std::string pressure = "a pressure of " + text_of(pressure_Pa, 5) + " Pa on the top is ";
  const std::string limit_Pa = "the buckling pressure of " + text_of(limit.value, 5) + " +- " +
                               text_of(limit.error_estimate, 2) + " Pa";
  if (pressure_Pa >= limit.value - limit.error_estimate) {
    throw std::runtime_error(pressure + "beyond " + limit_Pa +
                             ", or too near to it; reduce it, because vibrations need a stable "
                             "straight pillar");
  }
  throw MeshTooCoarse(pressure + "below " + limit_Pa + ", but this mesh buckles at " +
                      text_of(here.critical_Pa(), 5) + " Pa; choose a finer one");
}

}  // namespace viscard
