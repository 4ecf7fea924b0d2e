#pragma once

#include "io/scenes/scene_sweep.h"
#include "models/pillar/mesh/scene_mistake.h"

#include <filesystem>
#include <string>

namespace viscard {

// Scene files are TOML; data/scenes/ holds commented examples. Material files are looked for in the
// folder of the scene. Throws std::runtime_error with file:line, key and what is expected, or naming the
// material file that is wrong.
SceneFile read_scene(const std::filesystem::path& path);

// "file:line: key: what" for a mistake that only showed when the scene was solved.
std::string told_with_line(const std::filesystem::path& path, const SceneMistake& mistake);

}  // namespace viscard
