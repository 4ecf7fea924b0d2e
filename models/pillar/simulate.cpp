#include "models/pillar/analysis.h"
#include "models/pillar/effects.h"
#include "models/pillar/error_control.h"
#include "models/pillar/pillar_modes.h"
#include "models/pillar/scene_mistake.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace viscard {
namespace {

double largest_push_Pa(const Scene& scene) {
  double largest_Pa = scene.pressure_Pa;
  if (scene.kind == AnalysisKind::kCreep) {
    for (const HistoryPoint& point : scene.history) largest_Pa = std::max(largest_Pa, point.value);
  }
  return largest_Pa;
}

// Infinite for a pillar so stubby that nothing but the bond's rim gives way.
double buckling_pressure_Pa(const Scene& scene) {
  const Discretisation mesh = mesh_sequence(scene.geometry)[1];
  const PillarModel axial(scene.geometry, mesh, media_of(scene), {.motion = Motion::kLongitudinal});
  const PillarModel lateral(scene.geometry, mesh, media_of(scene), {.motion = Motion::kLateral});
  try {
    return buckling(axial, lateral).pressure_Pa;
  } catch (const std::runtime_error&) {
    return std::numeric_limits<double>::infinity();
  }
}

// Errors are watched only of what is asked for.
void mark_wanted(const Scene& scene, SceneAnswer& answer) {
  for (SceneResult& r : answer.results) r.is_wanted = asks_for(scene, r.name);
}

}  // namespace

void refuse_beyond_buckling(const Scene& scene) {
  if (scene.kind == AnalysisKind::kBuckling || is_sideways(scene)) return;
  const double largest_Pa = largest_push_Pa(scene);
  const double slenderness = scene.geometry.diameter_m / scene.geometry.length_m;
  const double pi = std::numbers::pi;
  const double euler_Pa = pi * pi / 64.0 * scene.pillar.E0_Pa * slenderness * slenderness;
  if (largest_Pa < 0.5 * euler_Pa) return;
  const double critical_Pa =
      scene.plane ? engesser_pressure_Pa(scene) : buckling_pressure_Pa(scene);
  if (largest_Pa < critical_Pa) return;
  char text[200];
  std::snprintf(text, sizeof text,
                "a pressure of %.5g Pa is beyond the buckling pressure of about %.5g Pa: the "
                "straight pillar gives way sideways. Reduce the load, or make the pillar shorter "
                "or thicker",
                largest_Pa, critical_Pa);
  throw SceneMistake(
      scene.kind == AnalysisKind::kCreep ? "analysis.history" : "analysis.load.pressure", text);
}

SceneAnswer simulate(const Scene& scene) {
  validate(scene);
  refuse_beyond_buckling(scene);
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
