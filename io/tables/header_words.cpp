#include "io/tables/header_words.h"

#include "io/tables/csv_header.h"

#include <algorithm>
#include <iterator>
#include <string>

namespace viscard {
namespace {

bool is_upper(char c) {
  return c >= 'A' && c <= 'Z';
}

bool is_letter_or_digit(char c) {
  return is_upper(c) || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') ||
         static_cast<unsigned char>(c) >= 0x80;
}

bool contains_in_order(const std::vector<std::string>& words,
                       const std::vector<std::string>& part) {
  return !part.empty() &&
         std::search(words.begin(), words.end(), part.begin(), part.end()) != words.end();
}

}  // namespace

std::vector<std::string> words_of_header(const std::string& header) {
  std::vector<std::string> words;
  bool begins_word = true;
  char last = ' ';
  for (const char c : header) {
    if (!is_letter_or_digit(c)) {
      begins_word = true;
    } else {
      // A capital after a small letter begins a word: AdjustedForce.
      if (begins_word || (is_upper(c) && last >= 'a' && last <= 'z')) words.emplace_back();
      words.back() += c;
      begins_word = false;
    }
    last = c;
  }
  for (std::string& word : words) word = lower_case(word);
  return words;
}

bool speaks_of(const CsvColumn& column, const ColumnKind& quantity) {
  constexpr std::size_t kShortest = 3;
  const std::vector<std::string> words = words_of_header(column.name);
  // "log frequency", "strain rate": another quantity of the same name.
  constexpr const char* kOther[] = {"log", "log10", "lg",    "ln",        "rate",
                                    "std", "sd",    "error", "deviation", "uncertainty"};
  const bool is_other = std::any_of(words.begin(), words.end(), [&](const std::string& word) {
    return std::find(std::begin(kOther), std::end(kOther), word) != std::end(kOther);
  });
  if (is_other) return false;
  const auto is_named = [&](const std::string& name) {
    return name.size() >= kShortest && contains_in_order(words, words_of_header(name));
  };
  return is_named(quantity.base) ||
         std::any_of(quantity.aliases.begin(), quantity.aliases.end(), is_named);
}

bool is_counter(const CsvColumn& column) {
  constexpr const char* kNames[] = {"point",  "points",    "index",  "no",    "nr",
                                    "row",    "record",    "number", "count", "punkt",
                                    "nummer", "messpunkt", "序号",   "点号"};
  const std::vector<std::string> words = words_of_header(column.name);
  const bool is_named = std::any_of(words.begin(), words.end(), [&](const std::string& word) {
    return std::find(std::begin(kNames), std::end(kNames), word) != std::end(kNames);
  });
  if (!is_named || column.values.size() < 2) return false;
  for (std::size_t i = 1; i < column.values.size(); ++i) {
    if (column.values[i] - column.values[i - 1] != 1.0) return false;
  }
  return true;
}

}  // namespace viscard
