#include "io/flow/optimise/nearby_answers.h"

#include "io/flow/scenes/uncertain_scene.h"
#include "models/scene/plan.h"

#include <algorithm>
#include <utility>

namespace viscard {
namespace {

Scene reduced_with(Scene scene, const EffectChoices& choices) {
  common(scene).effects = choices;
  return plan_effects(scene).reduced;
}

}  // namespace

SceneAnswer NearbyAnswers::kept(const Scene& scene) {
  SceneAnswer answer = simulate(scene);
  Solved solved;
  solved.choices = chosen_effects(scene);
  solved.first_order =
      first_order_answers(reduced_with(scene, solved.choices), answer.discretisation);
  solved_.push_back(std::move(solved));
  return answer;
}

SceneSolver NearbyAnswers::keep() {
  return [this](const Scene& scene) { return kept(scene); };
}

SceneSolver NearbyAnswers::nearby() const {
  return [this, next = std::size_t{0}](const Scene& scene) mutable {
    const std::size_t at = next++;
    if (at < solved_.size() && solved_[at].first_order) {
      const auto answer = solved_[at].first_order(reduced_with(scene, solved_[at].choices));
      if (answer) return *answer;
    }
    return simulate(scene);
  };
}

bool NearbyAnswers::has_any() const {
  return std::any_of(solved_.begin(), solved_.end(),
                     [](const Solved& one) { return static_cast<bool>(one.first_order); });
}

}  // namespace viscard
