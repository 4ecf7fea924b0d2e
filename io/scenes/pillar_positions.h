#pragma once

#include <filesystem>
#include <utility>
#include <vector>

namespace viscard {

// Places of pillars from a table with columns x and y, each with a unit of length in its header ("x
// [um]", "y (mm)", "x_m"). Throws std::runtime_error naming the file, the column or the line.
std::vector<std::pair<double, double>> read_positions(const std::filesystem::path& path);

}  // namespace viscard
