#pragma once

#include "io/flow/design/scene_solver.h"

#include <functional>
#include <optional>
#include <vector>

namespace viscard {

// The scenes that a computation solves, kept so that the same computation with quantities close to these
// takes its answers to first order from them (models/pillar/README.md, eq. 26). Scenes without such answers
// are solved.
class NearbyAnswers {
 public:
  // Answers and keeps the scenes of the computation, in their order. Must not outlive this.
  SceneSolver keep();
  // Answers those of the same computation, in the same order. To be used once, in one thread.
  SceneSolver nearby() const;
  // A scene has answers to first order.
  bool has_any() const;

 private:
  struct Solved {
    EffectChoices choices;                                                // the plan's
    std::function<std::optional<SceneAnswer>(const Scene&)> first_order;  // may be empty
  };
  SceneAnswer kept(const Scene& scene);

  std::vector<Solved> solved_;
};

}  // namespace viscard
