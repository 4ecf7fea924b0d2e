#pragma once

#include "io/flow/optimise/confirm_design.h"
#include "io/flow/optimise/design_spec.h"

#include <functional>
#include <optional>
#include <string>

namespace viscard {

// A limit on the second objective, for a point of the front.
struct ObjectiveBound {
  double log_limit = 0.0;
};

struct OptimiseOptions {
  std::function<void(double, const std::string&)> progress;  // fraction done; may be empty
  std::optional<ObjectiveBound> second;  // keep the second objective within this
  std::size_t objective = 0;             // which objective is sought
};

// The best design of a specification: formulas over all ranges first, then steps on models of the solver's values
// (README.md), at last judge_scene(). The same specification and seed give the same design. Throws std::runtime_error
// if a requirement is not answered anywhere that was tried, or probabilities are asked of a scene without
// uncertainties.
OptimisedDesign optimise_design(const DesignSpec& spec, const OptimiseOptions& options);

}  // namespace viscard
