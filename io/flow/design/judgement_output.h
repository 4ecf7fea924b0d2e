#pragma once

#include "io/flow/design/judge_scene.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace viscard {

// The judgement as a table of at most 80 columns: a line for each requirement, below it what was computed,
// and for a line that fails the dimensions that would pass.
std::string text_from_judgement(const Judgement& judgement);

// The object of viscard design --require, without its head.
nlohmann::json json_from_judgement(const Judgement& judgement);

}  // namespace viscard
