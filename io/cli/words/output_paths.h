#pragma once

#include "io/cli/words/command_syntax.h"

#include <filesystem>
#include <string>
#include <vector>

namespace viscard {

// Checks every option that names an output (--out, --csv, --creep-csv, --svg, --vtk, --pictures,
// --schemas) before the work starts. Throws UsageError if the output is also an input of the
// command (--force would destroy it), another output, or "-", std::runtime_error if its folder is
// not a folder or not writable, or if a new file is to be written to a name that is a folder, lies
// in none, or exists without --force. syntax.may_exist: the options for folders, which are made,
// and for files that are continued. Refuses an ending that belongs to another format than the one written,
// such as .png or .pdf.
void check_output_paths(const CommandSyntax& syntax);

// Of check_output_paths(): throws if a file cannot have that name, which is a folder or lies in none.
void refuse_folder_as_file(const std::string& option, const std::filesystem::path& output);

// Throws std::runtime_error if the output exists and may not be overwritten, or is a folder, device
// or pipe, before work is lost.
void refuse_existing(const std::filesystem::path& output, bool overwrite);

}  // namespace viscard
