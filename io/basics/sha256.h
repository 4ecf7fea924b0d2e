#pragma once

#include <filesystem>
#include <string>

namespace viscard {

// SHA-256 (FIPS 180-4) of a file as 64 lower-case hexadecimal digits. Throws std::runtime_error
// naming the file if it cannot be read.
std::string sha256_of_file(const std::filesystem::path& path);

}  // namespace viscard
