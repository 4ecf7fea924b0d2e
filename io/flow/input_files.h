#pragma once

#include <string>
#include <vector>

namespace viscard {

struct FittedFile;

// True for the name of a material file, which stands beside records in a joint fit.
bool is_material_file(const std::string& file);

// Refuses a record that is given twice, under one name or under two, because it would count twice
// in a joint fit. Throws std::runtime_error naming both files, or if a file cannot be read.
void refuse_repeated_files(const std::vector<std::string>& files);

// The same for records that were fitted, because a copy with other line ends, units or blank lines has another
// content: two fits that agree in all numbers, far closer than two specimens or two touches of one do.
void refuse_copies(const std::vector<const FittedFile*>& fitted);

}  // namespace viscard
