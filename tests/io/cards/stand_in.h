#pragma once

#include <filesystem>
#include <string>

namespace viscard::test {

// stand_in.py under the name of a solver's program.
inline std::string stand_in(const std::filesystem::path& folder, const char* name) {
  namespace fs = std::filesystem;
  const fs::path script = fs::path(VISCARD_GOLDEN_FOLDER).parent_path() / "stand_in.py";
  fs::copy_file(script, folder / name, fs::copy_options::overwrite_existing);
  fs::permissions(folder / name, fs::perms::owner_all);
  return (folder / name).string();
}

}  // namespace viscard::test
