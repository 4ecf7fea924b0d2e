#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace viscard {

// SHA-256 (FIPS 180-4) of bytes that come in pieces.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  // The next piece, of n_bytes bytes.
  void add(const char* bytes, std::size_t n_bytes);
  // 64 lower-case hexadecimal digits; once.
  std::string digits();

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

// The same of a text.
std::string sha256_of_text(const std::string& contents);

}  // namespace viscard
