#pragma once

#include <filesystem>
#include <string>

namespace viscard {

// A picture as a part of a page, "data:image/png;base64,..." (RFC 2397). PNG, JPEG and SVG of at most 1 MiB; a
// browser runs no script of an SVG that stands in <img>. Throws std::runtime_error naming the file for anything else.
std::string data_uri_of_picture(const std::filesystem::path& path);

}  // namespace viscard
