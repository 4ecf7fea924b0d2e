#pragma once

#include <string>
#include <string_view>

namespace viscard {

// Throws std::runtime_error, one line that names the file and its kind, for bytes of another kind
// of file: a picture, a PDF, an archive, a workbook, JSON, TOML.
void refuse_foreign_file(std::string_view bytes, const std::string& name);

}  // namespace viscard
