#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace viscard {

// What files and results state of places on this computer. With --strip-paths, nothing but names: a folder often has
// the name of a person, a client or a project.
void strip_written_paths(bool strips);

// The path as it is written: with --strip-paths the name of a file behind an absolute path, or behind one that leaves
// the folder of the command (../x).
std::string written_path(const std::string& path);
// The same of a word of a command line, such as "--out=/home/a/b.json" or "relaxation=/home/a/b.csv".
std::string written_word(const std::string& word);

// Values of a list as they are written, such as the files that a parameter of a study names. Those that written_path()
// would give one text, although they are different files, keep as many folders as make them different: a/m.json and
// b/m.json. A home folder is never kept; files that differ only there are numbered: m.json (1) and m.json (2).
class WrittenValues {
 public:
  // folder: from where the values look for their files
  WrittenValues(const std::vector<std::string>& values, const std::filesystem::path& folder);
  // written_path() of a value that is not in the list.
  std::string operator()(const std::string& value) const;

 private:
  std::map<std::string, std::string> written_;  // of those that --strip-paths changes
};

// The same of all files of a list that have a path, which the command names.
template <typename File>
void write_paths_of(std::vector<File>& files) {
  std::vector<std::string> paths;
  for (const File& file : files) paths.push_back(file.path);
  const WrittenValues written(paths, "");
  for (File& file : files) file.path = written(file.path);
}

// With --strip-paths, remembers the folder of a file that the command reads or writes ...
void remember_folder_of(const std::filesystem::path& file);
// ... and takes all these folders, the one of the command and that of the user out of a text, such as a message.
std::string written_text(const std::string& text);

}  // namespace viscard
