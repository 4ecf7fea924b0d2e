#pragma once

#include "io/flow/design/requirement_kinds.h"
#include "models/scene/scene.h"

namespace viscard {

// A formula for the quantity of a requirement, up to a factor: what the optimiser looks at first, and what
// its models are corrected from (README.md has the sources). Exact for those quantities that cost nothing;
// 1 where there is no formula. Not positive or not finite where there is no such scene.
double cheap_value(const RequirementKind& kind, const Scene& scene,
                   const Requirements& requirements);

}  // namespace viscard
