#include "io/cards/targets/program_law.h"

#include "io/basics/patterns.h"

#include <algorithm>
#include <stdexcept>

namespace viscard {

void take_program_terms(const NamedNumbers& lists, const char* share, const char* time,
                        CardNumbers& law) {
  const auto g = lists.find(share), tau = lists.find(time);
  if (g == lists.end() && tau == lists.end()) return;
  if (g == lists.end() || tau == lists.end() || g->second.size() != tau->second.size())
    throw std::runtime_error(std::string(share) + " and " + time + " must have the same length");
  for (std::size_t i = 0; i < g->second.size(); ++i) {
    if (g->second[i] != 0.0) law.branches.push_back({g->second[i], 0.0, tau->second[i]});
  }
}

std::vector<CardLine> computing_lines(const std::string& text, const char* comment,
                                      const char* numbers, bool is_indented) {
  std::vector<CardLine> out;
  for (CardLine line : card_lines(without_line_comments(text, comment), "\n")) {
    if (first_match(line.text, numbers)) continue;
    const std::size_t indent = is_indented ? line.text.find_first_not_of(' ') : 0;
    std::erase_if(line.text, [](unsigned char c) { return c <= ' '; });
    if (line.text.empty()) continue;
    line.text.insert(0, indent, ' ');
    out.push_back(line);
  }
  return out;
}

void require_formula(const std::vector<CardLine>& found, const std::vector<CardLine>& expected) {
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (i < found.size() && found[i].text == expected[i].text) continue;
    const std::string what = "the formula of the card is not that of viscard's card of its law";
    throw std::runtime_error(i < found.size() ? at_line(found[i], what) : what + ": it ends early");
  }
  if (found.size() > expected.size())
    throw std::runtime_error(
        at_line(found[expected.size()], "viscard's card of this law has no such line"));
}

}  // namespace viscard
