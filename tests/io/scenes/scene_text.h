#pragma once

#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>

#include <fstream>
#include <string>

namespace viscard::test {

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

// A scene file in a folder of its own; DATA in it stands for the repository's data folder.
class SceneText {
 public:
  explicit SceneText(const std::string& text) {
    const auto at = text.find("DATA");
    std::ofstream(path()) << (at == std::string::npos
                                  ? text
                                  : replaced(text, "DATA", VISCARD_SOURCE_DIR "/data"));
  }
  std::string path() const { return (folder_ / "scene.toml").string(); }
  std::string beside(const std::string& name) const { return (folder_ / name).string(); }

 private:
  ScratchFolder folder_;
};

}  // namespace viscard::test
