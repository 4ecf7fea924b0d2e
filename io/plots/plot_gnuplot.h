#pragma once

#include <string>

namespace viscard {

// Runs gnuplot on a script, without the user's own settings, and returns what it wrote to standard
// output. Script, output and messages stay in memory: no file is made and none can be left behind.
// Throws std::runtime_error when gnuplot is not installed (saying how to), cannot be started, or
// ends with an error (its first message).
std::string run_gnuplot(const std::string& script);

}  // namespace viscard
