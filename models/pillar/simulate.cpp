#include "models/pillar/analysis.h"
#include "models/pillar/effects.h"
#include "models/pillar/error_control.h"
#include "models/pillar/pillar_modes.h"
#include "models/pillar/scene_mistake.h"

#include <algorithm>
#include <numbers>
#include <stdexcept>
#include <string>

namespace viscard {
namespace {

// A load on the straight pillar beyond its buckling pressure has no meaning; worth computing only
// where Euler's formula (clamped-free, K = 2) comes near.
void refuse_buckled(const Scene& scene) {
  if (scene.plane || scene.kind == AnalysisKind::kModal || scene.kind == AnalysisKind::kBuckling)
    return;
  double largest_Pa = scene.pressure_Pa;
  if (scene.kind == AnalysisKind::kCreep) {
    for (const HistoryPoint& point : scene.history) largest_Pa = std::max(largest_Pa, point.value);
  }
  const double slenderness = scene.geometry.diameter_m / scene.geometry.length_m;
  const double pi = std::numbers::pi;
  const double euler_Pa = pi * pi / 64.0 * scene.pillar.E0_Pa * slenderness * slenderness;
  if (largest_Pa < 0.5 * euler_Pa) return;
  const Discretisation mesh = mesh_sequence(scene.geometry)[1];
  const PillarModel axial(scene.geometry, mesh, media_of(scene), {.motion = Motion::kLongitudinal});
  const PillarModel lateral(scene.geometry, mesh, media_of(scene), {.motion = Motion::kLateral});
  const double critical_Pa = buckling(axial, lateral).pressure_Pa;
  if (largest_Pa >= critical_Pa) {
    throw SceneMistake(
        scene.kind == AnalysisKind::kCreep ? "analysis.history" : "analysis.load.pressure",
        "a pressure of " + std::to_string(largest_Pa) +
            " Pa is beyond the buckling pressure of about " + std::to_string(critical_Pa) +
            " Pa: the straight pillar gives way sideways. Reduce the load, or make the "
            "pillar shorter or thicker");
  }
}

// Errors are watched only of what is asked for.
void mark_wanted(const Scene& scene, SceneAnswer& answer) {
  for (SceneResult& r : answer.results) r.is_wanted = asks_for(scene, r.name);
}

}  // namespace

SceneAnswer simulate(const Scene& scene) {
  validate(scene);
  refuse_buckled(scene);
  const Analysis& analysis = analysis_of(scene.kind);
  const std::vector<Discretisation> meshes =
      scene.discretisation ? refinements_to(*scene.discretisation) : mesh_sequence(scene.geometry);
  return answer_within({scene.tolerance, meshes, scene.progress}, [&](const Discretisation& mesh) {
    SceneAnswer on_mesh;
    on_mesh.discretisation = mesh;
    analysis.run(scene, on_mesh);
    mark_wanted(scene, on_mesh);
    return on_mesh;
  });
}

}  // namespace viscard
