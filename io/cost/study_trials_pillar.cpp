#include "io/cost/study_trials.h"
#include "models/maths/text_of_number.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/error_control.h"
#include "models/pillar/plan/effects.h"
#include "models/pillar/plan/plan.h"
#include "models/pillar/plan/relaxed_modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace viscard {
namespace {

// A row to come: a scene as it is solved, and its mesh.
struct Trial {
  std::string discretisation, effects;
  Scene scene;
  Discretisation mesh;
};

SceneAnswer run_on(const Scene& scene, const Discretisation& mesh) {
  SceneAnswer answer;
  answer.discretisation = mesh;
  analysis_of(scene.kind).run(scene, answer);
  if (scene.kind == AnalysisKind::kModal) relax_modes(scene, answer);
  for (SceneResult& result : answer.results) result.is_wanted = asks_for(scene, result.name);
  return answer;
}

Discretisation graded(const Scene& scene, int degree, int layers) {
  Discretisation mesh = mesh_sequence(scene.geometry).front();
  mesh.degree = degree;
  mesh.layers = layers;
  return mesh;
}

std::string graded_name(const Discretisation& mesh) {
  return fmt::format("graded p{}, {}", mesh.degree,
                     counted(static_cast<std::size_t>(mesh.layers), "layer"));
}

// Cheap meshes first, so that a short budget still shows something of each kind.
std::vector<Trial> mesh_trials(const Scene& scene) {
  std::vector<Trial> trials;
  for (const auto& [degree, layers] : {std::pair{2, 1}, {3, 1}, {4, 2}, {5, 2}, {6, 3}, {7, 3}}) {
    const Discretisation mesh = graded(scene, degree, layers);
    trials.push_back({graded_name(mesh), "all on", scene, mesh});
  }
  for (int degree = 2; degree <= 8; ++degree) {
    Discretisation mesh = graded(scene, degree, 1);
    mesh.uniform_m = 0.5 * scene.geometry.diameter_m;  // one element across the radius
    trials.push_back({fmt::format("p{}", degree), "all on", scene, mesh});
  }
  // The sizes of the seed's study of a pillar of 40 um: a fourth, an eighth and a fortieth of it.
  for (const int degree : {1, 2}) {
    for (const int across : {4, 8, 40}) {
      Discretisation mesh = graded(scene, degree, 1);
      mesh.uniform_m = scene.geometry.diameter_m / across;
      trials.push_back(
          {fmt::format("h{} {:g} um", degree, mesh.uniform_m * 1e6), "all on", scene, mesh});
    }
  }
  return trials;
}

Scene with_all_on(const Scene& scene) {
  return plan_effects(with_all_effects_on(scene)).reduced;
}

std::vector<Trial> effect_trials(const Scene& scene, const Discretisation& mesh) {
  std::vector<Trial> trials;
  const std::string name = graded_name(mesh);
  for (const Effect& effect : effects()) {
    if (effect.leave_out == nullptr) continue;
    const EffectEstimate estimate = effect.estimate(scene);
    if (estimate.role != EffectRole::kOptional || estimate.error == 0.0) continue;
    Trial trial{name, std::string("without ") + effect.name, with_all_on(scene), mesh};
    effect.leave_out(trial.scene);
    if (!trial.scene.film) trial.mesh.film_elements = 1;
    trials.push_back(trial);
  }
  return trials;
}

// Fewer terms of the Prony series, the strongest kept; and coarser steps in time.
std::vector<Trial> time_trials(const Scene& scene, const Discretisation& mesh) {
  std::vector<Trial> trials;
  if (scene.history.empty()) return trials;
  const std::string name = graded_name(mesh);
  std::vector<MaterialTerm> strongest = scene.pillar.terms;
  std::sort(strongest.begin(), strongest.end(),
            [](const MaterialTerm& a, const MaterialTerm& b) { return a.g > b.g; });
  for (std::size_t count = 1; count < strongest.size(); ++count) {
    Trial trial{name, fmt::format("{} of {} Prony terms", count, strongest.size()),
                with_all_on(scene), mesh};
    trial.scene.pillar.terms.assign(strongest.begin(),
                                    strongest.begin() + static_cast<std::ptrdiff_t>(count));
    trials.push_back(trial);
  }
  for (const double tolerance : {1e-1, 1e-2, 1e-3, 1e-4}) {
    Trial trial{fmt::format("{}, steps to {:g}", name, 0.1 * tolerance), "all on",
                with_all_on(scene), mesh};
    trial.scene.tolerance = tolerance;
    trials.push_back(trial);
  }
  return trials;
}

// Time steps of a reference: far below the tolerance, and not finer than they can show.
double step_tolerance(const Scene& scene) {
  const bool moves =
      scene.kind == AnalysisKind::kHarmonic || scene.kind == AnalysisKind::kTransient;
  return moves ? 0.05 * scene.tolerance : std::min(1e-6, scene.tolerance);
}

}  // namespace

CostTrials trials_of(const Scene& scene) {
  refuse_beyond_buckling(scene);
  const ScenePlan plan = plan_effects(scene);
  Scene all_on = with_all_on(scene);
  Scene fine = all_on;
  fine.tolerance = step_tolerance(scene);
  CostTrials trials{[=] { return run_on(fine, graded(fine, 9, 4)); },
                    [=] { return run_on(fine, graded(fine, 8, 4)); },
                    {}};
  all_on.tolerance = std::max(1e-5, fine.tolerance);
  std::vector<Trial> rows = mesh_trials(all_on);
  const Discretisation usual = graded(all_on, 5, 2);
  for (Trial& trial : effect_trials(scene, usual)) rows.push_back(trial);
  for (Trial& trial : time_trials(scene, usual)) rows.push_back(trial);
  rows.push_back({"graded p5, 2 layers", "as planned", plan.reduced, usual});
  for (const Trial& row : rows) {
    trials.rows.push_back(
        {row.discretisation, row.effects, row.mesh, [row] { return run_on(row.scene, row.mesh); }});
  }
  return trials;
}

}  // namespace viscard
