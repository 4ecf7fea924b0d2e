#include "io/flow/table_view.h"

#include "io/basics/number_text.h"
#include "io/capture/capture_file.h"
#include "io/capture/capture_header.h"
#include "io/flow/damaged_table.h"
#include "io/flow/fit_file.h"
#include "io/flow/fit_table.h"
#include "io/flow/table_from_capture.h"
#include "io/flow/table_kind.h"
#include "io/tables/column_names.h"
#include "io/tables/modulus_of_columns.h"
#include "models/maths/result_visitor.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace viscard {
namespace {

constexpr std::size_t kShownRows = 100;

std::string name_of_separator(char separator) {
  switch (separator) {
    case ',':
      return "comma";
    case ';':
      return "semicolon";
    case '\t':
      return "tab";
    case ' ':
      return "blanks";
    default:
      return std::string(1, separator);
  }
}

ViewedColumn viewed(const CsvColumn& column, std::size_t number) {
  ViewedColumn view{.number = number, .header = column.header, .unit = column.unit};
  view.derived_from = column.derived_from;
  const bool is_text = !column.text.empty();
  for (std::size_t i = 0; i < column.values.size(); ++i) {
    const bool is_number = std::isfinite(column.values[i]);
    if (!is_number) ++view.n_gaps;
    if (i >= kShownRows) continue;
    view.cells.push_back(is_text     ? column.text[i]
                         : is_number ? text_from_number(column.values[i])
                                     : "");
  }
  if (is_text && view.n_gaps == column.values.size()) view.n_gaps = 0;  // a column of words
  if (view.n_gaps > 0 && column.first_bad_line > 0) {
    view.first_gap =
        "line " + std::to_string(column.first_bad_line) + ": '" + column.first_bad_cell + "'";
  }
  return view;
}

std::string guess_of(const ColumnUse& use, const std::string& quantity) {
  if (use.is_unit_assumed) {
    const std::size_t unit = quantity.find('_');
    return "no unit is stated; it was taken as in SI, " +
           (unit == std::string::npos ? quantity : quantity.substr(unit + 1));
  }
  if (use.is_weight) return "a unit of mass; the weight of that mass was taken";
  return "";
}

// Each column is shown as that quantity for which the fit reads it, else as the first that it may be.
void add_quantities(const CsvTable& table, const FitRequest& request,
                    const std::vector<std::string>& used, TableView& view) {
  std::vector<std::string> names = used;
  for (const std::string& name : column_names()) {
    if (std::find(used.begin(), used.end(), name) == used.end()) names.push_back(name);
  }
  for (std::size_t k = 0; k < names.size(); ++k) {
    std::optional<ColumnUse> use;
    try {
      use = find_column(table, names[k], request.columns);
    } catch (const std::exception& error) {
      view.notes.emplace_back(error.what());
    }
    if (!use || !view.columns[use->index].quantity.empty()) continue;
    ViewedColumn& column = view.columns[use->index];
    column.quantity = names[k];
    column.is_used = k < used.size();
    column.factor = use->factor;
    column.offset = use->offset;
    if (column.is_used) column.guessed = guess_of(*use, names[k]);
  }
}

void add_kind(const CsvTable& table, const FitRequest& request, std::vector<std::string>& used,
              TableView& view) {
  try {
    const FitKind kind = kind_of_table(table, request);
    view.kind = name_of_kind(kind);
    used = columns_of_kind(kind, table, request);
    used.emplace_back("temperature_C");
    const bool has_forces = kind == FitKind::kIndentation || is_force_alone(table, request);
    if (has_forces) return;
    if (request.modulus_kind) {
      view.modulus_kind = text_of(*request.modulus_kind).word;
      view.modulus_kind_from = "--modulus-kind";
      return;
    }
    const TableModulusKind found = modulus_kind_of(table, request.columns, used);
    view.modulus_kind = text_of(found.kind).word;
    view.modulus_kind_from = found.is_assumed ? "assumed" : found.from;
  } catch (const std::exception& error) {
    view.kind_trouble = error.what();
  }
}

}  // namespace

