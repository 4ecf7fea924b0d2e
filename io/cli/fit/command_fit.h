#pragma once

#include "io/cli/words/streams.h"

#include <string>
#include <vector>

namespace viscard {

// viscard fit: captures or tables to modulus and Prony series, on the screen, as JSON, as a
// material file.
int run_fit(const std::vector<std::string>& words, Streams& streams);

}  // namespace viscard
