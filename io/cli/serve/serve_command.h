#pragma once

#include "io/cli/words/streams.h"

namespace viscard {

// viscard serve: shows a page at the rig until Ctrl-C.
int run_serve(const Words& words, Streams& streams);

}  // namespace viscard
