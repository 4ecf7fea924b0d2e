#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace viscard {

// The shape of a line of text with numbers: "12.34 g" and "-7.00 g" are both "#.ddg". All digits
// before a decimal point become one mark, each digit after it one; signs and blanks are left out.
std::string shape_of_line(std::string_view text);

// Recognises garbled lines of a stream by their shape. A garbled reading is often still a number,
// but seldom one of the usual shape: a digit after the point is lost, there is one field too many,
// or the name before the number has another letter. The first 64 lines must have the same shape; a
// stream whose lines naturally differ from each other is not judged.
class LineShape {
 public:
  // False for a line whose shape differs from that of all lines before.
  bool fits(std::string_view text);

 private:
  std::string shape_;
  std::size_t n_same_ = 0;
  bool is_mixed_ = false;
};

}  // namespace viscard
