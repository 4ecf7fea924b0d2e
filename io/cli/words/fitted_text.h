#pragma once

#include "io/cli/words/streams.h"

#include <cstddef>
#include <sstream>
#include <string>

namespace viscard {

// The text in lines of at most so many characters; 0: as it is. The last cell of a row (cells are what
// two blanks separate) is broken below its beginning if there is room for it. Otherwise the row keeps
// its cells whole and goes on below, indented. A word is never broken.
std::string fitted(const std::string& text, std::size_t columns);

// Text for people: what is printed into it appears on stdout at its end, in lines that fit the
// terminal. Tables for programs (CSV, cards) go to stdout directly, because a line break changes
// them. print_plan(plan, FittedText(streams)) prints and shows.
class FittedText {
 public:
  explicit FittedText(Streams& streams) : streams_(streams) {}
  ~FittedText();
  FittedText(const FittedText&) = delete;
  FittedText& operator=(const FittedText&) = delete;
  operator std::ostream&() { return text_; }

 private:
  Streams& streams_;
  std::ostringstream text_;
};

}  // namespace viscard
