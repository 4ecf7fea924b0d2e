#pragma once

#include <nlohmann/json_fwd.hpp>

#include <filesystem>

namespace viscard {

// {"name", "what"} of the scenes that come with viscard: file and first line.
nlohmann::ordered_json example_scenes();

// {"name", "svg"} of the pictures below a folder, by name, as many as a page can show.
nlohmann::ordered_json pictures_in(const std::filesystem::path& folder);

}  // namespace viscard
