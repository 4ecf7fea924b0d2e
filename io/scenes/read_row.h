#pragma once

#include "io/scenes/field_reader.h"
#include "io/scenes/scene_sweep.h"

#include <filesystem>

namespace viscard {

// Reads a scene of a row of pillars; data/scenes/array_*.toml are commented examples. Material
// files are looked for in `folder`. Throws SceneMistake, std::invalid_argument or
// std::runtime_error for what is wrong.
void read_row(const FieldReader& read, const std::filesystem::path& folder, SceneFile& file);

}  // namespace viscard
