#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace viscard {

// A table of numbers from any machine: header or none, second row of units, comma, semicolon, tab
// or blanks between cells, decimal point or comma, comments (#, %, //), blank lines, quoted cells,
// UTF-8 with or without BOM, UTF-16, any line end. io/column_map.h finds the columns by quantity.
struct CsvColumn {
  std::string header;             // as written: "Force [nN]"; "" without a header
  std::string name;               // without its bracketed unit: "Force"
  std::string unit;               // bracketed or from the row of units: "nN"; "" if none
  std::vector<double> values;     // as written, one per row; NaN where the cell is no finite number
  std::vector<std::string> text;  // every cell of a column that has a cell of text; else empty
  // First cell that is no finite number: its line (from 1; 0 if there is none) and what stands
  // there.
  std::size_t first_bad_line = 0;
  std::string first_bad_cell;
};

struct CsvTable {
  std::string file;
  std::vector<CsvColumn> columns;     // all of the same length
  std::vector<std::uint32_t> lines;   // line of the file, from 1, of each row
  std::vector<std::string> preamble;  // lines before the header that are no part of the table
  bool has_header = false;
  char separator = ',';  // ' ' for runs of blanks
  bool has_decimal_comma = false;
};

// Throws std::runtime_error naming the file (and line) when it is missing, empty, not text, or has
// rows of different lengths. Cells that are no numbers are no error here: see column_map.h.
CsvTable read_csv(const std::filesystem::path& path);

// The same from bytes; name stands for the file in messages.
CsvTable csv_from_text(std::string_view bytes, const std::string& name);

}  // namespace viscard
