#pragma once

#include <string>
#include <string_view>

namespace viscard {

// The bytes of a table as UTF-8, from UTF-8 (with or without BOM), UTF-16, GB18030 (if all bytes above
// 0x7f come in pairs) or Latin-1: a part of `bytes`, or of `converted`. Throws std::runtime_error naming the file if it contains NUL bytes,
// because then it is not text.
std::string_view utf8_view(std::string_view bytes, const std::string& name, std::string& converted);

}  // namespace viscard
