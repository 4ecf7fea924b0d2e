#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace viscard {

// The name of a file as the headers of cards of all targets state it, in printable ASCII that every comment and
// string can hold: bytes that it cannot are written as %XX, such as those of UTF-8, a line break, a quotation
// mark, a backslash, and the second '-' of "--", which would end a comment of XML. Other names stay as they are.
std::string name_in_header(const std::string& name);

// The name of the file again. A text that name_in_header() does not write, as in older cards, is the name itself.
std::string name_from_header(const std::string& text);

// Where the text behind a mark such as "units: " begins, in the first line that begins with it: before it stand no
// letter or digit, so at most the sign of a comment. npos if no line does. A mark elsewhere in a line may belong to
// the name of a file or material.
std::size_t behind_mark(const std::string& header, std::string_view mark);

}  // namespace viscard
