#include "models/pillar/analyses/simulate_pillar.h"

#include "models/maths/text_of_number.h"
#include "models/pillar/analyses/air_damping.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/buckling_limit.h"
#include "models/pillar/analyses/large_strain.h"
#include "models/pillar/analyses/near_incompressible.h"
#include "models/pillar/analyses/top_load.h"
#include "models/pillar/mesh/pillar_mesh.h"

#include <memory>
#include <optional>

namespace viscard {
namespace {

// At the edge of an electrode the potential grows as r^(1/2), so that a layer of ratio 0.15 leaves 0.15
// of the error and 0.18 of the change (share_left of error_control.h). Source: Grisvard, Elliptic
// Problems in Nonsmooth Domains (1985), 2.3.
constexpr double kShareLeftOfElectrodeEdge = 0.18;

// The edge of an electrode on a face of the film, where the potential is singular.
bool has_electrode_edge(const PillarScene& scene) {
  if (!scene.electrodes) return false;
  const double edge_m = scene.electrodes->electrode_radius_m;
  return edge_m > 0.0 && edge_m < scene.geometry.film->radius_m * (1.0 - kSameLength);
}

// A load P multiplies the bow that a pillar has by 1/(1 - P/P_cr). Source: Timoshenko & Gere, Theory of Elastic
// Stability (1961), 1.12.
constexpr double kNearBuckling = 0.5;
std::string growth_of_bow(double share) {
  return "the load is " + text_of(100.0 * share, 3) +
         " % of that at which the pillar buckles: a bow that it has is about " +
         text_of(1.0 / (1.0 - share), 2) + " times as large under it";
}

}  // namespace

SceneAnswer pillar_answer_on(const PillarScene& scene, const Discretisation& mesh) {
  if (is_near_incompressible(scene)) {
    return near_incompressible_answer(
        scene, [&](const PillarScene& end) { return pillar_answer_on(end, mesh); });
  }
  SceneAnswer answer;
  answer.discretisation = mesh;
  analysis_of(scene).run(scene, answer);
  add_air(scene, answer);
  // Only the errors of results that the scene wants are watched.
  for (SceneResult& result : answer.results) result.is_wanted = asks_for(scene, result.name);
  return answer;
}

FirstOrderAnswers first_order_answers(const PillarScene& scene, const Discretisation& mesh) {
  const Analysis& analysis = analysis_of(scene);
  // Answers near nu = 0.5 lie between those of two other scenes.
  if (analysis.solve_nearby == nullptr || is_near_incompressible(scene)) return {};
  const auto nearby = std::make_shared<const NearbyPillars>(analysis.solve_nearby(scene, mesh));
  if (nearby->empty()) return {};
  return [nearby, mesh](const PillarScene& other) -> std::optional<SceneAnswer> {
    PillarScene close = other;
    close.nearby = nearby;
    try {
      return pillar_answer_on(close, mesh);
    } catch (const NotNearby&) {
      return std::nullopt;
    }
  };
}

SceneAnswer simulate_pillar(const PillarScene& scene) {
  validate(scene);
  const double share_of_buckling = refuse_beyond_buckling(scene);
  const Analysis& analysis = analysis_of(scene);
  const bool weighs_stress =
      analysis.weighs_stress || (analysis.weighs_pressure && pressure_Pa(scene) != 0.0);
  std::vector<Discretisation> meshes = scene.discretisation
                                           ? finer_and(*scene.discretisation, scene.geometry)
                                       : weighs_stress   ? stressed_mesh_sequence(scene.geometry)
                                       : is_large(scene) ? large_mesh_sequence(scene.geometry)
                                                         : mesh_sequence(scene.geometry);
  // A shear ends at the rim of the top, where the free side bears none: the stress is logarithmic in the
  // distance, as that of a pressure on a top that turns.
  const bool is_sheared = is_lateral(scene) && load_place(scene) == LoadPlace::kTop;
  for (Discretisation& mesh : meshes) mesh.grades_top |= is_sheared && !scene.discretisation;
  const double share_left = weighs_stress               ? kShareLeftOfStress
                            : has_electrode_edge(scene) ? kShareLeftOfElectrodeEdge
                                                        : ErrorControl::kShareLeft;
  SceneAnswer answer =
      answer_within({.tolerance = scene.tolerance,
                     .meshes = meshes,
                     .progress = scene.progress,
                     .share_left = share_left,
                     .is_last_measured = scene.discretisation.has_value()},
                    [&](const Discretisation& mesh) { return pillar_answer_on(scene, mesh); });
  add_film_direction(scene, answer);
  add_air_errors(scene, answer);
  if (share_of_buckling > kNearBuckling) answer.notes.push_back(growth_of_bow(share_of_buckling));
  const std::string why = holds_straight(scene) ? buckling_share(scene).beyond : "";
  if (!why.empty()) {
    answer.notes.push_back(why + ", unless it is held straight, as the scene declares");
  }
  return answer;
}

}  // namespace viscard
