#pragma once

#include <string>
#include <string_view>

namespace viscard {

// The bytes of a table as UTF-8, from UTF-8 (with or without BOM), UTF-16, or an older encoding of Western
// Europe, China, Japan, Russia or Central Europe, by the names of quantities that it holds: a part of `bytes`, or
// of `converted`. Throws std::runtime_error naming the file if it contains NUL bytes, because then it is not text.
std::string_view utf8_view(std::string_view bytes, const std::string& name, std::string& converted);

}  // namespace viscard
