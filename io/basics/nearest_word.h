#pragma once

#include <string>
#include <vector>

namespace viscard {

// Returns the entry of `known` with the smallest edit distance (insertions, deletions,
// substitutions) to `word`, or "" if every distance exceeds a third of the word's length (at least
// 2).
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

}  // namespace viscard
