#pragma once

#include "io/cli/words/streams.h"

#include <cstddef>

namespace viscard {

// Width of the terminal that a file descriptor is, or of the variable COLUMNS if it is none; at
// least 40. 0: neither is known.
std::size_t columns_of(int descriptor);

// Whether a bar may be drawn and redrawn: a terminal that is not "dumb".
bool is_drawable(int descriptor);

// Whether to colour what goes to a file descriptor. --color always or never decides; with auto, which
// is the default, it must be a terminal, TERM not "dumb", and NO_COLOR empty or not set
// (https://no-color.org).
bool is_coloured(const Words& words, int descriptor);

// The text in bold, or in bold red, if it shall be coloured.
std::string bold(const std::string& text, bool is_coloured);
std::string bold_red(const std::string& text, bool is_coloured);

}  // namespace viscard
