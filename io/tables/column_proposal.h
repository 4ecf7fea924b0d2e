#pragma once

#include "io/tables/csv_table.h"

#include <string>

namespace viscard {

// "1 'a' (0, 1, 2, ...), 2 'b' in mm (5, 5.1, 5.2, ...)": the columns with their first values.
std::string columns_with_values(const CsvTable& table);

// What is wrong with a column that has the name of a quantity and a unit that is none: "column 2 'E (Mpa)' is by
// its name ..., but 'Mpa' is not a known unit", with the unit that was meant if capitals alone differ. Empty: nothing.
std::string unknown_unit(const CsvTable& table);

// Words that would read the table as a test, such as "--column time_s=1 --column modulus_Pa=2", by
// units where there are some and by the order of the columns otherwise. Empty if fewer than two
// columns hold numbers only.
std::string proposed_words(const CsvTable& table);

}  // namespace viscard
