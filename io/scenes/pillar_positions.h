#pragma once

#include "models/array/contact/rigid_shape.h"

#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace viscard {

// Places of pillars from a table with columns x and y, each with a unit of length in its header ("x
// [um]", "y (mm)", "x_m"). Throws std::runtime_error naming the file, the column or the line.
std::vector<std::pair<double, double>> read_positions(const std::filesystem::path& path);

// Heights of a surface from a table with columns x, y and z, each with a unit of length, one row for each
// place of a rectangular grid in any order. Heights are counted from the lowest. Throws as above, and if
// a place is missing or given twice.
HeightTable read_heights(const std::filesystem::path& path);

// Voltages of the quarters of one pillar's electrode.
struct QuadrantVoltages {
  int row = 1, column = 1;  // from 1
  std::array<double, 4> voltage_V{};
};
// From a table with columns row, column and quadrant_1_voltage to quadrant_4_voltage, each with a unit of voltage in its
// header, as `simulate` writes them. Throws std::runtime_error naming the file, the column or the line.
std::vector<QuadrantVoltages> read_quadrant_voltages(const std::filesystem::path& path);

// Rows and columns of pillars, whole numbers from 1. Throws SceneMistake with the key for others.
std::vector<std::pair<int, int>> places_of(const std::string& key,
                                           const std::vector<std::pair<double, double>>& pairs);

}  // namespace viscard
