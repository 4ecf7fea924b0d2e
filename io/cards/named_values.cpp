#include "io/cards/named_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <stdexcept>

namespace viscard {
namespace {

std::vector<double> numbers_in(const std::string& list, const CardLine& line) {
  std::vector<double> out;
  const std::regex word("[^\\s,{}'\"]+");
  for (std::sregex_iterator it(list.begin(), list.end(), word), end; it != end; ++it) {
    out.push_back(card_number(it->str(), line, "number"));
  }
  return out;
}

}  // namespace

CardLine line_of(const std::string& text, std::size_t at) {
  const auto newlines =
      std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  return {static_cast<int>(newlines) + 1, ""};
}

std::optional<Match> first_match(const std::string& text, const std::string& pattern) {
  std::smatch found;
  if (!std::regex_search(text, found, std::regex(pattern))) return std::nullopt;
  Match match;
  for (std::size_t i = 0; i < found.size(); ++i) {
    match.group.push_back(found[i].str());
    match.at.push_back(static_cast<std::size_t>(found.position(i)));
  }
  return match;
}

NamedNumbers named_lists(const std::string& text, const std::string& pattern) {
  NamedNumbers out;
  const std::regex expression(pattern);
  for (std::sregex_iterator it(text.begin(), text.end(), expression), end; it != end; ++it) {
    out[(*it)[1].str()] =
        numbers_in((*it)[2].str(), line_of(text, static_cast<std::size_t>(it->position(2))));
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
