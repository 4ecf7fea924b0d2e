#pragma once

#include "io/cards/card_lines.h"
#include "io/cards/deck.h"
#include "io/cards/read_card.h"

#include <cstddef>
#include <string>
#include <vector>

namespace viscard {

// Fixed columns: LS-DYNA (10 wide) and OpenRadioss (20 wide).

// The fields of a line, blanks trimmed; the cells between commas if the line has any.
std::vector<std::string> columns(const std::string& line, std::size_t width);

// Columns of a field below a keyword of LS-DYNA: 20 in a deck with *KEYWORD LONG=Y or below a keyword that ends with
// "+", 10 else and below one that ends with "-".
std::size_t dyna_width(const std::vector<CardLine>& lines, const CardLine& keyword);

// The unit system of the block /UNIT of OpenRadioss, or "". Throws std::runtime_error for units of no known system.
std::string radioss_units(const std::vector<CardLine>& lines);
// Mistakes of the keyword "/MAT/LAW40/1/2" of a law: no whole number of the material, or a unit block (the last number)
// that is not in the card; none of them is the note that the units of /BEGIN hold.
std::vector<CardFinding> radioss_keyword_findings(const CardLine& law,
                                                  const std::vector<CardLine>& lines);
// A mistake if the first field of LS-DYNA's first card is no number of a material.
std::vector<CardFinding> material_number_findings(const std::string& field, const CardLine& line);

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
