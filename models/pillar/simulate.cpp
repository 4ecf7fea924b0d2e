#include "models/pillar/analysis.h"
#include "models/pillar/error_control.h"
#include "models/pillar/pillar_modes.h"

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
    throw std::runtime_error(
        "a pressure of " + std::to_string(largest_Pa) +
        " Pa is beyond the buckling pressure of about " + std::to_string(critical_Pa) +
        " Pa: the straight pillar gives way sideways. Reduce the load, or make the "
        "pillar shorter or thicker");
  }
}

std::vector<SceneEffect> effects_of(const Scene& scene) {
  const bool in_time =
      scene.kind == AnalysisKind::kCreep || scene.kind == AnalysisKind::kRelaxation;
  const bool modal = scene.kind == AnalysisKind::kModal;
  return {{"relaxation", in_time && !scene.pillar.terms.empty(),
           in_time ? "the analysis is in time"
                   : "static and modal answers use the instantaneous moduli"},
          {"inertia", modal, modal ? "modal analysis" : "the analysis is quasi-static"},
          {"incompressibility", scene.pillar.nu >= kNearlyIncompressible,
           "pressures are condensed from a Poisson ratio of 0.45 on"},
          {"film_compliance", scene.film.has_value(),
           scene.film ? "the scene has a film" : "the base is rigid"},
          {"piezo_coupling", scene.electrodes && scene.kind == AnalysisKind::kStatic,
           scene.electrodes ? "the film has electrodes; both ways" : "no electrode"},
          {"geometric_stiffness",
           scene.kind == AnalysisKind::kBuckling || (modal && scene.pressure_Pa != 0.0),
           "buckling, and modes under a pressure"}};
}

}  // namespace

SceneAnswer simulate(const Scene& scene) {
  validate(scene);
  refuse_buckled(scene);
  const Analysis& analysis = analysis_of(scene.kind);
  SceneAnswer answer =
      answer_within({scene.tolerance, mesh_sequence(scene.geometry), scene.progress},
                    [&](const Discretisation& mesh) {
                      SceneAnswer on_mesh;
                      on_mesh.discretisation = mesh;
                      analysis.run(scene, on_mesh);
                      return on_mesh;
                    });
  answer.effects = effects_of(scene);
  return answer;
}

}  // namespace viscard
