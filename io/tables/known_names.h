#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>

namespace viscard {

// Whether words are names of quantities, as headers have them. A file may have millions of words below its
// numbers, and looking one up takes tens of microseconds: each word is looked up once, and after kMost different
// words no other is known.
class KnownNames {
 public:
  static constexpr std::size_t kMost = 20000;

  bool has(const std::string& word);
  // How many words were looked up.
  std::size_t n_looked_up() const { return known_.size(); }

 private:
  std::unordered_map<std::string, bool> known_;
};

}  // namespace viscard
