#include "tests/io/cards/card_edits.h"

#include <fmt/format.h>

#include <cctype>
#include <cstdlib>
#include <regex>
#include <utility>

namespace viscard::test {
namespace {

// Uniform in 0 .. count - 1, the same on every platform.
std::size_t pick(std::size_t count, std::mt19937& random) {
  return count == 0 ? 0 : static_cast<std::size_t>(random()) % count;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> out;
  std::size_t begin = 0;
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', begin)) {
    out.push_back(text.substr(begin, at - begin));
    begin = at + 1;
  }
  if (begin < text.size()) out.push_back(text.substr(begin));
  return out;
}

std::string joined_lines(const std::vector<std::string>& lines) {
  std::string out;
  for (const std::string& line : lines) out += line + "\n";
  return out;
}

bool is_comment(const std::string& line, const std::string& comment) {
  return !comment.empty() && line.rfind(comment, 0) == 0;
}

struct Place {
  std::size_t at = 0, size = 0;
};

std::vector<Place> matches_of(const std::string& line, const char* pattern) {
  std::vector<Place> out;
  const std::regex regex(pattern);
  for (std::sregex_iterator it(line.begin(), line.end(), regex), end; it != end; ++it) {
    const auto at = static_cast<std::size_t>(it->position(0));
    // A digit within a name is no number.
    const bool is_in_word =
        at > 0 &&
        (std::isalnum(static_cast<unsigned char>(line[at - 1])) != 0 || line[at - 1] == '_');
    if (!is_in_word) out.push_back({at, static_cast<std::size_t>(it->length(0))});
  }
  return out;
}

std::vector<Place> numbers_of(const std::string& line) {
  return matches_of(line, R"([-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?)");
}

std::string with_number(const std::string& line, const std::string& kind, std::mt19937& random) {
  const std::vector<Place> numbers = numbers_of(line);
  if (numbers.empty()) return line;
  const Place& place = numbers[pick(numbers.size(), random)];
  const double value = std::strtod(line.substr(place.at, place.size).c_str(), nullptr);
  static const double kScales[] = {2.0, 0.5, 1.05, 1.0 / 3.0}, kUnits[] = {1e3, 1e-3, 1e6, 1e-6};
  const double changed = kind == "sign"    ? -value
                         : kind == "scale" ? value * kScales[pick(4, random)]
                                           : value * kUnits[pick(4, random)];
  return std::string(line).replace(place.at, place.size, fmt::format("{:.7g}", changed));
}

std::string with_word(const std::string& line, const std::string& kind, std::mt19937& random) {
  const std::vector<Place> words = matches_of(line, "[A-Za-z_]{2,}");
  if (words.empty()) return line;
  const Place& place = words[pick(words.size(), random)];
  std::string out = line;
  if (kind == "keyword") {
    out[place.at + pick(place.size, random)] = 'x';
    return out;
  }
  for (std::size_t i = place.at; i < place.at + place.size; ++i) {
    const auto c = static_cast<unsigned char>(out[i]);
    out[i] = static_cast<char>(std::isupper(c) != 0 ? std::tolower(c) : std::toupper(c));
  }
  return out;
}

std::string with_separator(const std::string& line, std::mt19937& random) {
  const std::vector<Place> places = matches_of(line, R"([,.=;:<>/\[\]'"{}()]| +)");
  if (places.empty()) return line;
  const Place& place = places[pick(places.size(), random)];
  static const char* kOthers[] = {",", ";", " ", "", "="};
  const bool is_point = line[place.at] == '.';
  return std::string(line).replace(place.at, place.size, is_point ? "," : kOthers[pick(5, random)]);
}

std::string without_number(const std::string& line, std::mt19937& random) {
  const std::vector<Place> numbers = numbers_of(line);
  if (numbers.empty()) return line;
  const Place& place = numbers[pick(numbers.size(), random)];
  return std::string(line).erase(place.at, place.size);
}

std::string with_swapped_numbers(const std::string& line, std::mt19937& random) {
  const std::vector<Place> numbers = numbers_of(line);
  if (numbers.size() < 2) return line;
  const std::size_t i = pick(numbers.size() - 1, random);
  const Place& a = numbers[i];
  const Place& b = numbers[i + 1];
  return line.substr(0, a.at) + line.substr(b.at, b.size) +
         line.substr(a.at + a.size, b.at - a.at - a.size) + line.substr(a.at, a.size) +
         line.substr(b.at + b.size);
}

}  // namespace

CardEdit random_edit(const std::string& text, const std::string& comment, const std::string& kind,
                     std::mt19937& random, EditPlace where) {
  std::vector<std::string> lines = lines_of(text);
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (is_comment(lines[i], comment) == (where == EditPlace::kHeader)) rows.push_back(i);
  }
  const std::size_t row = rows[pick(rows.size(), random)];
  CardEdit edit{.kind = kind, .line = lines[row], .text = {}, .now = {}};
  const bool is_whole = pick(2, random) == 0;
  if (kind == "drop" && is_whole) {
    lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(row));
    edit.text = joined_lines(lines);
    return edit;
  }
  if (kind == "double") lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(row), lines[row]);
  if (kind == "swap" && is_whole && row + 1 < lines.size()) {
    std::swap(lines[row], lines[row + 1]);
  } else if (kind == "swap") {
    lines[row] = with_swapped_numbers(lines[row], random);
  }
  if (kind == "drop") lines[row] = without_number(lines[row], random);
  if (kind == "scale" || kind == "unit" || kind == "sign") {
    lines[row] = with_number(lines[row], kind, random);
  }
  if (kind == "keyword" || kind == "case") lines[row] = with_word(lines[row], kind, random);
  if (kind == "separator") lines[row] = with_separator(lines[row], random);
  edit.now = lines[row];
  edit.text = joined_lines(lines);
  return edit;
}

CardEdit with_second_element(const std::string& text, const std::string& comment,
                             std::mt19937& random) {
  std::vector<std::string> body;
  for (const std::string& line : lines_of(text)) {
    if (!is_comment(line, comment)) body.push_back(line);
  }
  CardEdit edit{.kind = "second", .line = {}, .text = {}, .now = {}};
  while (edit.line == edit.now) {
    std::string& line = body[pick(body.size(), random)];
    edit.line = line;
    edit.now = with_number(line, "scale", random);
    line = edit.now;
  }
  edit.text = text + joined_lines(body);
  return edit;
}

}  // namespace viscard::test
