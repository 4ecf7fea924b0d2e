#include "io/tables/workbook.h"

#include "io/basics/words.h"

#include <pugixml.hpp>
#include <zip.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <vector>

namespace viscard {
namespace {

constexpr std::size_t kLongestText = 32767;  // characters of a cell, by the standard
// A shared text may stand in a million cells, and a cell in the last column needs 16384 separators.
constexpr std::size_t kMostBytesOfSheet = std::size_t{256} << 20;
constexpr std::size_t kMostSheets = 1000;
constexpr std::size_t kSheetColumns = 16384, kSheetRows = 1048576;  // of a sheet, by the standard
constexpr std::size_t kLongestPart = std::size_t{1} << 30;          // bytes, unpacked

[[noreturn]] void fail_workbook(const std::string& name, const std::string& what) {
  throw std::runtime_error(name + ": is no readable Excel workbook (" + what +
                           "); save the sheet as CSV");
}

class Archive {
 public:
  Archive(std::string_view bytes, std::string name) : name_(std::move(name)) {
    zip_error_t error{};
    zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
    if (source == nullptr) fail_workbook(name_, zip_error_strerror(&error));
    zip_.reset(zip_open_from_source(source, ZIP_RDONLY, &error));
    if (zip_) return;
    const std::string why = zip_error_strerror(&error);
    zip_source_free(source);
    fail_workbook(name_, why);
  }

  bool has(const std::string& part) const {
    return zip_name_locate(zip_.get(), part.c_str(), 0) >= 0;
  }

  pugi::xml_document xml(const std::string& part) const {
    zip_stat_t stat{};
    if (zip_stat(zip_.get(), part.c_str(), 0, &stat) != 0) fail_workbook(name_, "it lacks " + part);
    if (stat.size > kLongestPart) fail_workbook(name_, part + " is too long");
    const std::unique_ptr<zip_file_t, decltype(&zip_fclose)> file(
        zip_fopen(zip_.get(), part.c_str(), 0), &zip_fclose);
    std::string text(stat.size, '\0');
    std::size_t size = 0;
    while (file && size < text.size()) {
      const zip_int64_t count = zip_fread(file.get(), text.data() + size, text.size() - size);
      if (count <= 0) break;
      size += static_cast<std::size_t>(count);
    }
    pugi::xml_document document;
    if (size != text.size() || !document.load_buffer(text.data(), text.size())) {
      fail_workbook(name_, part + " is damaged");
    }
    return document;
  }

