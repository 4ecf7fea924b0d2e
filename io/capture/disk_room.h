#pragma once

#include <cstddef>
#include <filesystem>

namespace viscard {

// Throws std::runtime_error if the disk of this file has less room than a capture needs.
void refuse_full_disk(const std::filesystem::path& path, std::size_t needed_bytes);

}  // namespace viscard
