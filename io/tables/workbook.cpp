#include "io/tables/workbook.h"

#include "io/basics/words.h"
#include "io/tables/table_limits.h"

#include <pugixml.hpp>
#include <zip.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <vector>

namespace viscard {
namespace {

[[noreturn]] void fail_workbook(const std::string& name, const std::string& what) {
  throw std::runtime_error(name + ": is no readable Excel workbook (" + what +
                           "); save the sheet as CSV");
}

std::string in_MiB(std::size_t n_bytes) {
  return std::to_string(n_bytes >> 20) + " MiB";
}

// How often an element begins: "<row" of "<row r="1">" and "<row/>", not of "<rowBreaks>".
std::size_t n_elements(std::string_view text, std::string_view begin) {
  std::size_t count = 0;
  for (std::size_t at = text.find(begin); at != std::string_view::npos;) {
    at += begin.size();
    count +=
        at < text.size() && std::string_view(" \t\r\n/>").find(text[at]) != std::string_view::npos
            ? 1
            : 0;
    at = text.find(begin, at);
  }
  return count;
}

// How many elements of a name a part may have.
struct ElementLimit {
  std::string_view begin;  // "<row"
  std::size_t most = 0;
  const char* what;  // "rows"
};

class Archive {
 public:
  Archive(std::string_view bytes, std::string name)
      : name_(std::move(name)), n_bytes_(bytes.size()) {
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

  // Counts before it parses, because a parsed element takes ten times the memory of its text.
  pugi::xml_document xml(const std::string& part, const ElementLimit& limit = {"", 0, ""}) {
    zip_stat_t stat{};
    if (zip_stat(zip_.get(), part.c_str(), 0, &stat) != 0) fail_workbook(name_, "it lacks " + part);
    if (stat.size / kMostFromPacked > n_bytes_) fail_workbook(name_, part + " is damaged");
    n_unpacked_ += std::min<std::size_t>(stat.size, kMostWorkbookBytes + 1);
    if (stat.size > kMostPartBytes) refuse(part, "more than " + in_MiB(kMostPartBytes));
    if (n_unpacked_ > kMostWorkbookBytes) {
      refuse("the workbook, up to " + part + ",", "more than " + in_MiB(kMostWorkbookBytes));
    }
    const std::unique_ptr<zip_file_t, decltype(&zip_fclose)> file(
        zip_fopen(zip_.get(), part.c_str(), 0), &zip_fclose);
    std::string text(stat.size, '\0');
    std::size_t size = 0;
    while (file && size < text.size()) {
      const zip_int64_t count = zip_fread(file.get(), text.data() + size, text.size() - size);
      if (count <= 0) break;
      size += static_cast<std::size_t>(count);
    }
    char beyond = '\0';  // libzip compares the checksum when it meets the end
    const bool is_whole = file && size == text.size() && zip_fread(file.get(), &beyond, 1) == 0;
    if (!is_whole) fail_workbook(name_, part + " is damaged");
    if (static_cast<std::size_t>(std::count(text.begin(), text.end(), '<')) > kMostPartTags) {
      refuse(part, "more than " + std::to_string(kMostPartTags) + " tags");
    }
    if (!limit.begin.empty() && n_elements(text, limit.begin) > limit.most) {
      refuse(part, "more than " + std::to_string(limit.most) + " " + limit.what);
    }
    pugi::xml_document document;
    if (!document.load_buffer(text.data(), text.size())) {
      fail_workbook(name_, part + " is damaged");
    }
    return document;
  }

 private:
  struct Discard {
    void operator()(zip_t* zip) const { zip_discard(zip); }
  };
  [[noreturn]] void refuse(const std::string& part, const std::string& what) const {
    throw std::runtime_error(name_ + ": " + part + " has " + what +
                             ", the limit; save the sheet as CSV, or leave out what is no data");
  }
  std::string name_;
  std::size_t n_bytes_;         // of the archive
  std::size_t n_unpacked_ = 0;  // bytes of the parts so far
  std::unique_ptr<zip_t, Discard> zip_;
};

struct Sheet {
  std::string name, part;
};

std::vector<Sheet> sheets_of(Archive& archive) {
  const pugi::xml_document book = archive.xml("xl/workbook.xml");
  const pugi::xml_document relations = archive.xml("xl/_rels/workbook.xml.rels");
  std::map<std::string, std::string> targets;
  for (const auto relation : relations.child("Relationships").children("Relationship")) {
    targets.emplace(relation.attribute("Id").value(), relation.attribute("Target").value());
  }
  std::vector<Sheet> sheets;
  for (const auto sheet : book.child("workbook").child("sheets").children("sheet")) {
    const auto found = targets.find(sheet.attribute("r:id").value());
    if (found == targets.end()) continue;
    const std::string& target = found->second;
    sheets.push_back({sheet.attribute("name").value(),
                      target.rfind('/', 0) == 0 ? target.substr(1) : "xl/" + target});
  }
  return sheets;
}

// The text of an element, also in several runs of different fonts.
std::string runs_of(const pugi::xml_node& node) {
  std::string text = node.child("t").text().get();
  for (const auto run : node.children("r")) text += run.child("t").text().get();
  // Of 4 bytes at most.
  if (text.size() > 4 * kLongestCell) {
    throw std::runtime_error("a cell has a text of " + std::to_string(text.size()) +
                             " bytes; a sheet can have " + std::to_string(kLongestCell) +
                             " characters in a cell");
  }
  return text;
}

std::vector<std::string> shared_strings(Archive& archive) {
  std::vector<std::string> strings;
  if (!archive.has("xl/sharedStrings.xml")) return strings;
  const pugi::xml_document document =
      archive.xml("xl/sharedStrings.xml", {"<si", kMostSharedTexts, "shared texts"});
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
SheetRows rows_of_sheet(Archive& archive, const Sheet& sheet,
                        const std::vector<std::string>& strings) {
  const pugi::xml_document document = archive.xml(sheet.part, {"<row", kSheetRows, "rows"});
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
    // A shared text may stand in a million cells, and a cell in the last column needs 16384 separators.
    if (n_bytes > kMostSheetBytes) {
      throw std::runtime_error("the sheet '" + sheet.name + "' has more than " +
                               in_MiB(kMostSheetBytes) +
                               " of text, the limit; remove the columns that are no data");
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
  Archive archive(bytes, name);
  const std::vector<std::string> strings = shared_strings(archive);
  const std::vector<Sheet> sheets = sheets_of(archive);
  if (sheets.size() > kMostSheets) {
    throw std::runtime_error("has " + std::to_string(sheets.size()) + " sheets; at most " +
                             std::to_string(kMostSheets) + " are read");
  }
  SheetText best;
  std::size_t most = 0;
  std::vector<std::string> names;
  std::set<std::string> parts;  // sheets with the same one have the same rows
  bool is_found = false;
  for (const Sheet& one : sheets) {
    names.push_back(one.name);
    if (!sheet.empty() && one.name != sheet) continue;
    if (!parts.insert(one.part).second) continue;
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