 private:
  struct Discard {
    void operator()(zip_t* zip) const { zip_discard(zip); }
  };
  std::string name_;
  std::unique_ptr<zip_t, Discard> zip_;
};

struct Sheet {
  std::string name, part;
};

std::vector<Sheet> sheets_of(const Archive& archive) {
  const pugi::xml_document book = archive.xml("xl/workbook.xml");
  const pugi::xml_document relations = archive.xml("xl/_rels/workbook.xml.rels");
  std::vector<Sheet> sheets;
  for (const auto sheet : book.child("workbook").child("sheets").children("sheet")) {
    const std::string id = sheet.attribute("r:id").value();
    for (const auto relation : relations.child("Relationships").children("Relationship")) {
      if (relation.attribute("Id").value() != id) continue;
      const std::string target = relation.attribute("Target").value();
      sheets.push_back({sheet.attribute("name").value(),
                        target.rfind('/', 0) == 0 ? target.substr(1) : "xl/" + target});
    }
  }
  return sheets;
}

// The text of an element, also in several runs of different fonts.
std::string runs_of(const pugi::xml_node& node) {
  std::string text = node.child("t").text().get();
  for (const auto run : node.children("r")) text += run.child("t").text().get();
  // Of 4 bytes at most.
  if (text.size() > 4 * kLongestText) {
    throw std::runtime_error("a cell has a text of " + std::to_string(text.size()) +
                             " bytes; a sheet can have " + std::to_string(kLongestText) +
                             " characters in a cell");
  }
  return text;
}

std::vector<std::string> shared_strings(const Archive& archive) {
  std::vector<std::string> strings;
  if (!archive.has("xl/sharedStrings.xml")) return strings;
  const pugi::xml_document document = archive.xml("xl/sharedStrings.xml");
  for (const auto item : document.child("sst").children("si")) strings.push_back(runs_of(item));
  return strings;
}

// "BC12" is in column 54, counted from 0; npos if it is no address.
std::size_t column_of(const char* address) {
  std::size_t column = 0;
  for (; *address >= 'A' && *address <= 'Z'; ++address) {
    column = column * 26 + static_cast<std::size_t>(*address - 'A' + 1);
    if (column > kSheetColumns) return std::string::npos;
  }
  return column - 1;
}

std::string cell_text(const pugi::xml_node& cell, const std::vector<std::string>& strings) {
  const std::string_view type = cell.attribute("t").value();
  if (type == "inlineStr") return runs_of(cell.child("is"));
  const char* value = cell.child("v").text().get();
  if (type != "s") return value;
  const std::size_t index = std::strtoul(value, nullptr, 10);
  return index < strings.size() ? strings[index] : "";
}

// As a cell of a table separated by tabs.
void append_cell(std::string& line, const std::string& text) {
  if (text.find_first_of("\t\r\n\"") == std::string::npos) {
    line += text;
    return;
  }
  line += '"';
  for (const char c : text) {
    if (c == '"') line += '"';
    line += c == '\t' || c == '\r' || c == '\n' ? ' ' : c;
  }
  line += '"';
}

struct SheetRows {
  std::string text;
  std::size_t n_numbers = 0;
};

// The rows as lines of equally many cells: a sheet leaves out empty ones at the end of a row.
SheetRows rows_of_sheet(const Archive& archive, const Sheet& sheet,
                        const std::vector<std::string>& strings) {
  const pugi::xml_document document = archive.xml(sheet.part);
  SheetRows rows;
  struct Line {
    std::string text;
    std::size_t width = 0;
  };
  std::vector<Line> lines;
  std::size_t width = 0;  // of the rows with numbers
  std::size_t n_bytes = 0;
  for (const auto row : document.child("worksheet").child("sheetData").children("row")) {
    const std::size_t number = row.attribute("r").as_uint(static_cast<unsigned>(lines.size() + 1));
    if (number > kSheetRows) break;
    while (lines.size() + 1 < number) lines.emplace_back();
    Line line;
    std::size_t at = 0, next = 0, n_numbers = 0;
    for (const auto cell : row.children("c")) {
      const char* address = cell.attribute("r").value();
      const std::size_t column = *address != '\0' ? column_of(address) : next;
      if (column >= kSheetColumns || column < at) continue;
      line.text.append(column - at, '\t');
      at = column;
      next = column + 1;
      append_cell(line.text, cell_text(cell, strings));
      const std::string_view type = cell.attribute("t").value();
      if (cell.child("v") && (type.empty() || type == "n")) ++n_numbers;
    }
    line.width = next;
    if (n_numbers > 0) width = std::max(width, next);
    rows.n_numbers += n_numbers;
    n_bytes += line.text.size();
    if (n_bytes > kMostBytesOfSheet) {
      throw std::runtime_error("the sheet '" + sheet.name + "' has more than " +
                               std::to_string(kMostBytesOfSheet >> 20) +
                               " MiB of text, the limit; remove the columns that are no data");
    }
    lines.push_back(std::move(line));
  }
  for (const Line& line : lines) {
    rows.text += line.text;
    if (line.width > 0 && line.width < width) rows.text.append(width - line.width, '\t');
    rows.text += '\n';
  }
  return rows;
}

}  // namespace

bool is_workbook(std::string_view bytes) {
  return bytes.substr(0, 4) == "PK\x03\x04" &&
         bytes.find("xl/workbook.xml") != std::string_view::npos;
}

namespace {

SheetText text_of_sheet(std::string_view bytes, const std::string& name, const std::string& sheet) {
  const Archive archive(bytes, name);
  const std::vector<std::string> strings = shared_strings(archive);
  const std::vector<Sheet> sheets = sheets_of(archive);
  if (sheets.size() > kMostSheets) {
    throw std::runtime_error("has " + std::to_string(sheets.size()) + " sheets; at most " +
                             std::to_string(kMostSheets) + " are read");
  }
  SheetText best;
  std::size_t most = 0;
  std::vector<std::string> names;
  bool is_found = false;
  for (const Sheet& one : sheets) {
    names.push_back(one.name);
    if (!sheet.empty() && one.name != sheet) continue;
    SheetRows rows = rows_of_sheet(archive, one, strings);
    if (is_found && rows.n_numbers <= most) continue;
    is_found = true;
    most = rows.n_numbers;
    best.sheet = one.name;
    best.text = std::move(rows.text);
  }
  if (!is_found && !sheet.empty()) {
    throw std::runtime_error(name + ": has no sheet '" + sheet + "'; there are " + listed(names));
  }
  best.n_sheets = sheets.size();
  return best;
}

}  // namespace

SheetText sheet_text(std::string_view bytes, const std::string& name, const std::string& sheet) {
  try {
    return text_of_sheet(bytes, name, sheet);
  } catch (const std::runtime_error& error) {
    const std::string text = error.what();
    if (text.starts_with(name)) throw;
    throw std::runtime_error(name + ": " + text);
  }
}

}  // namespace viscard
