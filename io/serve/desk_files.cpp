#include "io/serve/desk_files.h"

#include "io/basics/atomic_file.h"
#include "io/basics/data_folder.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <system_error>
#include <vector>

namespace viscard {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

Json example_scenes() {
  Json examples = Json::array();
  std::error_code error;
  std::vector<std::filesystem::path> files;
  for (std::filesystem::directory_iterator entry(data_folder() / "scenes", error), end;
       !error && entry != end; entry.increment(error)) {
    if (entry->path().extension() == ".toml") files.push_back(entry->path());
  }
  std::sort(files.begin(), files.end());
  for (const std::filesystem::path& file : files) {
    const std::string text = read_own_file(file);
    const std::string first = text.substr(0, text.find('\n'));
    examples.push_back({{"name", file.filename().string()},
                        {"what", first.substr(std::min<std::size_t>(2, first.size()))}});
  }
  return examples;
}

Json pictures_in(const std::filesystem::path& folder) {
  constexpr std::size_t kMost = 12, kLargest_B = std::size_t{4} << 20;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".svg" && entry.file_size() <= kLargest_B)
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  Json pictures = Json::array();
  for (const std::filesystem::path& file : files) {
    if (pictures.size() == kMost) break;
    pictures.push_back({{"name", file.stem().string()}, {"svg", read_own_file(file)}});
  }
  return pictures;
}

}  // namespace viscard
