#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace viscard::test {

// A disk that loses everything that was not synced. While an object of this class lives, each
// fsync() and fdatasync() of the test program is watched (power_cut.cpp replaces both): a synced file
// keeps the contents it has at that moment, and a synced folder keeps its entries. After a power cut
// an entry points to the contents that were synced last, or to an empty file. A real disk may keep
// more; nothing may depend on that.
class LossyDisk {
 public:
  // Watches one folder without its subfolders. What is there now counts as synced.
  explicit LossyDisk(const std::filesystem::path& folder);
  ~LossyDisk();
  LossyDisk(const LossyDisk&) = delete;
  LossyDisk& operator=(const LossyDisk&) = delete;

  // One state for each sync so far, the first from the beginning.
  std::size_t n_states() const;
  // Writes the files that a power cut after that sync leaves into an empty folder.
  void restore(std::size_t state, const std::filesystem::path& into) const;

  // Syncs of the folder fail from now on with this errno.
  void fail_folder_syncs(int error);

  // For power_cut.cpp. Returns the errno that the sync must report, or 0.
  int synced(int descriptor);

 private:
  using FileId = std::pair<unsigned long long, long long>;  // inode, time of birth in ns
  struct State {
    std::map<std::string, FileId> entries;
    std::map<FileId, std::string> contents;
  };
  void keep_entries();
  static FileId id_of(const char* path, int descriptor);

  std::filesystem::path folder_;
  int folder_error_ = 0;
  std::vector<State> states_;
};

}  // namespace viscard::test
