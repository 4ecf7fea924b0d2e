#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

// Regular expressions (ECMAScript), compiled in one file because <regex> takes 3 s per file.
namespace viscard {

// Each group of a match and where it begins in the text; the first group is the whole match.
struct Match {
  std::vector<std::string> group;
  std::vector<std::size_t> at;
};

// Empty if the pattern matches nowhere.
std::optional<Match> first_match(const std::string& text, const std::string& pattern);
std::vector<Match> all_matches(const std::string& text, const std::string& pattern);
std::string without_matches(const std::string& text, const std::string& pattern);

}  // namespace viscard
