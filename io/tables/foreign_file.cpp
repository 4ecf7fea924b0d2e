#include "io/tables/foreign_file.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <stdexcept>

namespace viscard {
namespace {

struct Magic {
  std::string_view bytes;
  const char* what;
};

using namespace std::string_view_literals;
constexpr const char* kSaveSheet = "no readable Excel workbook; save its sheet as CSV";
constexpr Magic kMagic[] = {
    {"\x89PNG\r\n"sv, "a PNG picture, not a table"},
    {"\xff\xd8\xff"sv, "a JPEG picture, not a table"},
    {"GIF8"sv, "a GIF picture, not a table"},
    {"II*\0"sv, "a TIFF picture, not a table"},
    {"MM\0*"sv, "a TIFF picture, not a table"},
    {"%PDF-"sv, "a PDF document, not a table; export the numbers as CSV"},
    {"\xd0\xcf\x11\xe0"sv, "an old Office document (.xls), not text; save its sheet as CSV"},
    {"\x1f\x8b"sv, "compressed with gzip; unpack it first"},
    {"\x89HDF\r\n"sv, "an HDF5 file, not text; export its arrays as CSV"},
    {"MATLAB 5.0 MAT-file"sv, "a MATLAB file, not text; export its arrays as CSV"},
    {"<svg"sv, "an SVG picture, not a table"}};

bool is_key(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.';
  });
}

// Lines of TOML only: [section], key = value, comments.
bool is_toml(std::string_view text) {
  std::size_t n_keys = 0, n_lines = 0;
  constexpr std::size_t kEnough = 12;
  while (!text.empty() && n_lines < kEnough) {
    const std::size_t end = std::min(text.size(), text.find('\n'));
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(text.size(), end + 1));
    if (line.empty() || line.front() == '#') continue;
    ++n_lines;
    if (line.front() == '[' && is_key(line.substr(1, std::min(line.find(']'), line.size()) - 1))) {
      const bool closes = line.find(']') != std::string_view::npos;
      if (closes && line.find_first_of(",;\t") == std::string_view::npos) continue;
    }
    const std::size_t equals = line.find(" = ");
    if (equals == std::string_view::npos || !is_key(trimmed(line.substr(0, equals)))) return false;
    ++n_keys;
  }
  return n_keys > 0;
}

}  // namespace

void refuse_foreign_file(std::string_view bytes, const std::string& name) {
  for (const Magic& magic : kMagic) {
    if (bytes.substr(0, magic.bytes.size()) == magic.bytes) {
      throw std::runtime_error(name + ": is " + magic.what);
    }
  }
  const std::string_view head = bytes.substr(0, 4096);
  if (head.substr(0, 4) == "PK\x03\x04") {
    const bool is_sheet = bytes.find("xl/worksheets") != std::string_view::npos;
    throw std::runtime_error(
        name + ": is " + (is_sheet ? kSaveSheet : "a zip archive, not a table; unpack it first"));
  }
  const std::string_view text = trimmed(head.substr(head.substr(0, 3) == "\xef\xbb\xbf" ? 3 : 0));
  const std::size_t inside = text.find_first_not_of(" \t\r\n", 1);
  if (!text.empty() && text.front() == '{' && inside != std::string_view::npos &&
      (text[inside] == '"' || text[inside] == '}')) {
    throw std::runtime_error(name +
                             ": is JSON, not a table; fit needs the measured columns as text");
  }
  if (is_toml(text)) {
    throw std::runtime_error(name +
                             ": is a TOML file (a rig, test, specimen or scene), not a table; a "
                             "specimen is given with --specimen FILE beside the table");
  }
}

}  // namespace viscard
