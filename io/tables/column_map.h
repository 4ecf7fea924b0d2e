#pragma once

#include "io/tables/csv_table.h"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace viscard {

// Finds the columns of a table by quantity. Each quantity has one name in viscard, which ends in
// its SI unit: time_s, force_N, depth_m, modulus_Pa, stress_Pa, strain, nominal_stress_Pa, stretch, compliance_1_Pa,
// relative_modulus, complex_modulus_Pa, complex_viscosity_Pa_s, phase_rad, tan_delta, true_stress_Pa, true_strain,
// frequency_Hz, storage_modulus_Pa, loss_modulus_Pa, mass_kg, volts_V, position_m, temperature_C,
// segment, specimen. The table's own headers are matched by name and unit ("t (s)", "Force [mN]", "E_relax"
// over "MPa"); a ColumnMap overrides the match.

// Quantity name to the right-hand side of --column NAME=EXPRESSION, which is [factor*][-]column.
// The column is a header as written, a header without its unit, or a column number from 1. A unit
// in brackets after it overrides the table's unit ("2 [ms]").
using ColumnMap = std::map<std::string, std::string>;

// Reads words of the form NAME=EXPRESSION. Throws std::invalid_argument naming the word if it has
// no '=', or if its name is unknown (with the nearest known name) or given twice.
ColumnMap column_map_from_words(const std::vector<std::string>& words);

// The column of a quantity. Value in SI = factor * value in the table + offset.
struct ColumnUse {
  std::size_t index = 0;
  double factor = 1.0;      // SI unit per unit of the table
  double offset = 0.0;      // in the SI unit
  std::string description;  // "force_N: column 2 'Force [nN]' x 1e-09"
  // Neither the table nor --column states a unit, so the SI unit was taken.
  bool is_unit_assumed = false;
  // A force in a unit of mass, "Load (kg)": the weight of that mass was taken.
  bool is_weight = false;
  // The table or --column states a unit ("%", "-") or a factor.
  bool is_unit_stated = false;
  double written_factor = 1.0;  // that of --column
};

// Returns nothing if the table has no such column. Throws std::runtime_error if the map names a
// column that does not exist (with a list of the columns), if two columns match equally well, or if
// the unit does not measure the quantity.
std::optional<ColumnUse> find_column(const CsvTable& table, const std::string& name,
                                     const ColumnMap& map = {});

// Returns the values in SI. Throws std::runtime_error as find_column() does, and if the column does
// not exist (with a list of the columns), a cell is not a finite number (with file, line, column and
// the text of the cell), or the values are not plausible (with what to write instead).
std::vector<double> column_SI(const CsvTable& table, const std::string& name,
                              const ColumnMap& map = {});

// What to write where the numbers of a column are in another unit: "write --column
// 'modulus_Pa=1e6*E'", for 1e6 SI units in theirs. Quoted for a shell, because a header is somebody's text.
// factor: the pure number by which a column is multiplied.
std::string words_for_factor(const CsvTable& table, const std::string& name, const ColumnUse& use,
                             double factor);

// As column_SI(), but a cell that is not a finite number gives nan, and any value is taken.
std::vector<double> column_with_gaps_SI(const CsvTable& table, const std::string& name,
                                        const ColumnMap& map = {});

// Returns the table without the rows in which one of these columns has a gap (an empty cell, NaN, "n/a");
// n_left_out counts them. Other cells that are no numbers stay, and column_SI() refuses them.
CsvTable rows_without_gaps(CsvTable table, const std::vector<std::string>& names,
                           const ColumnMap& map, std::size_t& n_left_out);

// Returns the cells as text, for "segment" and "specimen". Throws std::runtime_error if the column does not exist.
std::vector<std::string> column_text(const CsvTable& table, const std::string& name,
                                     const ColumnMap& map = {});

// Returns the table with only the rows of one segment. Throws std::runtime_error with a list of the
// segments if none has that name.
CsvTable rows_of_segment(const CsvTable& table, const std::string& segment,
                         const ColumnMap& map = {});

// Returns the table with only these rows, ascending. Their bad cells are found anew.
CsvTable chosen_rows(const CsvTable& table, const std::vector<std::size_t>& rows);

}  // namespace viscard
