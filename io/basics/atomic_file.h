#pragma once

#include <filesystem>
#include <string>

namespace viscard {

// Writes a whole file so that a reader sees the old one or the new one and never a part: temporary
// name in the same folder, fsync, rename, fsync of the folder.
// Throws std::runtime_error, saying what to do next, if the target exists and overwrite is false,
// if it is a folder, or if any step fails; the temporary file is then removed.
void write_file(const std::filesystem::path& path, const std::string& contents, bool overwrite);

// The whole file. Throws std::runtime_error naming the file and the reason.
std::string read_file(const std::filesystem::path& path);

}  // namespace viscard
