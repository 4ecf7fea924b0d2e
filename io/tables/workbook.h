#pragma once

#include <string>
#include <string_view>

namespace viscard {

// Excel workbooks (.xlsx, ECMA-376): a zip archive of XML files, one for each sheet.
bool is_workbook(std::string_view bytes);

// One sheet as text: a line for each row of the sheet, cells separated by tabs.
struct SheetText {
  std::string sheet;  // its name
  std::string text;
  std::size_t n_sheets = 0;
};

// The sheet of that name, or the one with most numbers if the name is empty. Throws
// std::runtime_error naming the file if it is damaged, or with a list of the sheets if none has
// that name.
SheetText sheet_text(std::string_view bytes, const std::string& name, const std::string& sheet);

}  // namespace viscard
