#pragma once

#include "io/cli/words/streams.h"

#include <string>
#include <vector>

namespace viscard {

// viscard export: a capture as CSV.
int run_export(const std::vector<std::string>& words, Streams& streams);

}  // namespace viscard
