#pragma once

#include "io/tables/csv_column.h"
#include "io/tables/csv_dialect.h"
#include "io/tables/line_numbers.h"

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

// Appends the rows from that place on to the columns, and the numbers of their lines to `lines`.
// Returns for each column whether a cell of it is text (then not zero). name: of the file.
std::vector<char> append_rows(std::string_view text, RowPlace from, const Dialect& dialect,
                              const std::string& name, std::vector<CsvColumn>& columns,
                              LineNumbers& lines);

}  // namespace viscard
