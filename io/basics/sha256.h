#pragma once

#include <string>

namespace viscard {

// SHA-256 (FIPS 180-4) of a text as 64 lower-case hexadecimal digits; of a file: atomic_file.h.
std::string sha256_of_text(const std::string& text);

}  // namespace viscard
