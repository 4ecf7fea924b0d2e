#include "io/cards/named_values.h"

#include "io/basics/patterns.h"
#include "io/cards/read_card.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace viscard {

std::vector<double> numbers_of_list(const std::string& list, const CardLine& line) {
  std::vector<double> out;
  for (const Match& word : all_matches(list, "[^\\s,{}()\\[\\]'\"]+")) {
    out.push_back(card_number(word.group[0], line, "number"));
  }
  return out;
}

CardLine line_of(const std::string& text, std::size_t at) {
  const auto newlines =
      std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  return {static_cast<int>(newlines) + 1, ""};
}

void check_single_element(const std::string& text, const std::string& pattern, const char* name,
                          ReadCard& card) {
  const std::vector<Match> all = all_matches(text, pattern);
  if (all.size() < 2) return;
  card.add("second-element", at_line(line_of(text, all[1].at[0]),
                                     std::string(name) + " stands in the card " +
                                         std::to_string(all.size()) + " times; keep one"));
}

NamedNumbers named_lists(const std::string& text, const std::string& pattern) {
  NamedNumbers out;
  for (const Match& match : all_matches(text, pattern)) {
    out[match.group[1]] = numbers_of_list(match.group[2], line_of(text, match.at[2]));
  }
  return out;
}

double one_of(const NamedNumbers& named, const std::string& name) {
  const auto found = named.find(name);
  if (found == named.end() || found->second.size() != 1) {
    throw std::runtime_error("the card has no " + name + " (one number)");
  }
  return found->second.front();
}

const std::vector<double>& list_of(const NamedNumbers& named, const std::string& name,
                                   std::size_t expected) {
  static const std::vector<double> kNone;
  const auto found = named.find(name);
  const std::vector<double>& list = found == named.end() ? kNone : found->second;
  if (list.size() != expected) {
    throw std::runtime_error("the card has " + std::to_string(list.size()) + " numbers in " + name +
                             " where " + std::to_string(expected) + " are expected");
  }
  return list;
}

std::string without_line_comments(const std::string& text, const std::string& comment) {
  std::string out;
  for (const CardLine& line : card_lines(text, "\n")) {
    out += line.text.substr(0, line.text.find(comment)) + "\n";
  }
  return out;
}

std::string joined(const std::vector<CardBranch>& branches, double CardBranch::*member,
                   const char* separator) {
  std::string out;
  for (const CardBranch& branch : branches) {
    out += fmt::format("{}{}", out.empty() ? "" : separator, branch.*member);
  }
  return out;
}

}  // namespace viscard
