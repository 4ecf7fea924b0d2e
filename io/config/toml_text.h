#pragma once

#include <toml++/toml.h>

#include <cstddef>
#include <string>

namespace viscard {

// Parses TOML. Throws std::runtime_error "scene.toml:3: not TOML: '40 um' needs quotes, as in
// diameter = "40 um"": the line, and what to change on it. name stands for the file.
toml::table table_from_toml(const std::string& text, const std::string& name);

// The same with toml::parse_error for what is not TOML.
toml::table parsed_toml(const std::string& text, const std::string& name = "");

// The library works through a key such as a.b.c by recursion, and needs time that grows with the square of
// some lengths. No file of viscard comes near these limits.
inline constexpr std::size_t kMostTomlBytes = std::size_t{16} << 20;
inline constexpr std::size_t kDeepestKey = 32;    // sections in one key
inline constexpr std::size_t kLongestKey = 1000;  // characters of one section
// Throws std::runtime_error naming the line and the limit.
void refuse_endless_toml(const std::string& text, const std::string& name);

}  // namespace viscard
