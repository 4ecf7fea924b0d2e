#pragma once

#include "io/cli/rig/capture_words.h"

#include <iosfwd>

namespace viscard {

// What `viscard capture` prints about one run.
void print_text(const CaptureOutcome& capture, std::ostream& out);

}  // namespace viscard
