#pragma once

#include <string>
#include <vector>

namespace viscard {

// What sent these lines, as a sentence for a message: "This is Marlin, ...". Known are the firmware of
// other motion controllers, GRBL, Zaber and a stream of readings. Empty if the lines tell nothing.
std::string who_answers(const std::vector<std::string>& lines);

// "It sent 'start', 'echo:Marlin 2.1.2'. " (the first lines, at most three); empty if there are none.
std::string quoted_lines(const std::vector<std::string>& lines);

}  // namespace viscard
