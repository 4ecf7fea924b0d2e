#pragma once

#include <cstddef>
#include <cstdlib>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>

namespace viscard {

// The text of an exception for a user. The library has none for a lack of memory: "memory does not suffice
// for TASK; ...".
inline std::string failure_text(const std::exception& error, const std::string& task) {
  const bool is_memory = dynamic_cast<const std::bad_alloc*>(&error) != nullptr ||
                         dynamic_cast<const std::length_error*>(&error) != nullptr;
  if (!is_memory) return error.what();
  return "memory does not suffice for " + task +
         "; check sizes and their units, or ask for less accuracy, fewer points or fewer terms";
}

// Throws std::bad_alloc if so much memory is not to be had now. Ask it before a call of a library that ends the
// process when memory ends within it (UDUNITS asserts, scanners made by flex exit).
inline void require_spare_memory(std::size_t size_B) {
  void* const spare = std::malloc(size_B);
  if (spare == nullptr) throw std::bad_alloc();
  std::free(spare);
}

}  // namespace viscard
