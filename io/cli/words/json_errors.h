#pragma once

#include "io/cli/words/streams.h"

#include <functional>

namespace viscard {

// Runs a command. If it throws and --json is among its words, prints {"error": {"code", "message",
// "where", "hint"}} as one line on stdout; the exception goes on in any case.
int with_json_errors(const Words& words, Streams& streams, const std::function<int()>& command);

}  // namespace viscard
