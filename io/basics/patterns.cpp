#include "io/basics/patterns.h"

#include <regex>

namespace viscard {
namespace {

Match match_from(const std::smatch& found) {
  Match match;
  for (std::size_t i = 0; i < found.size(); ++i) {
    match.group.push_back(found[i].str());
    match.at.push_back(static_cast<std::size_t>(found.position(i)));
  }
  return match;
}

}  // namespace

std::optional<Match> first_match(const std::string& text, const std::string& pattern) {
  std::smatch found;
  if (!std::regex_search(text, found, std::regex(pattern))) return std::nullopt;
  return match_from(found);
}

std::vector<Match> all_matches(const std::string& text, const std::string& pattern) {
  const std::regex expression(pattern);
  std::vector<Match> matches;
  for (std::sregex_iterator it(text.begin(), text.end(), expression), end; it != end; ++it) {
    matches.push_back(match_from(*it));
  }
  return matches;
}

std::string without_matches(const std::string& text, const std::string& pattern) {
  return std::regex_replace(text, std::regex(pattern), "");
}

}  // namespace viscard
