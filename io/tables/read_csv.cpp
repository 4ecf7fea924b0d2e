#include "io/basics/atomic_file.h"
#include "io/tables/csv_dialect.h"
#include "io/tables/csv_table.h"
#include "io/tables/foreign_file.h"
#include "io/tables/maker_table.h"
#include "io/tables/matlab_file.h"
#include "io/tables/plain_tables.h"
#include "io/tables/table_choice.h"
#include "io/tables/text_encoding.h"
#include "io/tables/workbook.h"

#include <optional>
#include <stdexcept>
#include <utility>

namespace viscard {

CsvTable csv_from_text(std::string_view bytes, const std::string& name, const TableChoice& choice) {
  const std::string& sheet = choice.sheet;
  std::string converted, book;
  std::string_view text;
  if (is_workbook(bytes)) {
    SheetText found = sheet_text(bytes, name, sheet);
    converted = std::move(found.text);
    text = converted;
    book = "Excel workbook, sheet '" + found.sheet + "' of " + std::to_string(found.n_sheets);
  } else if (is_matlab_file(bytes)) {
    SheetText found = matlab_table_text(bytes, name, sheet);
    converted = std::move(found.text);
    text = converted;
    book = std::string(bytes.starts_with("\x89HDF") ? "HDF5" : "MATLAB") + " file" +
           (found.sheet.empty() ? "" : ", struct '" + found.sheet + "'");
  } else {
    refuse_foreign_file(bytes, name);
    if (!sheet.empty()) throw std::runtime_error(name + ": has no sheets; omit --sheet");
    text = utf8_view(bytes, name, converted);
  }
  try {
    std::optional<MakerTable> maker = maker_table(text, name);
    if (maker) text = maker->text;
    CsvTable table = chosen_table(plain_tables(text, name, choice.skip), choice.table);
    table.comments = leading_comments(text);
    if (maker) {
      table.maker = std::move(maker->maker);
      table.maker_columns = std::move(maker->columns);
      table.modulus_kind = maker->modulus_kind;
    }
    if (!table.modulus_kind) table.modulus_kind = kind_of_instrument(text);
    if (!book.empty()) table.maker += (table.maker.empty() ? "" : ", ") + book;
    return table;
  } catch (const std::runtime_error& error) {
    const std::string what = error.what();  // split_cells() does not know the file
    if (what.rfind("line ", 0) != 0) throw;
    throw std::runtime_error(name + ": " + what);
  }
}

CsvTable read_csv(const std::filesystem::path& path, const TableChoice& choice) {
  return csv_from_text(read_file(path, kLongestTable), path.string(), choice);
}

}  // namespace viscard
