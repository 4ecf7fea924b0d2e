#pragma once

#include "io/tables/csv_dialect.h"
#include "io/tables/csv_table.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace viscard {

// Divides a line into `width` cells or more, of which the surplus must be empty. Throws
// std::runtime_error that names the file and the line.
void row_cells(const TextLine& line, const Dialect& dialect, std::size_t width,
               const std::string& name, std::vector<std::string_view>& cells);

struct RowPlace {
  std::size_t at = 0;    // character of the text
  std::size_t line = 1;  // number of its line
};

// Appends the rows from that place on to lines and values of a table with its columns. Returns for
// each column whether a cell of it is text (then not zero).
std::vector<char> append_rows(std::string_view text, RowPlace from, const Dialect& dialect,
                              CsvTable& table);

}  // namespace viscard
