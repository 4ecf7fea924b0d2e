#pragma once

#include "io/tables/csv_table.h"

#include <cstddef>
#include <vector>

namespace viscard {

// The tables that stand side by side in one, divided by empty columns or by headers that repeat; the
// table itself if it is one.
std::vector<CsvTable> tables_side_by_side(CsvTable table);

// The table of that number, from 1; 0: the one with most numbers, with a note if there are others.
// Throws std::runtime_error if there is none of that number.
CsvTable chosen_table(std::vector<CsvTable> tables, std::size_t number);

}  // namespace viscard
