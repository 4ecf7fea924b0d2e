#pragma once

#include "io/flow/design/requirement_kinds.h"
#include "models/scene/scene.h"

namespace viscard {

// A formula for the quantity of a requirement, up to a factor. The optimiser starts from it, and
// its models are corrections of it (README.md has the sources). Exact for quantities that need no
// solution; 1 if there is no formula. Not positive or not finite if there is no such scene.
double cheap_value(const RequirementKind& kind, const Scene& scene,
                   const Requirements& requirements);

}  // namespace viscard
