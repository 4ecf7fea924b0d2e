#pragma once

#include "io/tables/column_names.h"
#include "io/tables/csv_table.h"

#include <string>
#include <vector>

namespace viscard {

// The words of a header in lower case: "AdjustedForce (N)" has adjusted, force and n. Letters beyond
// ASCII stay as they are.
std::vector<std::string> words_of_header(const std::string& header);

// True if a name of the quantity, of three bytes or more, stands among the words. For a proposal
// only: it does not say that the column is that quantity.
bool speaks_of(const CsvColumn& column, const ColumnKind& quantity);

// True for a column that numbers its rows 1, 2, 3 ... or 0, 1, 2 ... and says so (point, row, No.).
bool is_counter(const CsvColumn& column);

}  // namespace viscard
