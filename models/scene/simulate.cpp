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

// A function of each kind of scene.
template <typename... Kinds>
struct OfKind : Kinds... {
  using Kinds::operator()...;
};

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
  SceneAnswer answer =
      std::visit(OfKind{[](const PillarScene& one) { return simulate_pillar(one); },
                        [](const ArrayScene& row) { return simulate_array(row); },
                        [](const SpaceScene& array) { return simulate_space(array); },
                        [](const LayerScene& layer) { return simulate_layer(layer); }},
                 plan.reduced);
  const std::string in_creep = creep_buckling_note(scene);
  if (!in_creep.empty()) answer.notes.push_back(in_creep);
  const std::string at_once = at_once_note(scene, plan.reduced);
  if (!at_once.empty()) answer.notes.push_back(at_once);
  report_left_out({plan.effects, plan.left_out}, common(scene).tolerance, answer);
  require_tolerance(common(scene).tolerance, answer);
  return answer;
}

SceneAnswer answer_on(const Scene& scene, const Discretisation& mesh) {
  return std::visit(OfKind{[&](const PillarScene& one) { return pillar_answer_on(one, mesh); },
                           [&](const ArrayScene& row) { return array_answer_on(row, mesh); },
                           [&](const SpaceScene& array) { return space_answer_on(array, mesh); },
                           [&](const LayerScene& layer) { return layer_answer_on(layer, mesh); }},
                    scene);
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
