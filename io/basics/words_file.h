#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace viscard {

// The words of a command that a file holds, one a line; blank lines and lines that begin with # are none. On a command
// line @FILE stands for them. Throws what read_file() throws.
std::vector<std::string> words_of_file(const std::filesystem::path& path);

// The words with each @FILE among them replaced by those of that file.
std::vector<std::string> with_words_of_files(const std::vector<std::string>& words);

}  // namespace viscard
