#include "rig/cells/line_shape.h"

#include <utility>

namespace viscard {
namespace {

// A device that drops trailing zeros (one line in ten with two decimals) must be noticed by then:
// it sends 64 lines of one shape with probability 0.9^64, one in a thousand.
constexpr std::size_t kLinesToKnow = 64;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

}  // namespace

std::string shape_of_line(std::string_view text) {
  std::string shape;
  bool is_behind_point = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (is_digit(c)) {
      if (is_behind_point) {
        shape += 'd';
      } else if (i == 0 || !is_digit(text[i - 1])) {
        shape += '#';
      }
      continue;
    }
    is_behind_point = c == '.' && i > 0 && is_digit(text[i - 1]);
    if (c != '-' && c != '+' && c != ' ' && c != '\t') shape += c;
  }
  return shape;
}

bool LineShape::fits(std::string_view text) {
  if (is_mixed_) return true;
  std::string shape = shape_of_line(text);
  if (n_same_ >= kLinesToKnow) return shape == shape_;
  if (n_same_ > 0 && shape != shape_) {
    is_mixed_ = true;
    return true;
  }
  shape_ = std::move(shape);
  ++n_same_;
  return true;
}

}  // namespace viscard
