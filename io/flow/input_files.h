#pragma once

#include <string>
#include <vector>

namespace viscard {

// Refuses a record that is given twice, under one name or under two, because it would count twice
// in a joint fit. Throws std::runtime_error naming both files, or if a file cannot be read.
void refuse_repeated_files(const std::vector<std::string>& files);

}  // namespace viscard
