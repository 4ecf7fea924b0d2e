#pragma once

#include <cstddef>
#include <string>

namespace viscard {

// What a JSON text has that no file of this room may have.
struct JsonFaults {
  bool is_deep = false;  // more levels than kDeepestJson: writing it again could overflow the stack
  bool has_long_key = false;  // longer than kLongestJsonKey
  bool has_many_keys =
      false;  // one object has more than kMostJsonKeys; finding a key takes a time with their number
  bool has_nul = false;  // a text or key with a character 0, at which C cuts it
  std::string repeated;  // a key that is given twice; empty: none
};

inline constexpr std::size_t kDeepestJson = 64, kLongestJsonKey = 1000, kMostJsonKeys = 10000;

// Reads the text once, in a time that grows with its length, and keeps none of its values. Text that is no JSON has
// what stands before its mistake.
JsonFaults faults_of_json(const std::string& text);

}  // namespace viscard
