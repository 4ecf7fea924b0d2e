#include "io/cost/study_trials.h"

#include "models/maths/text_of_number.h"
#include "models/pillar/analyses/analysis.h"
#include "models/scene/effects.h"
#include "models/scene/plan.h"
#include "models/scene/simulate.h"

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

constexpr const char* kGraded = "graded p";

std::string kind_of_mesh(const std::string& discretisation) {
  if (discretisation.rfind(kGraded, 0) == 0) return kGraded;
  return discretisation.substr(0, discretisation[0] == 'p' ? 1 : 2);  // "p", "h1", "h2"
}

CostTrial trial_from(const Trial& row, const std::string& kind) {
  return {.discretisation = row.discretisation,
          .effects = row.effects,
          .mesh = row.mesh,
          .run = [row] { return answer_on(row.scene, row.mesh); },
          .kind = kind,
          .size = mesh_size(row.scene, row.mesh)};
}

std::string graded_name(const Discretisation& mesh) {
  return fmt::format("graded p{}, {}", mesh.degree,
                     counted(static_cast<std::size_t>(mesh.layers), "layer"));
}

// Cheap meshes first, so that a short budget still shows something of each kind.
std::vector<Trial> mesh_trials(const Scene& scene) {
  const CostMeshes meshes = cost_meshes(scene);
  std::vector<Trial> trials;
  for (const auto& [degree, layers] : meshes.graded) {
    const Discretisation mesh = graded_mesh(scene, degree, layers);
    trials.push_back({graded_name(mesh), "all on", scene, mesh});
  }
  for (int degree = 2; degree <= meshes.highest_uniform; ++degree) {
    Discretisation mesh = uniform_mesh(scene, degree);
    mesh.uniform_m = 0.5 * meshes.diameter_m;  // one element across the radius
    trials.push_back({fmt::format("p{}", degree), "all on", scene, mesh});
  }
  if (meshes.highest_uniform == 0) return trials;
  // A fourth, an eighth and a fortieth of the diameter: 10, 5 and 1 um for pillars of 40 um.
  for (const int degree : {1, 2}) {
    for (const int across : {4, 8, 40}) {
      Discretisation mesh = uniform_mesh(scene, degree);
      mesh.uniform_m = meshes.diameter_m / across;
      trials.push_back(
          {fmt::format("h{} {:g} um", degree, mesh.uniform_m * 1e6), "all on", scene, mesh});
    }
  }
  return trials;
}

Scene with_all_on(const Scene& scene) {
  return plan_effects(with_all_effects_on(scene)).reduced;
}

// One row for each effect that the plan might leave out.
template <typename Body>
std::vector<Trial> effect_trials(const Body& scene, const Discretisation& mesh) {
  std::vector<Trial> trials;
  for (const Effect& effect : effects()) {
    const EffectOn<Body>& on = effect_on<Body>(effect);
    if (on.leave_out == nullptr) continue;
    const EffectEstimate estimate = on.estimate(scene);
    if (estimate.role != EffectRole::kOptional || estimate.error == 0.0) continue;
    Body without = std::get<Body>(with_all_on(scene));
    on.leave_out(without);
    trials.push_back({graded_name(mesh), effect.name, without, mesh_without_effect(without, mesh)});
  }
  return trials;
}

// Fewer terms of the Prony series, the strongest kept; and coarser steps in time.
std::vector<Trial> time_trials(const Scene& scene, const Discretisation& mesh) {
  std::vector<Trial> trials;
  if (!cost_meshes(scene).takes_time_steps) return trials;
  const std::string name = graded_name(mesh);
  std::vector<MaterialTerm> strongest = common(scene).pillar.terms;
  std::sort(strongest.begin(), strongest.end(),
            [](const MaterialTerm& a, const MaterialTerm& b) { return a.g > b.g; });
  for (std::size_t count = 1; count < strongest.size(); ++count) {
    Trial trial{name, fmt::format("{} of {} Prony terms", count, strongest.size()),
                with_all_on(scene), mesh};
    common(trial.scene)
        .pillar.terms.assign(strongest.begin(),
                             strongest.begin() + static_cast<std::ptrdiff_t>(count));
    trials.push_back(trial);
  }
  for (const double tolerance : {1e-1, 1e-2, 1e-3, 1e-4}) {
    Trial trial{fmt::format("{}, steps to {:g}", name, 0.1 * tolerance), "all on",
                with_all_on(scene), mesh};
    common(trial.scene).tolerance = tolerance;
    trials.push_back(trial);
  }
  return trials;
}

// Degrees of the references; the coarsest is for budgets that allow no more.
constexpr int kCoarsestReference = 3;
constexpr int kFinestReference = 9;

}  // namespace

CostTrials trials_of(const Scene& scene) {
  const ScenePlan plan = checked_plan(scene);
  const CostMeshes meshes = cost_meshes(scene);
  Scene all_on = with_all_on(scene);
  Scene fine = all_on;
  common(fine).tolerance = meshes.step_tolerance;
  CostTrials trials;
  trials.tolerance = common(scene).tolerance;
  for (int degree = kCoarsestReference; degree <= kFinestReference; ++degree) {
    const Discretisation mesh = graded_mesh(fine, degree, meshes.reference_layers);
    const bool is_known =
        !trials.references.empty() && trials.references.back().discretisation == graded_name(mesh);
    if (is_known) continue;  // some scenes have fewer meshes; a mesh is no judge of itself
    trials.references.push_back(trial_from({graded_name(mesh), "all on", fine, mesh}, "reference"));
  }
  common(all_on).tolerance = meshes.row_tolerance;
  std::vector<Trial> rows = mesh_trials(all_on);
  const Discretisation usual = graded_mesh(all_on, 5, 2);
  const auto append = [&](std::vector<Trial> more) {
    rows.insert(rows.end(), more.begin(), more.end());
  };
  std::vector<Trial> of_effects =
      std::visit([&](const auto& body) { return effect_trials(body, usual); }, scene);
  for (Trial& one : of_effects) one.effects = "without " + one.effects;
  append(std::move(of_effects));
  append(time_trials(scene, usual));
  rows.push_back({graded_name(usual), "as planned", plan.reduced, usual});
  for (const Trial& row : rows) {
    trials.rows.push_back(trial_from(row, kind_of_mesh(row.discretisation)));
  }
  return trials;
}

std::vector<CostTrial> effect_trials_on(const Scene& scene, int degree, int layers) {
  const Scene all_on = with_all_on(scene);
  const Discretisation mesh = graded_mesh(all_on, degree, layers);
  std::vector<CostTrial> trials{trial_from({graded_name(mesh), "all on", all_on, mesh}, kGraded)};
  const std::vector<Trial> without =
      std::visit([&](const auto& body) { return effect_trials(body, mesh); }, scene);
  for (const Trial& one : without) trials.push_back(trial_from(one, kGraded));
  return trials;
}

}  // namespace viscard
