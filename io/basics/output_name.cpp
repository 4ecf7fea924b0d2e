#include "io/basics/output_name.h"

#include <fstream>
#include <stdexcept>
#include <string_view>

namespace viscard {
namespace {

namespace fs = std::filesystem;

bool is_database(const fs::path& path) {
  constexpr std::string_view kMagic = "SQLite format 3";
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return false;
  std::string begin(kMagic.size(), '\0');
  std::ifstream(path, std::ios::binary)
      .read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return begin == kMagic;
}

bool has_bytes(const fs::path& path) {
  std::error_code error;
  const auto size = fs::file_size(path, error);
  return !error && size > 0;
}

}  // namespace

void refuse_output_name(const fs::path& path) {
  std::error_code ignored;
  const std::string name = path.string();
  if (fs::is_symlink(path, ignored) && !fs::exists(path, ignored)) {
    throw std::runtime_error(name + ": leads to " + fs::read_symlink(path, ignored).string() +
                             ", which does not exist; name the file itself");
  }
  for (const std::string ending : kDatabaseParts) {
    if (ending.empty() || !name.ends_with(ending)) continue;
    const std::string owner = name.substr(0, name.size() - ending.size());
    if (!is_database(owner)) continue;
    throw std::runtime_error(name + ": is the name of a side file of " + owner +
                             ", which would be damaged; choose another name");
  }
}

void refuse_orphaned_log(const fs::path& path, const std::string& what) {
  if (has_bytes(path)) return;
  std::error_code ignored;
  for (const char* ending : {"-wal", "-journal"}) {
    // An empty file with a journal is a database that is just being made.
    if (ending != std::string_view("-wal") && fs::exists(path, ignored)) continue;
    const std::string log = path.string() + ending;
    if (!has_bytes(log)) continue;
    throw std::runtime_error(log + " belongs to an earlier " + what +
                             " whose main file is gone; move it away, or choose another name");
  }
}

}  // namespace viscard
