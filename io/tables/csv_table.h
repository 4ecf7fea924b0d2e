#pragma once

#include "io/tables/line_numbers.h"
#include "models/quantities/modulus_kind.h"
#include "models/quantities/plausible.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace viscard {

// One column of a CsvTable.
struct CsvColumn {
  std::string header;          // as written: "Force [nN]"; "" without a header
  std::string name;            // without the bracketed unit: "Force"
  std::string unit;            // bracketed or from the row of units: "nN"; "" if none
  std::vector<double> values;  // as written, one per row; NaN where the cell is not a finite number
  std::vector<std::string> text;  // all cells, if one of them is text; otherwise empty
  // The first cell that is not a finite number: its line (from 1; 0 if there is none) and its text.
  std::size_t first_bad_line = 0;
  std::string first_bad_cell;
  // Of a computed column: the header that it follows from, and the kind of modulus that this one states.
  std::string derived_from;
  std::optional<ModulusKind> modulus_kind;
  double zero_unsure_s = 0.0;  // of clock times: by how much their begin was assumed
};

// Reads a table of numbers from any machine: with or without header, with or without a second row
// of units; comma, semicolon, tab or blanks between cells; decimal point or comma; comments (#, %,
// //), blank lines, quoted cells; UTF-8 with or without BOM, UTF-16, any line end. column_map.h
// finds the columns by quantity.
struct CsvTable {
  std::string file;
  std::vector<CsvColumn> columns;     // all of the same length
  LineNumbers lines;                  // line of the file, from 1, of each row
  std::vector<std::string> preamble;  // lines before the header, which are not part of the table
  std::vector<std::string>
      comments;  // at the very begin of a text, before any other line; without marks
  std::vector<std::string> notes;  // how it was read, where that was not plain: sentences
  bool has_header = false;
  char separator = ',';  // ' ' for runs of blanks
  bool has_decimal_comma = false;
  std::string maker;  // whose file it is ("JPK force curve"), if it was recognised (maker_table.h)
  // Quantities of this maker's columns that their headers do not name, as --column writes them.
  std::map<std::string, std::string> maker_columns;
  std::optional<ModulusKind> modulus_kind;  // that a maker's format has, if the headers state none
  Plausible judged = Plausible::kMeasured;  // how column_SI() judges the numbers
};

// Which table of a file is meant.
struct TableChoice {
  std::string sheet;      // of an Excel workbook, or struct of a MATLAB file; empty: most numbers
  std::size_t table = 0;  // of those in the sheet or file, from 1; 0: the one with most numbers
  std::size_t skip = 0;   // lines at the begin of a text file that are not read
};

// Throws std::runtime_error naming the file (and line) if it is missing, empty, not text, or has
// rows of different lengths. A cell may hold no number; column_map.h refuses it in a used column.
CsvTable read_csv(const std::filesystem::path& path, const TableChoice& choice = {});

// The same from bytes; name stands for the file in messages.
CsvTable csv_from_text(std::string_view bytes, const std::string& name,
                       const TableChoice& choice = {});

}  // namespace viscard
