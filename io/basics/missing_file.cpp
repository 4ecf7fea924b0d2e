#include "io/basics/missing_file.h"

#include "io/basics/words.h"
#include "io/basics/written_path.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <system_error>
#include <vector>

namespace fs = std::filesystem;

namespace viscard {
namespace {

// Folders of measurements may be large; a suggestion is not worth reading all of them.
constexpr std::size_t kMostNames = 5000;

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end;
       !error && entry != end && names.size() < kMostNames; entry.increment(error)) {
    names.push_back(entry->path().filename().string());
  }
  return names;
}

std::string next_for_missing(const fs::path& path) {
  if (path == "-") return "standard input is not read here; save it to a file and name that";
  std::error_code error;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, error)) {
    return (fs::exists(folder, error) ? "'" + folder.string() + "' is not a folder"
                                      : "there is no folder '" + folder.string() + "' either") +
           ", so check the path";
  }
  const std::string near = near_file(path);
  if (!near.empty()) return "did you mean '" + near + "'?";
  return "nothing in " +
         (path.has_parent_path()
              ? "'" + folder.string() + "'"
              : "the current folder, '" + fs::current_path(error).string() + "',") +
         " has a name like it, so check name and folder";
}

}  // namespace

std::string near_file(const fs::path& path) {
  remember_folder_of(path);  // for messages about it
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const std::string near = nearest_word(path.filename().string(), names_in(folder));
  return near.empty() || !path.has_parent_path() ? near : (folder / near).string();
}

std::string why_not_opened(const fs::path& path, int error) {
  remember_folder_of(path);
  const std::string what = std::string("cannot open: ") + std::strerror(error) + "; ";
  if (path.empty()) return what + "its name is empty, so name a file";
  if (error == ENOENT || error == ENOTDIR) return what + next_for_missing(path);
  if (error == EACCES || error == EPERM) {
    return what + "give yourself the right to read it (chmod u+r), or copy it where you have it";
  }
  return what + "check the name and the disk it lies on";
}

std::string why_file_is_gone(int fd, const fs::path& path) {
  struct stat open_file {
  }, named{};
  if (::fstat(fd, &open_file) != 0) return {};
  const bool is_named = ::stat(path.c_str(), &named) == 0;
  if (is_named && named.st_dev == open_file.st_dev && named.st_ino == open_file.st_ino) return {};
  if (open_file.st_nlink == 0) return is_named ? "was replaced by another file" : "was deleted";
  // Linux knows the present name of an open file: proc(5), /proc/PID/fd.
  std::error_code error;
  const fs::path now = fs::read_symlink("/proc/self/fd/" + std::to_string(fd), error);
  if (error) return "was moved";
  const bool is_now_there = ::stat(now.c_str(), &named) == 0 && named.st_ino == open_file.st_ino &&
                            named.st_dev == open_file.st_dev;
  // Of a file with several names the kernel shows the one that was opened.
  const bool is_unlinked = !is_now_there && now.string().ends_with(" (deleted)");
  if (is_unlinked) return "was moved: it is left under another name only (a hard link)";
  return "was moved to " + now.string();
}

bool is_readable(const fs::path& path) {
  std::error_code error;
  return !fs::is_directory(path, error) && ::access(path.c_str(), R_OK) == 0;
}

}  // namespace viscard
