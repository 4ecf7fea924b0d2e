#pragma once

#include "io/tables/csv_table.h"

namespace viscard {

// Takes the antilogarithm of columns whose headers say that they hold logarithms of a known quantity: "log10 E'
// (Pa)", "lg t", "log f (Hz)" to base 10, "ln J" to base e. The notes of the table state each.
void take_antilogarithms(CsvTable& table);

}  // namespace viscard
