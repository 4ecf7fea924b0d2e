#pragma once

#include <string>
#include <vector>

namespace viscard {

// The nearest of `known` to a misspelt word by edit distance (insertions, deletions,
// substitutions), or "" if none is within a third of the word's length (at least 2).
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

}  // namespace viscard