TableView view_table(const std::string& path, const FitRequest& request) {
  TableView view;
  const bool is_capture = looks_like_capture(path);
  CsvTable table = is_capture
                       ? csv_from_text(table_from_capture(read_capture(
                                           path, {.accepts_damage = request.accepts_unverified})),
                                       path)
                       : read_csv(path, request.table);
  view.path = path;
  view.maker = is_capture ? "viscard capture" : table.maker;
  view.separator = name_of_separator(table.separator);
  view.has_header = table.has_header;
  view.has_decimal_comma = table.has_decimal_comma;
  view.n_rows = table.lines.size();
  table.judged = request.plausible;
  std::vector<std::string> used;
  try {
    SpecimenSize size = request.size;
    if (!request.specimen && !request.depth_m) size = size_from_notes(table, size);
    derive_columns(table, request.columns, size);
  } catch (const std::exception& error) {
    view.kind_trouble = error.what();
  }
  if (view.kind_trouble.empty()) add_kind(table, request, used, view);
  const std::size_t n_shown = std::min(kShownRows, view.n_rows);
  for (std::size_t i = 0; i < n_shown; ++i) view.lines.push_back(table.lines[i]);
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    view.columns.push_back(viewed(table.columns[i], i + 1));
  }
  view.notes = table.notes;
  for (const IntegrityNote& note : damage_of_table(table)) view.notes.push_back(note.text);
  add_quantities(table, request, used, view);
  try {
    if (!view.kind.empty()) view.isotherms = isotherms_of(std::move(table), request);
  } catch (const std::exception&) {  // the fit states why there are none
  }
  return view;
}

void show_keys(ResultVisitor& v, const TableView& view) {
  v("file", view.path, "the table or capture");
  v("maker", view.maker, "maker of the machine that wrote it; empty: not recognised");
  v("separator", view.separator, "between cells: comma, semicolon, tab, blanks");
  v("has_header", view.has_header, "whether a row of names stands above the numbers");
  v("decimal_comma", view.has_decimal_comma, "whether numbers have a comma, 1,5");
  v("n_rows", view.n_rows, "rows of numbers");
  v("kind", view.kind, "kind of test that the columns are of, or that was stated; empty: none");
  v("kind_trouble", view.kind_trouble, "why there is none, and what to state; empty: there is one");
  v("modulus_kind", view.modulus_kind, "what the moduli are of: tension, shear ...; empty: forces");
  v("modulus_kind_from", view.modulus_kind_from, "what states it; assumed: nothing does");
  v("notes", view.notes, "how the table was read, where that was not plain");
  v("lines", view.lines, "of the file, of the rows whose cells are shown");
  v.list("columns", "in the order of the table", view.columns, [&](const ViewedColumn& column) {
    v("number", column.number, "from 1, as in --column NAME=2");
    v("header", column.header, "as written");
    v("unit", column.unit, "as written; empty: none");
    v("quantity", column.quantity, "as in --column; empty: no known one");
    v("used", column.is_used, "whether the fit reads it");
    v("factor", column.factor, "SI unit per unit of the table");
    v("offset", column.offset, "in the SI unit");
    v("guessed", column.guessed, "what was assumed of it; empty: nothing");
    v("derived_from", column.derived_from,
      "the header that it was computed from; empty: it was read");
    v("n_gaps", column.n_gaps, "cells that are no number");
    v("first_gap", column.first_gap, "line and text of the first of them");
    v("cells", column.cells, "of the first rows, in the unit of the table");
  });
  v.list("isotherms", "rows at each temperature, if the fit makes a master curve", view.isotherms,
         [&](const MasterSegment& one) {
           v("temperature_C", one.temperature_C, "mean of its rows");
           v("argument", one.argument, "time in s; of a frequency sweep, frequency in Hz");
           v("modulus_Pa", one.value, "relaxation or storage modulus");
           v("loss_modulus_Pa", one.loss, "of a frequency sweep; else empty");
         });
}

}  // namespace viscard
