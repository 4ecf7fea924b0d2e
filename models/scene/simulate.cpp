#include "models/scene/simulate.h"

#include "models/answer/effect_estimate.h"
#include "models/array/layer/simulate_layer.h"
#include "models/array/plane/simulate_array.h"
#include "models/array/space/simulate_space.h"
#include "models/maths/usable_machine.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/large_strain.h"
#include "models/pillar/analyses/simulate_pillar.h"
#include "models/scene/plan.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

namespace viscard {
namespace {

// The functions of each kind of scene under one name.
SceneAnswer solve(const PillarScene& scene) {
  return simulate_pillar(scene);
}
SceneAnswer solve(const ArrayScene& scene) {
  return simulate_array(scene);
}
SceneAnswer solve(const SpaceScene& scene) {
  return simulate_space(scene);
}
SceneAnswer solve(const LayerScene& scene) {
  return simulate_layer(scene);
}

SceneAnswer solve_on(const PillarScene& scene, const Discretisation& mesh) {
  return pillar_answer_on(scene, mesh);
}
SceneAnswer solve_on(const ArrayScene& scene, const Discretisation& mesh) {
  return array_answer_on(scene, mesh);
}
SceneAnswer solve_on(const SpaceScene& scene, const Discretisation& mesh) {
  return space_answer_on(scene, mesh);
}
SceneAnswer solve_on(const LayerScene& scene, const Discretisation& mesh) {
  return layer_answer_on(scene, mesh);
}

// The same of other kinds of scenes is empty.
std::string at_once_note(const Scene& scene, const Scene& reduced) {
  const auto* pillar = std::get_if<PillarScene>(&scene);
  return pillar == nullptr ? "" : at_once_note(*pillar, std::get<PillarScene>(reduced));
}

}  // namespace

SceneAnswer simulate(const Scene& scene) {
  if (common(scene).progress) common(scene).progress(0.0, "which effects count");
  const ScenePlan plan = plan_effects(scene);
  refuse_buckling_in_creep(scene);  // the plan may leave relaxation out
  SceneAnswer answer = std::visit([](const auto& body) { return solve(body); }, plan.reduced);
  const std::string in_creep = creep_buckling_note(scene);
  if (!in_creep.empty()) answer.notes.push_back(in_creep);
  const std::string at_once = at_once_note(scene, plan.reduced);
  if (!at_once.empty()) answer.notes.push_back(at_once);
  report_left_out({plan.effects, plan.left_out}, common(scene).tolerance, answer);
  require_tolerance(common(scene).tolerance, answer);
  return answer;
}

SceneAnswer answer_on(const Scene& scene, const Discretisation& mesh) {
  return std::visit([&](const auto& body) { return solve_on(body, mesh); }, scene);
}

std::function<std::optional<SceneAnswer>(const Scene&)> first_order_answers(
    const Scene& scene, const Discretisation& mesh) {
  const auto* pillar = std::get_if<PillarScene>(&scene);
  if (pillar == nullptr) return {};
  const FirstOrderAnswers answers = first_order_answers(*pillar, mesh);
  if (!answers) return {};
  return [answers](const Scene& close) { return answers(std::get<PillarScene>(close)); };
}

std::vector<SectionGrid> solution_fields(const Scene& scene, const Discretisation& mesh) {
  const ScenePlan plan = plan_effects(scene);
  const auto* pillar = std::get_if<PillarScene>(&plan.reduced);
  if (pillar == nullptr || analysis_of(*pillar).fields == nullptr) return {};
  return analysis_of(*pillar).fields(*pillar, mesh);
}

RowShapes mode_shapes(const Scene& scene, const Discretisation& mesh) {
  const ScenePlan plan = plan_effects(scene);
  const auto* row = std::get_if<ArrayScene>(&plan.reduced);
  if (row == nullptr || !std::holds_alternative<RowModal>(row->drive)) return {};
  return row_shapes(*row, mesh);
}

void simulate_all(const std::vector<Scene>& points,
                  const std::function<void(std::size_t, const SceneAnswer&)>& done) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex mutex;
  const auto work = [&] {
    for (std::size_t i = next++; i < points.size(); i = next++) {
      try {
        const SceneAnswer answer = simulate(points[i]);
        const std::lock_guard<std::mutex> lock(mutex);
        if (!failure) done(i, answer);
      } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex);
        if (!failure) failure = std::current_exception();
        next = points.size();
      }
    }
  };
  {
    std::vector<std::jthread> threads;
    const std::size_t cores = std::min(usable_cores(), points.size());
    for (std::size_t k = 1; k < cores; ++k) threads.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace viscard
