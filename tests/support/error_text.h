#pragma once

#include <exception>
#include <string>

namespace viscard::test {

// The message of the exception that the action throws; "" if it throws none.
template <typename Action>
std::string error_text(Action&& action) {
  try {
    action();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace viscard::test
