#pragma once

#include "io/flow/optimise/design_front.h"

#include <filesystem>
#include <string>

namespace viscard {

class ResultVisitor;

// The designs as text of at most 80 columns.
std::string text_from_front(const DesignSpec& spec, const DesignFront& front);
// The keys of viscard design SPEC --json.
void show_front(ResultVisitor& v, const DesignSpec& spec, const DesignFront& front);
// One line for each design: choices, ranges in their units, objectives and margins.
std::string csv_from_front(const DesignSpec& spec, const DesignFront& front);

// The scene of a design for a folder of its own: names of files are changed to lead there from `folder`. With
// --strip-paths they have no folder, and its head states that the files are to be copied beside it.
std::string scene_for_folder(const DesignSpec& spec, const OptimisedDesign& design,
                             const std::filesystem::path& folder);

}  // namespace viscard
