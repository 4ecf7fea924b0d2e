#pragma once

#include "io/cli/words/streams.h"

#include <string>
#include <vector>

namespace viscard {

// viscard report: captures and material files to one HTML page with everything known of them.
int run_report(const std::vector<std::string>& words, Streams& streams);

}  // namespace viscard
