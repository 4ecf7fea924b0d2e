#pragma once

#include <functional>
#include <string>

namespace viscard {

// Called with the fraction done and the name of the step that was finished last; may be empty.
using FlowProgress = std::function<void(double fraction, const std::string& step)>;

}  // namespace viscard
