#pragma once

#include <string>
#include <string_view>

namespace viscard {

// Throws std::runtime_error, one line that names the file and what it is, for bytes that are a file
// of another kind: a picture, a PDF, an archive, a workbook, JSON, TOML.
void refuse_foreign_file(std::string_view bytes, const std::string& name);

}  // namespace viscard
