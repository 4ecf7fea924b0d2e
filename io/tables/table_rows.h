#pragma once

#include "io/tables/csv_dialect.h"
#include "io/tables/csv_table.h"
#include "io/tables/line_numbers.h"

#include <cstddef>
#include <functional>
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

struct RowsRead {
  std::vector<char> is_text;  // by column: not zero if a cell of it is text
  RowPlace next;              // after the last row
};

// Appends the rows from that place on to the columns, and the numbers of their lines to `lines`. Lines
// of empty cells are no rows. is_end: whether a line, by its cells, is not part of the table any more;
// it is not asked for rows of numbers alone. name: of the file.
RowsRead append_rows(
    std::string_view text, RowPlace from, const Dialect& dialect, const std::string& name,
    std::vector<CsvColumn>& columns, LineNumbers& lines,
    const std::function<bool(const TextLine&, const std::vector<std::string_view>&)>& is_end);

}  // namespace viscard
