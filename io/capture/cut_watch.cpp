#include "io/capture/cut_watch.h"

#include <sys/stat.h>

namespace viscard {
namespace {

std::string cut_text(const std::filesystem::path& path, std::uintmax_t from_B,
                     std::uintmax_t to_B) {
  return path.string() + " was cut from " + std::to_string(from_B) + " to " + std::to_string(to_B) +
         " bytes";
}

}  // namespace

CutWatch::CutWatch(const std::filesystem::path& capture)
    : file_{capture}, log_{capture.string() + "-wal"} {}

CutWatch::Finding CutWatch::look() {
  for (Seen* seen : {&file_, &log_}) {
    const bool is_log = seen == &log_;
    struct stat now {};
    const bool is_there = ::stat(seen->path.c_str(), &now) == 0;
    const bool is_same = is_there && (seen->inode == 0 || seen->inode == now.st_ino);
    if (!is_same) {
      if (!is_log || seen->inode == 0) continue;
      return {Loss::kLogGone, seen->path.string() + (is_there ? " was replaced by another file"
                                                              : " was deleted or moved")};
    }
    const auto size_B = static_cast<std::uintmax_t>(now.st_size);
    if (size_B < seen->size_B) return {Loss::kCut, cut_text(seen->path, seen->size_B, size_B)};
    seen->size_B = size_B;
    seen->inode = now.st_ino;
  }
  return {};
}

}  // namespace viscard
