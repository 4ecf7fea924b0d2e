#pragma once

#include "io/flow/design/judge_scene.h"
#include "models/maths/result_visitor.h"

#include <functional>
#include <string>

namespace viscard {

// The judgement as a table of at most 80 columns: a line for each requirement, below it what was computed,
// and for a line that fails the dimensions that would pass.
std::string text_from_judgement(const Judgement& judgement);

// The keys of viscard design --require --json.
void show_keys(ResultVisitor& v, const Judgement& judgement);
// Those of one line; more() shows others among them.
void show_line(ResultVisitor& v, const JudgedLine& line, const std::function<void()>& more);

}  // namespace viscard
