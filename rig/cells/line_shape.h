#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace viscard {

// The shape of a line of text with numbers: "12.34 g" and "-7.00 g" are both "#.dd g". Digits
// before a decimal point count as one, those behind it one by one; signs and blanks not at all.
std::string shape_of_line(std::string_view text);

// Knows a stream's lines by their shape, once 64 in a row had the same one; a stream whose lines
// differ among themselves by nature is not judged. What a disturbed line makes of a reading often
// still is a number, but seldom in the shape of all others: a lost digit behind the point, a field
// too many, a letter in the name before it.
class LineShape {
 public:
  // False for a line that has not the shape of all before.
  bool fits(std::string_view text);

 private:
  std::string shape_;
  std::size_t n_same_ = 0;
  bool is_mixed_ = false;
};

}  // namespace viscard
