#pragma once

#include "io/cli/words/streams.h"

#include <string>
#include <vector>

namespace viscard {

// viscard report: writes one HTML page about captures, tables, material files and a joint fit.
int run_report(const std::vector<std::string>& words, Streams& streams);

}  // namespace viscard
