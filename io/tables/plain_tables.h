#pragma once

#include "io/tables/csv_table.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace viscard {

// All tables of a UTF-8 text that is no file of a maker: below each other, each with its own header. name:
// of the file, for messages; skip: lines at its begin that are not read. Throws std::runtime_error, which
// begins with "line N" if it is about one line.
std::vector<CsvTable> plain_tables(std::string_view text, const std::string& name,
                                   std::size_t skip = 0);

}  // namespace viscard
