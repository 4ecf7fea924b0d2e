#pragma once

#include "io/cli/words/streams.h"
#include "models/scene/common/scene_answer.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace viscard {

// viscard plan: which effects a scene is answered with, and why; nothing is solved.
int run_plan(const std::vector<std::string>& words, Streams& streams);

// {name, on, estimate, number, value, forced, counted, reason}; estimate is null where the effect
// has nothing to act on.
nlohmann::json json_from_effect(const SceneEffect& effect);

}  // namespace viscard
