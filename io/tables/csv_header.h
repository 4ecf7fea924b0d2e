#pragma once

#include <string>
#include <string_view>

namespace viscard {

// "[nN]" and "(nN)" without the brackets; other cells as they are.
std::string_view without_brackets(std::string_view cell);

// Latin, Greek and Cyrillic letters in lower case; text: UTF-8.
std::string lower_case(const std::string& text);

// Name and unit of a header: "Force [nN]", "Time (s)", "F/N", "Time, s". Without a unit the name is
// the header.
struct HeaderParts {
  std::string name, unit;
};
HeaderParts split_header(std::string_view header);

}  // namespace viscard
