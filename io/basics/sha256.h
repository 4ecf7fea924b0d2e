#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace viscard {

// SHA-256 (FIPS 180-4) as 64 lower-case hexadecimal digits. The first throws std::runtime_error
// naming the file when it cannot be read.
std::string sha256_of_file(const std::filesystem::path& path);
std::string sha256_of_text(std::string_view text);

}  // namespace viscard
