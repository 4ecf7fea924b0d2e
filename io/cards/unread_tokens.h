#pragma once

#include "io/cards/card_lines.h"

#include <functional>
#include <string>
#include <vector>

namespace viscard {

// The lines of the material in a keyword file (Abaqus, CalculiX, FrontISTR): from MATERIAL to the first keyword of the
// model, such as NODE or STEP. Without MATERIAL all lines up to there.
std::vector<CardLine> material_lines(const std::vector<CardLine>& lines, char mark);

// What a reader did not use of the material in a card of the target (Abaqus, CalculiX, FrontISTR, ANSYS, LS-DYNA,
// OpenRadioss; none of others, whose readers account for it): each number other than 0 and each word is changed in
// turn, and one that leaves `reading` (all that was read, as text) the same was not used. A line of which nothing was
// used is named as a whole. A reader that throws used the token.
std::vector<std::string> unread_tokens(
    const std::string& text, const std::string& target,
    const std::function<std::string(const std::string&)>& reading);

}  // namespace viscard
