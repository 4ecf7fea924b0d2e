#pragma once

#include <string>

namespace viscard {

// SHA-256 (FIPS 180-4) of a text as 64 lower-case hexadecimal digits.
std::string sha256_of_text(const std::string& contents);

}  // namespace viscard
