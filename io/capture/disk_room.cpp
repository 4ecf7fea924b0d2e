#include "io/capture/disk_room.h"

#include <sys/statvfs.h>

#include <stdexcept>
#include <string>

namespace viscard {

void refuse_full_disk(const std::filesystem::path& path, std::size_t needed_bytes) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  struct statvfs disk {};
  if (statvfs(folder.c_str(), &disk) != 0) return;
  const auto free_bytes = static_cast<std::size_t>(disk.f_bavail) * disk.f_frsize;
  if (free_bytes >= needed_bytes) return;
  throw std::runtime_error(path.string() + ": only " + std::to_string(free_bytes >> 20) +
                           " MiB are left on that disk; a capture needs at least " +
                           std::to_string(needed_bytes >> 20) + " MiB. Make room first");
}

}  // namespace viscard
