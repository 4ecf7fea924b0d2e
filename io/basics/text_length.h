#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace viscard {

// The number of characters of UTF-8 text, which is what a reader sees; size() counts bytes.
inline std::size_t length_in_characters(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u;
  }));
}

}  // namespace viscard
