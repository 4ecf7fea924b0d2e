#include "io/cost/study_trials.h"
#include "models/array/plane/array_plan.h"
#include "models/maths/text_of_number.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace viscard {
namespace {

Discretisation graded(const ArrayScene& scene, int degree, int layers) {
  Discretisation mesh = array_meshes(scene).front();
  mesh.degree = degree;
  // An electrode's edge takes as many layers as the degree (array_meshes()).
  mesh.layers = scene.electrodes.is_equipotential ? std::max(degree, layers) : layers;
  return mesh;
}

CostTrial trial(std::string mesh_name, std::string effects, const ArrayScene& scene,
                const Discretisation& mesh) {
  return {std::move(mesh_name), std::move(effects), mesh,
          [scene, mesh] { return array_answer_on(scene, mesh); }};
}

std::string graded_name(const Discretisation& mesh) {
  return fmt::format("graded p{}, {}", mesh.degree,
                     counted(static_cast<std::size_t>(mesh.layers), "layer"));
}

ArrayScene with_all_on(const ArrayScene& scene) {
  return plan_effects(with_all_effects_on(scene)).reduced;
}

void add_meshes(const ArrayScene& all_on, std::vector<CostTrial>& rows) {
  for (const auto& [degree, layers] : {std::pair{2, 1}, {3, 2}, {4, 2}, {5, 2}, {6, 3}, {7, 3}}) {
    const Discretisation mesh = graded(all_on, degree, layers);
    rows.push_back(trial(graded_name(mesh), "all on", all_on, mesh));
  }
  Discretisation uniform = graded(all_on, 2, 1);
  uniform.uniform_m = 0.5 * all_on.geometry.diameter_m;
  for (int degree = 2; degree <= 7; ++degree) {
    uniform.degree = degree;
    rows.push_back(trial(fmt::format("p{}", degree), "all on", all_on, uniform));
  }
  // A fourth, an eighth and a fortieth of the diameter: 10, 5 and 1 um for pillars of 40 um.
  for (const int degree : {1, 2}) {
    for (const int across : {4, 8, 40}) {
      uniform.degree = degree;
      uniform.uniform_m = all_on.geometry.diameter_m / across;
      rows.push_back(trial(fmt::format("h{} {:g} um", degree, uniform.uniform_m * 1e6), "all on",
                           all_on, uniform));
    }
  }
}

void add_effects(const ArrayScene& scene, const Discretisation& mesh,
                 std::vector<CostTrial>& rows) {
  const ArrayScene all = with_all_effects_on(scene);
  for (const SceneEffect& effect : plan_effects(all).effects) {
    if (!effect.on || !effect.is_forced) continue;
    ArrayScene without = all;
    without.effects[effect.name] = EffectChoice::kOff;
    rows.push_back(
        trial(graded_name(mesh), "without " + effect.name, plan_effects(without).reduced, mesh));
  }
  rows.push_back(trial(graded_name(mesh), "as planned", plan_effects(scene).reduced, mesh));
}

}  // namespace

CostTrials trials_of(const ArrayScene& scene) {
  const ArrayScene all_on = with_all_on(scene);
  const auto on = [&](int degree, int layers) {
    return
        [all_on, mesh = graded(all_on, degree, layers)] { return array_answer_on(all_on, mesh); };
  };
  CostTrials trials{on(9, 5), on(8, 5), {}};
  add_meshes(all_on, trials.rows);
  add_effects(scene, graded(all_on, 5, 2), trials.rows);
  return trials;
}

}  // namespace viscard
