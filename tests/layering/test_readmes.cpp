#include "tests/layering/source_tree.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

namespace viscard {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = VISCARD_SOURCE_DIR;

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

// The pages of the root and README.md of all folders of ours, from the root.
std::vector<fs::path> readmes() {
  std::vector<fs::path> found{"README.md", "tests/CONTRIBUTING.md"};
  for (const char* folder : {"models", "fit", "rig", "io", "tests", "data"}) {
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
      if (entry.path().filename() == "README.md") {
        found.push_back(entry.path().lexically_relative(kRoot));
      }
    }
  }
  return found;
}

std::vector<std::string> matches(const std::string& text, const std::regex& pattern) {
  std::vector<std::string> found;
  for (std::sregex_iterator i(text.begin(), text.end(), pattern), end; i != end; ++i) {
    found.push_back((*i)[1]);
  }
  return found;
}

// True for a path, and for the stem of x.h and x.cpp. `*` and NAME of recipes stand for anything.
bool exists_in_tree(const std::string& path) {
  if (path.find('*') != std::string::npos || path.find("NAME") != std::string::npos) return true;
  return fs::exists(kRoot / path) || fs::exists(kRoot / (path + ".h")) ||
         fs::exists(kRoot / (path + ".cpp"));
}

}  // namespace

TEST_CASE("paths and links of the READMEs lead somewhere", "[layering]") {
  static const std::regex kPath(R"(`((?:models|fit|io|rig|tests|data)/[\w./*-]+?)(?:/\.cpp)?`)");
  static const std::regex kLink(R"(\]\(([^)#:]+)(?:#[^)]*)?\))");
  std::size_t n_paths = 0, n_links = 0;
  for (const fs::path& readme : readmes()) {
    const std::string text = text_of(kRoot / readme);
    for (const std::string& path : matches(text, kPath)) {
      CAPTURE(readme.string(), path);
      CHECK(exists_in_tree(path));
      ++n_paths;
    }
    for (const std::string& link : matches(text, kLink)) {
      CAPTURE(readme.string(), link);
      CHECK(fs::exists(kRoot / readme.parent_path() / link));
      ++n_links;
    }
  }
  CHECK(n_paths > 80);
  CHECK(n_links > 80);
}

TEST_CASE("every room is named in the list of rooms of a folder above it", "[layering]") {
  for (const auto& [folder, room] : read_source_tree(VISCARD_SOURCE_DIR).rooms) {
    const fs::path path = folder;
    if (!path.has_parent_path()) continue;
    const fs::path above = path.parent_path();
    const std::string text = text_of(kRoot / above / "README.md");
    const std::string name = path.filename().string();
    CAPTURE(folder);
    CHECK((text.find("(" + name + "/README.md)") != std::string::npos ||
           text.find("`" + name + "/`") != std::string::npos));
  }
}

}  // namespace viscard
