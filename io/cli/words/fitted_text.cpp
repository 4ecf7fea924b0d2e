#include "io/cli/words/fitted_text.h"

#include "io/basics/words.h"

#include <algorithm>
#include <vector>

namespace viscard {
namespace {

constexpr std::size_t kFurther = 4;  // indentation of what follows a broken row

// The parts of a text between runs of at least so many blanks.
std::vector<std::string> parts_of(const std::string& text, std::size_t blanks) {
  std::vector<std::string> parts;
  const std::string gap(blanks, ' ');
  for (std::size_t from = text.find_first_not_of(' '); from != std::string::npos;) {
    const std::size_t to = text.find(gap, from);
    parts.push_back(text.substr(from, to == std::string::npos ? to : to - from));
    from = to == std::string::npos ? to : text.find_first_not_of(' ', to);
  }
  return parts;
}

// Puts words into lines.
class Lines {
 public:
  Lines(std::size_t columns, std::size_t indent)
      : columns_(columns), indent_(indent), text_(indent, ' '), used_(indent) {}

  // gap: blanks between this word and the one before it in the same line.
  void add(const std::string& word, std::size_t gap) {
    const std::size_t width = length_in_characters(word);
    if (has_word_ && used_ + gap + width > columns_) next_line();
    if (has_word_) text_ += std::string(gap, ' ');
    used_ += (has_word_ ? gap : 0) + width;
    text_ += word;
    has_word_ = true;
  }
  // A cell stays whole if it fits into a line of its own.
  void add_cell(const std::string& cell) {
    if (indent_ + kFurther + length_in_characters(cell) <= columns_) return add(cell, 2);
    std::size_t gap = 2;
    for (const std::string& word : parts_of(cell, 1)) {
      add(word, gap);
      gap = 1;
    }
  }
  const std::string& text() const { return text_; }

 private:
  void next_line() {
    const std::size_t indent = indent_ + kFurther;
    text_ += "\n" + std::string(indent, ' ');
    used_ = indent;
    has_word_ = false;
  }

  std::size_t columns_, indent_;
  std::string text_;
  std::size_t used_;
  bool has_word_ = false;
};

// The row as it is, but its last cell in lines below each other. Empty if there is no room for that.
std::string with_hanging_cell(const std::string& line, std::size_t columns) {
  constexpr std::size_t kRoom = 24;
  const std::size_t gap = line.rfind("  ");
  if (gap == std::string::npos || gap + 2 >= line.size()) return "";
  const std::size_t start = length_in_characters(line.substr(0, gap + 2));
  if (start + kRoom > columns || line.find_first_not_of(' ') >= gap) return "";
  std::string text = line.substr(0, gap + 2);
  std::size_t used = start;
  for (const std::string& word : parts_of(line.substr(gap + 2), 1)) {
    const std::size_t width = length_in_characters(word);
    if (used > start && used + 1 + width > columns) {
      text += "\n" + std::string(start, ' ');
      used = start;
    }
    text += (used > start ? " " : "") + word;
    used += (used > start ? 1 : 0) + width;
  }
  return text;
}

std::string fitted_line(const std::string& line, std::size_t columns) {
  const std::size_t first = line.find_first_not_of(' ');
  if (length_in_characters(line) <= columns || first == std::string::npos) return line;
  if (std::string hanging = with_hanging_cell(line, columns); !hanging.empty()) return hanging;
  Lines lines(columns, std::min(first, columns / 4));
  for (const std::string& cell : parts_of(line, 2)) lines.add_cell(cell);
  return lines.text();
}

}  // namespace

std::string fitted(const std::string& text, std::size_t columns) {
  if (columns == 0) return text;
  std::string out;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = text.find('\n', from);
    const std::size_t end = to == std::string::npos ? text.size() : to;
    out += fitted_line(text.substr(from, end - from), columns);
    if (to != std::string::npos) out += '\n';
    from = end + 1;
  }
  return out;
}

FittedText::~FittedText() {
  streams_.out << fitted(with_shown_controls(text_.str()), streams_.columns);
}

}  // namespace viscard
