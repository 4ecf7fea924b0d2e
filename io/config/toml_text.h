#pragma once

#include <toml++/toml.h>

#include <string>

namespace viscard {

// Parses TOML. Throws std::runtime_error "scene.toml:3: not TOML: '40 um' needs quotes, as in
// diameter = "40 um"": the line, and what to change on it. name stands for the file.
toml::table table_from_toml(const std::string& text, const std::string& name);

}  // namespace viscard
