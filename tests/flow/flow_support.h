#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace viscard::test {

// A folder that the destructor removes.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

// What one `viscard WORDS...` printed and returned, run in this process.
struct CommandRun {
  int status = 0;
  std::string out;
  std::string err;
};
CommandRun run_words(const std::vector<std::string>& words);

// data/demo/NAME of the source tree.
std::string demo_file(const std::string& name);

}  // namespace viscard::test
