#pragma once

#include "models/array/layer/layer_scene.h"
#include "models/array/plane/array_scene.h"
#include "models/array/space/space_scene.h"
#include "models/pillar/scene/pillar_scene.h"

#include <string>
#include <variant>
#include <vector>

namespace viscard {

// The contents of a scene file: one pillar, a row of pillars, an array in the plane, or a layer. Every kind of
// scene derives from SceneCommon, and has kKind, its word in a scene file, and kTolerances. Rows and
// arrays in the plane have the same word; geometry.model distinguishes them. A new kind is a further
// alternative here; the compiler then names every place that lacks it.
using Scene = std::variant<PillarScene, ArrayScene, SpaceScene, LayerScene>;

// What all scenes have.
SceneCommon& common(Scene& scene);
const SceneCommon& common(const Scene& scene);

const char* kind_of(const Scene& scene);  // "pillar", "array", "layer"
// The tolerances that the kind of scene supports.
const ToleranceRange& tolerances_of(const Scene& scene);

// Throws std::invalid_argument, mostly SceneMistake, naming what is missing or contradictory.
void validate(const Scene& scene);

// Throws SceneMistake if the load lies beyond buckling (models/pillar/analyses/buckling_limit.h). Rows
// and arrays are validated for that.
void refuse_beyond_buckling(const Scene& scene);

// Buckling in creep (models/pillar/analyses/creep_buckling.h): a sentence for the answer, or "";
// throws SceneMistake for a history of creep that a pillar does not bear.
std::string creep_buckling_note(const Scene& scene);
void refuse_buckling_in_creep(const Scene& scene);

// Everything that may stand under [want].
std::vector<std::string> result_names(const Scene& scene);

}  // namespace viscard
