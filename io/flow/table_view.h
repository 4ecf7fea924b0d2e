#pragma once

#include "fit/master_segments.h"
#include "io/flow/fit_request.h"

#include <cstddef>
#include <string>
#include <vector>

namespace viscard {

class ResultVisitor;

// How a fit reads a column of a table.
struct ViewedColumn {
  std::size_t number = 0;          // from 1
  std::string header, unit;        // as written
  std::string quantity;            // "force_N"; empty: of no known quantity
  bool is_used = false;            // the fit of this kind of test reads it
  double factor = 1.0;             // SI unit per unit of the table
  double offset = 0.0;             // in the SI unit
  std::string guessed;             // what was assumed of it, as a sentence; empty: nothing
  std::string derived_from;        // of a computed column: the header that it follows from
  std::size_t n_gaps = 0;          // cells that are no finite number
  std::string first_gap;           // "line 7: 'n/a'"
  std::vector<std::string> cells;  // of the first rows, as numbers of the table
};

// A table as a fit reads it, before it fits.
struct TableView {
  std::string path, maker, separator;  // separator: "comma", "tab" ...
  bool has_header = false, has_decimal_comma = false;
  std::size_t n_rows = 0;
  std::string kind, kind_trouble;               // of test; or why there is none
  std::string modulus_kind, modulus_kind_from;  // empty: forces
  std::vector<std::string> notes;               // how it was read, where that was not plain
  std::vector<std::size_t> lines;               // of the file, of the rows that `cells` show
  std::vector<ViewedColumn> columns;
  std::vector<MasterSegment> isotherms;  // of a table that makes a master curve
};

// Reads a table, or the table of a capture, as fit_file() does. Columns of no known quantity, or of none
// that a test has, are shown and not refused. Throws what read_csv() and read_capture() throw.
TableView view_table(const std::string& path, const FitRequest& request);

void show_keys(ResultVisitor& v, const TableView& view);

}  // namespace viscard
