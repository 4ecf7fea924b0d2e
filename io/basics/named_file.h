#pragma once

#include "io/basics/file_kind.h"

#include <filesystem>
#include <string>

namespace viscard {

// Describes why a file that another file names cannot be read, or "" if it can: "names '../m.json',
// but there is no file '/a/m.json'; ...". A relative name is looked for in `folder`. The advice is
// one of these: a file of that name that came with viscard, a similar name in the same folder, or
// how to get a file of this kind.
std::string fault_of_named_file(const std::filesystem::path& folder, const std::string& name,
                                FileKind wanted);

}  // namespace viscard
