#pragma once

#include <filesystem>
#include <string>

namespace viscard {

// Why a file cannot be opened, from the error number of open(2), and what to do next: "cannot open:
// No such file or directory; did you mean 'run_2.csv'?". The nearest name is taken from the folder
// of the file.
std::string why_not_opened(const std::filesystem::path& path, int error);

// The file of the same folder whose name is nearest to that of `path`, or "" if none is near.
std::string near_file(const std::filesystem::path& path);

// For a file that this process has open as fd: why it is no longer found under its name. "was deleted",
// "was moved to B", "was moved: ..." if only a hard link is left, or "was replaced by another file"; "" if it is still there.
std::string why_file_is_gone(int fd, const std::filesystem::path& path);

// True if a file of this name can be opened for reading.
bool is_readable(const std::filesystem::path& path);

}  // namespace viscard
