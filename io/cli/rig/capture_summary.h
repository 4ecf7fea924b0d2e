#pragma once

#include "io/cli/rig/capture_words.h"

#include <nlohmann/json.hpp>

#include <iosfwd>

namespace viscard {

// What `viscard capture` prints about one run.
void print_text(const CaptureOutcome& capture, std::ostream& out);
nlohmann::ordered_json json_from_outcome(const CaptureOutcome& capture);

}  // namespace viscard
