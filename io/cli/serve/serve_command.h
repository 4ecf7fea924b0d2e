#pragma once

#include "io/cli/words/streams.h"

namespace viscard {

// viscard serve: shows a page at the rig until Ctrl-C.
int run_serve(const Words& words, Streams& streams);

// viscard desk: shows the page for one's own tables until Ctrl-C.
int run_desk(const Words& words, Streams& streams);

// Throws UsageError unless it is a port; 0: any free one.
void check_port(int port);

}  // namespace viscard
