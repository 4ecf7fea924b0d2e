#include "models/scene/simulate.h"

#include "models/array/plane/simulate_array.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/simulate_pillar.h"
#include "models/scene/common/effect_budget.h"
#include "models/scene/plan.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

namespace viscard {
namespace {

// What each kind of scene does, under one name.
SceneAnswer solve(const PillarScene& scene) {
  return simulate_pillar(scene);
}
SceneAnswer solve(const ArrayScene& scene) {
  return simulate_array(scene);
}

SceneAnswer solve_on(const PillarScene& scene, const Discretisation& mesh) {
  return pillar_answer_on(scene, mesh);
}
SceneAnswer solve_on(const ArrayScene& scene, const Discretisation& mesh) {
  return array_answer_on(scene, mesh);
}

void finish(const PillarScene& scene, SceneAnswer& answer) {
  finish_pillar(scene, answer);
}
void finish(const ArrayScene&, SceneAnswer&) {}

std::vector<SectionGrid> fields_on(const PillarScene& scene, const Discretisation& mesh) {
  const Analysis& analysis = analysis_of(scene);
  return analysis.fields == nullptr ? std::vector<SectionGrid>() : analysis.fields(scene, mesh);
}
std::vector<SectionGrid> fields_on(const ArrayScene&, const Discretisation&) {
  return {};
}

}  // namespace

SceneAnswer simulate(const Scene& scene) {
  const ScenePlan plan = plan_effects(scene);
  SceneAnswer answer = std::visit(
      [](const auto& reduced) {
        SceneAnswer solved = solve(reduced);
        finish(reduced, solved);
        return solved;
      },
      plan.reduced);
  report_left_out({plan.effects, plan.left_out}, common(scene).tolerance, answer);
  return answer;
}

SceneAnswer answer_on(const Scene& scene, const Discretisation& mesh) {
  return std::visit(
      [&](const auto& body) {
        SceneAnswer answer = solve_on(body, mesh);
        finish(body, answer);
        return answer;
      },
      scene);
}

std::vector<SectionGrid> solution_fields(const Scene& scene, const Discretisation& mesh) {
  const ScenePlan plan = plan_effects(scene);
  return std::visit([&](const auto& reduced) { return fields_on(reduced, mesh); }, plan.reduced);
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
    const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
    for (std::size_t k = 1; k < std::min(cores, points.size()); ++k) threads.emplace_back(work);
    work();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace viscard
