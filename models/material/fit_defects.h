#pragma once

#include <string>

namespace viscard {

// Whether a flag of that name (MaterialFlag::name) makes the whole fit untrustworthy. Cards refuse
// it like a flagged term.
bool is_defect(const std::string& flag_name);

}  // namespace viscard
