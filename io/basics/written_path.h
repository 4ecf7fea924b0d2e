#pragma once

#include <string>

namespace viscard {

// What files and messages state of places on this computer. With --strip-paths, nothing but names: a folder often has
// the name of a person, a client or a project.
void strip_written_paths(bool strips);

// The path as it is written: with --strip-paths the name of a file behind an absolute path.
std::string written_path(const std::string& path);
// The same of a word of a command line, such as "--out=/home/a/b.json" or "relaxation=/home/a/b.csv".
std::string written_word(const std::string& word);

}  // namespace viscard
