#pragma once

#include "models/maths/usable_machine.h"

#include <cstddef>
#include <cstdlib>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>

namespace viscard {

// A lack of memory, or of threads: the same question may have an answer later.
inline bool is_lack_of_memory(const std::exception& error) {
  const auto* system = dynamic_cast<const std::system_error*>(&error);
  return dynamic_cast<const std::bad_alloc*>(&error) != nullptr ||
         dynamic_cast<const std::length_error*>(&error) != nullptr ||
         (system != nullptr && system->code() == std::errc::resource_unavailable_try_again);
}

// Thrown by one piece of work to end all of it.
class StopsWork : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A failure of the machine or of the moment (memory, threads, disk, a request to stop), which is no
// property of what was asked: the same question may have an answer later.
inline bool is_passing(const std::exception& error) {
  return is_lack_of_memory(error) || dynamic_cast<const NotEnoughMemory*>(&error) != nullptr ||
         dynamic_cast<const std::system_error*>(&error) != nullptr ||
         dynamic_cast<const StopsWork*>(&error) != nullptr;
}

// What is refused in words, such as a scene outside the model: an answer, which would be the same
// again. A search that goes on after other exceptions takes a lack of memory for a property of what
// it looks at.
inline bool is_refusal(const std::exception& error) {
  return !is_passing(error) && (dynamic_cast<const std::runtime_error*>(&error) != nullptr ||
                                dynamic_cast<const std::invalid_argument*>(&error) != nullptr ||
                                dynamic_cast<const std::domain_error*>(&error) != nullptr);
}

// The text of an exception for a user. The library has none for a lack of memory: "memory does not suffice
// for TASK; ...".
inline std::string failure_text(const std::exception& error, const std::string& task) {
  if (!is_lack_of_memory(error)) return error.what();
  return "memory does not suffice for " + task +
         "; check sizes and their units, or ask for less accuracy, fewer points or fewer terms";
}

// A message in which every word of more than 300 bytes is cut: somebody's value may be megabytes long.
inline std::string shortened(const std::string& text) {
  constexpr std::size_t kLongest = 300, kKept = 60;
  std::string out;
  for (std::size_t begin = 0; begin < text.size();) {
    std::size_t end = text.find(' ', begin);
    end = end == std::string::npos ? text.size() : end + 1;
    if (end - begin <= kLongest) {
      out.append(text, begin, end - begin);
    } else {
      std::size_t kept = begin + kKept;
      while (kept > begin && (static_cast<unsigned char>(text[kept]) & 0xc0U) == 0x80U) --kept;
      out.append(text, begin, kept - begin);
      out += "... (" + std::to_string(end - kept) + " more bytes) ";
    }
    begin = end;
  }
  return out;
}

// Throws std::bad_alloc if so much memory is not to be had now. Ask it before a call of a library that ends the
// process when memory ends within it (UDUNITS asserts, scanners made by flex exit).
inline void require_spare_memory(std::size_t size_B) {
  void* const spare = std::malloc(size_B);
  if (spare == nullptr) throw std::bad_alloc();
  std::free(spare);
}

}  // namespace viscard
