#pragma once

#include "io/cards/deck.h"

#include <cstddef>
#include <string>
#include <vector>

namespace viscard {

// Fixed columns: LS-DYNA (10 wide) and OpenRadioss (20 wide).

// The fields of a line, blanks trimmed; the cells between commas if the line has any.
std::vector<std::string> columns(const std::string& line, std::size_t width);

// Right-aligned text.
std::string right(const std::string& text, int width);
// A number that leaves one column blank, so that neighbours do not touch.
std::string real(double value, int width);

// Parts of a one-element model that both share.

// "id x y z" for the eight nodes of the cube.
std::string node_rows(int id_width, int width);
std::string face_nodes(int face);
// Two columns of 20: a linear rise to input.pull() at the end of the ramp, then constant.
std::string ramp_rows(const DeckInput& input);

}  // namespace viscard
