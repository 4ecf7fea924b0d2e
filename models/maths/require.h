#pragma once

#include <stdexcept>
#include <string>

namespace viscard {

// Throws std::invalid_argument with the text unless the condition holds.
inline void require(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument(what);
}

}  // namespace viscard
