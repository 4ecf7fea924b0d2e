#include "io/cli/fit/fit_command.h"
#include "io/cli/words/fitted_text.h"
#include "io/cli/words/json_output.h"
#include "io/flow/table_view.h"
#include "models/maths/text_of_number.h"

#include <ostream>
#include <stdexcept>

namespace viscard {
namespace {

void print_table(const TableView& view, std::ostream& out) {
  out << view.path << ": " << counted(view.n_rows, "row") << ", "
      << (view.maker.empty() ? "divided by " + view.separator : view.maker)
      << (view.has_header ? "" : ", no header") << (view.has_decimal_comma ? ", decimal comma" : "")
      << "\n";
  if (view.kind.empty()) {
    out << "kind of test: none. " << view.kind_trouble << "\n";
  } else {
    out << "kind of test: " << view.kind;
    if (!view.modulus_kind.empty()) {
      out << "; moduli of " << view.modulus_kind
          << (view.modulus_kind_from == "assumed" ? " (assumed)"
                                                  : " (by " + view.modulus_kind_from + ")");
    }
    out << "\n";
  }
  for (const ViewedColumn& column : view.columns) {
    out << "column " << column.number << " '" << column.header << "': "
        << (column.quantity.empty()
                ? "not known"
                : column.quantity + (column.is_used ? ", fitted" : ", not used"));
    if (column.factor != 1.0) out << ", x " << text_of(column.factor);
    if (!column.derived_from.empty()) out << ", computed from " << column.derived_from;
    if (!column.guessed.empty()) out << "; " << column.guessed;
    if (column.n_gaps > 0) {
      out << "; " << counted(column.n_gaps, "cell") << " without a number (" << column.first_gap
          << ")";
    }
    out << "\n";
  }
  if (!view.isotherms.empty()) {
    out << "isotherms: " << temperatures_of(view.isotherms) << "\n";
  }
  for (const std::string& note : view.notes) out << "note: " << note << "\n";
}

}  // namespace

DescribedResult result_of_table() {
  return described<TableView>("table", "viscard fit --show-table");
}

int show_tables(const std::vector<std::string>& files, const FitRequest& request, bool as_json,
                Streams& streams) {
  if (as_json && files.size() > 1) {
    throw UsageError("--show-table --json shows one table; name one file");
  }
  FittedText out(streams);
  for (const std::string& file : files) {
    const TableView view = view_table(file, request);
    if (!as_json) {
      print_table(view, out);
      continue;
    }
    print_result(
        {"viscard-table/1", {file}}, [&](ResultVisitor& v) { show_keys(v, view); }, streams);
  }
  return kDone;
}

}  // namespace viscard
