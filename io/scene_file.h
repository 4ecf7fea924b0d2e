#pragma once

#include "models/pillar/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace viscard {

struct SceneFile {
  Scene scene;
  std::vector<std::string> quantities;  // wanted results; empty: all
};

// Scene files are TOML; data/scenes/ holds commented examples. Material files are looked for beside
// the scene. Throws std::runtime_error with file:line, key and what is expected, or naming the
// material file that is wrong.
SceneFile read_scene(const std::filesystem::path& path);

}  // namespace viscard
