#pragma once

#include "io/cli/words/streams.h"

#include <string>
#include <vector>

namespace viscard {

// viscard fit: fits a modulus and a Prony series to captures or tables; prints them, as text or
// JSON, and writes a material file.
int run_fit(const std::vector<std::string>& words, Streams& streams);

}  // namespace viscard
