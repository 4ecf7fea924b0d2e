#pragma once

#include <string>
#include <vector>

namespace viscard::test {

// Checks that start and end tags of a piece of HTML or SVG nest, attributes are quoted, and no bare
// & or < stands in text. Void elements of HTML may stay open. Returns what is wrong, "" if nothing.
std::string first_fault(const std::string& markup);

// Values of all id attributes, in order.
std::vector<std::string> ids_of(const std::string& markup);

// The text between the tags, entities resolved, runs of blanks made one.
std::string text_of(const std::string& markup);

// Every <data value="..."> with the text shown.
struct ShownNumber {
  double value_SI = 0.0;
  std::string shown;
};
std::vector<ShownNumber> numbers_of(const std::string& markup);

}  // namespace viscard::test
