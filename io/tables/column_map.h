#pragma once

#include "io/tables/csv_table.h"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// Columns have one name each in viscard, with the SI unit in it: time_s, force_N, depth_m,
// modulus_Pa, stress_Pa, strain, compliance_1_Pa, frequency_Hz, storage_modulus_Pa,
// loss_modulus_Pa, mass_kg, volts_V, position_m, temperature_C, segment. A table's own header is
// matched by name and unit ("t (s)", "Force [mN]", "E_relax" over "MPa"), or by what the user says
// in a ColumnMap.

// Right-hand sides of --column NAME=EXPRESSION: [factor*][-]column, where column is a header as
// written, a header without its unit, or a number counting columns from 1; a unit in brackets
// behind it overrides the table's ("2 [ms]").
using ColumnMap = std::map<std::string, std::string>;

// Reads words of the form NAME=EXPRESSION. Throws std::invalid_argument naming the word when there
// is no '=', the name is unknown (with the nearest known one) or given twice.
ColumnMap column_map_from_words(const std::vector<std::string>& words);

// Where a quantity was found and how its values become SI: factor * value + offset.
struct ColumnUse {
  std::size_t index = 0;
  double factor = 1.0;
  double offset = 0.0;
  std::string description;  // "force_N: column 2 'Force [nN]' x 1e-09"
};

// Nothing when the table has no such column. Throws std::runtime_error when the map names a column
// that is not there (listing those that are), when two columns would fit, or when a unit does not.
std::optional<ColumnUse> find_column(const CsvTable& table, const std::string& name,
                                     const ColumnMap& map = {});

// Values in SI. Throws std::runtime_error as find_column() does, when the column is not there
// (listing those that are), or when a cell is no finite number (file, line, column, what stands
// there).
std::vector<double> column_SI(const CsvTable& table, const std::string& name,
                              const ColumnMap& map = {});

// Cells as text, for "segment". Throws std::runtime_error when the column is not there.
std::vector<std::string> column_text(const CsvTable& table, const std::string& name,
                                     const ColumnMap& map = {});

// The table with only the rows whose segment column says so; throws std::runtime_error naming the
// segments there are.
CsvTable rows_of_segment(const CsvTable& table, const std::string& segment,
                         const ColumnMap& map = {});

}  // namespace viscard
