#pragma once

#include <cstddef>
#include <vector>

namespace viscard {

// Columns made fit for fitting: rows with a value that is not finite are left out, the rest sorted
// by time (rows of equal time keep their order).
struct CleanColumns {
  std::vector<std::vector<double>> columns;  // columns[0] is time
  std::size_t n_left_out = 0;
};

// Throws std::invalid_argument if the columns differ in length, std::runtime_error if fewer than
// `least` usable rows are left.
CleanColumns clean_columns(std::vector<std::vector<double>> columns, std::size_t least);

// Shortest positive difference of sorted times; 0 if there is none.
double shortest_step_s(const std::vector<double>& time_s);

}  // namespace viscard
