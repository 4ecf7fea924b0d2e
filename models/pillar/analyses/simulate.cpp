#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/error_control.h"
#include "models/pillar/analyses/top_load.h"
#include "models/pillar/body/pillar_modes.h"
#include "models/pillar/mesh/number_text.h"
#include "models/pillar/mesh/scene_mistake.h"
#include "models/pillar/plan/effects.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

namespace viscard {
namespace {

double largest_push_Pa(const Scene& scene) {
  // What oscillates pushes half of the time, whatever its sign.
  const bool oscillates = scene.kind == AnalysisKind::kHarmonic;
  double largest_Pa = oscillates ? std::abs(scene.pressure_Pa) : scene.pressure_Pa;
  if (scene.kind == AnalysisKind::kCreep) {
    for (const HistoryPoint& point : scene.history) largest_Pa = std::max(largest_Pa, point.value);
  }
  return largest_Pa;
}

// Infinite for a pillar so stubby that nothing but the bond's rim gives way.
double buckling_pressure_Pa(const PillarModel& axial, const PillarModel& lateral) {
  try {
    return buckling(axial, lateral).pressure_Pa;
  } catch (const std::runtime_error&) {
    return std::numeric_limits<double>::infinity();
  }
}

double buckling_pressure_Pa(const Scene& scene) {
  const Discretisation mesh = mesh_sequence(scene.geometry)[1];
  const PillarModel axial(scene.geometry, mesh, media_of(scene), {.motion = Motion::kLongitudinal});
  const PillarModel lateral(scene.geometry, mesh, media_of(scene), {.motion = Motion::kLateral});
  return buckling_pressure_Pa(axial, lateral);
}

// How far a plate can press the top down before the pillar buckles below it.
double buckling_shortening_m(const Scene& scene) {
  const Discretisation mesh = mesh_sequence(scene.geometry)[1];
  const PillarModel axial(scene.geometry, mesh, media_of(scene),
                          {.motion = Motion::kLongitudinal, .rigid_top = true});
  const PillarModel lateral(scene.geometry, mesh, media_of(scene),
                            {.motion = Motion::kLateral, .rigid_top = true});
  const Eigen::VectorXd traction = axial.top_traction();
  const double shortening_m_Pa =
      traction.dot(axial.solve(traction).unknowns) / traction.sum();  // at 1 Pa
  return shortening_m_Pa * buckling_pressure_Pa(axial, lateral);
}

// A plate holds the top upright, so that the pillar buckles between the two.
std::string beyond_buckling_under_plate(const Scene& scene) {
  const double rough_m = engesser_pressure_Pa(scene) / scene.pillar.E0_Pa * scene.geometry.length_m;
  if (-*scene.displacement_m < 0.5 * rough_m) return "";
  const double most_m = scene.plane ? rough_m : buckling_shortening_m(scene);
  if (-*scene.displacement_m < most_m) return "";
  return "a displacement of " + number_text(*scene.displacement_m * 1e6, 5) +
         " um is beyond about " + number_text(-most_m * 1e6, 3) +
         " um, where the pillar buckles between its foot and the plate on its top";
}

// "" while the straight pillar can bear the load.
std::string beyond_buckling(const Scene& scene) {
  const bool is_axial = scene.direction == LoadDirection::kAxial;
  if (scene.kind == AnalysisKind::kBuckling || !is_axial) return "";
  if (moves_top(scene)) return beyond_buckling_under_plate(scene);
  const double largest_Pa = largest_push_Pa(scene);
  const double slenderness = scene.geometry.diameter_m / scene.geometry.length_m;
  const double pi = std::numbers::pi;
  const double euler_Pa = pi * pi / 64.0 * scene.pillar.E0_Pa * slenderness * slenderness;
  if (largest_Pa < 0.5 * euler_Pa) return "";
  const double critical_Pa =
      scene.plane ? engesser_pressure_Pa(scene) : buckling_pressure_Pa(scene);
  if (largest_Pa < critical_Pa) return "";
  return "a pressure of " + number_text(largest_Pa, 5) +
         " Pa is beyond the buckling pressure of about " + number_text(critical_Pa, 5) +
         " Pa: the straight pillar gives way sideways";
}

// The scene itself says that its pillar is to stay straight.
bool holds_straight(const Scene& scene) {
  const auto forced = scene.effects.find("geometric_stiffness");
  return forced != scene.effects.end() && forced->second == EffectChoice::kOff;
}

// Errors are watched only of what is asked for.
void mark_wanted(const Scene& scene, SceneAnswer& answer) {
  for (SceneResult& r : answer.results) r.is_wanted = asks_for(scene, r.name);
}

}  // namespace

void refuse_beyond_buckling(const Scene& scene) {
  if (holds_straight(scene)) return;
  const std::string why = beyond_buckling(scene);
  if (why.empty()) return;
  throw SceneMistake(
      scene.kind == AnalysisKind::kCreep ? "analysis.history"
      : moves_top(scene)                 ? "analysis.load.displacement"
                                         : "analysis.load",
      why +
          ". Reduce the load, make the pillar shorter or thicker, or say that it is held "
          "straight (geometric_stiffness = \"off\" under [effects])");
}

SceneAnswer simulate(const Scene& scene) {
  validate(scene);
  refuse_beyond_buckling(scene);
  const Analysis& analysis = analysis_of(scene.kind);
  const std::vector<Discretisation> meshes =
      scene.discretisation ? refinements_to(*scene.discretisation) : mesh_sequence(scene.geometry);
  const double share_left = scene.kind == AnalysisKind::kBuckling
                                ? ErrorControl::kShareLeftInBuckling
                                : ErrorControl::kShareLeft;
  SceneAnswer answer = answer_within({scene.tolerance, meshes, scene.progress, share_left},
                                     [&](const Discretisation& mesh) {
                                       SceneAnswer on_mesh;
                                       on_mesh.discretisation = mesh;
                                       analysis.run(scene, on_mesh);
                                       mark_wanted(scene, on_mesh);
                                       return on_mesh;
                                     });
  const std::string why = holds_straight(scene) ? beyond_buckling(scene) : "";
  if (!why.empty()) {
    answer.notes.push_back(why + ", unless it is held straight, as the scene says it is");
  }
  return answer;
}

}  // namespace viscard
