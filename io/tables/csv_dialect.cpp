#include "io/tables/csv_dialect.h"

#include "io/basics/words.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace viscard {
namespace {

void append_utf8(std::string& out, char32_t code) {
  if (code < 0x80) {
    out += static_cast<char>(code);
  } else if (code < 0x800) {
    out += static_cast<char>(0xc0 | (code >> 6));
    out += static_cast<char>(0x80 | (code & 0x3f));
  } else if (code < 0x10000) {
    out += static_cast<char>(0xe0 | (code >> 12));
    out += static_cast<char>(0x80 | ((code >> 6) & 0x3f));
    out += static_cast<char>(0x80 | (code & 0x3f));
  } else {
    out += static_cast<char>(0xf0 | (code >> 18));
    out += static_cast<char>(0x80 | ((code >> 12) & 0x3f));
    out += static_cast<char>(0x80 | ((code >> 6) & 0x3f));
    out += static_cast<char>(0x80 | (code & 0x3f));
  }
}

unsigned char byte_at(std::string_view bytes, std::size_t i) {
  return static_cast<unsigned char>(bytes[i]);
}

std::string from_utf16(std::string_view bytes, bool is_big_endian) {
  std::string out;
  out.reserve(bytes.size() / 2);
  const auto unit = [&](std::size_t i) {
    const unsigned high = byte_at(bytes, is_big_endian ? i : i + 1);
    const unsigned low = byte_at(bytes, is_big_endian ? i + 1 : i);
    return static_cast<char32_t>(high << 8 | low);
  };
  for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
    char32_t code = unit(i);
    if (code >= 0xd800 && code < 0xdc00 && i + 3 < bytes.size()) {  // a surrogate pair
      code = 0x10000 + ((code - 0xd800) << 10) + ((unit(i + 2) - 0xdc00) & 0x3ff);
      i += 2;
    }
    append_utf8(out, code);
  }
  return out;
}

bool is_utf8(std::string_view bytes) {
  for (std::size_t i = 0; i < bytes.size();) {
    std::uint64_t eight = 0x80;
    if (i + 8 <= bytes.size()) std::memcpy(&eight, bytes.data() + i, 8);
    if ((eight & 0x8080808080808080u) == 0) {
      i += 8;
      continue;
    }
    const std::size_t length = utf8_length(bytes, i);
    if (length == 0) return false;
    i += length;
  }
  return true;
}

// Byte order of UTF-16 by its BOM, or without one because every other byte of the first characters
// is zero; nothing for other encodings.
std::optional<bool> is_big_endian_utf16(std::string_view bytes) {
  if (bytes.size() >= 2 && byte_at(bytes, 0) == 0xff && byte_at(bytes, 1) == 0xfe) return false;
  if (bytes.size() >= 2 && byte_at(bytes, 0) == 0xfe && byte_at(bytes, 1) == 0xff) return true;
  if (bytes.size() < 4) return std::nullopt;
  const bool odd = bytes[1] == 0 && bytes[3] == 0 && bytes[0] != 0 && bytes[2] != 0;
  const bool even = bytes[0] == 0 && bytes[2] == 0 && bytes[1] != 0 && bytes[3] != 0;
  if (!odd && !even) return std::nullopt;
  return even;
}

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

// Without blanks and carriage returns at its ends. Tabs stay: they may stand beside empty cells.
std::string_view without_blanks(std::string_view line) {
  while (!line.empty() && line.front() == ' ') line.remove_prefix(1);
  while (!line.empty() && (line.back() == ' ' || line.back() == '\r')) line.remove_suffix(1);
  return line;
}

bool is_comment(std::string_view line) {
  if (line.front() == '#' || line.substr(0, 2) == "//") return true;
  if (line.front() != '%') return false;
  const std::size_t next = line.find_first_not_of(" %", 1);  // "%, MPa" is a row of units
  return next == std::string_view::npos ||
         (line[next] != ',' && line[next] != ';' && line[next] != '\t');
}

std::size_t count_outside_quotes(std::string_view line, char separator) {
  std::size_t count = 0;
  bool is_quoted = false;
  for (const char c : line) {
    if (c == '"') is_quoted = !is_quoted;
    if (c == separator && !is_quoted) ++count;
  }
  return count;
}

// "1,5 2,3": with commas as separators, one cell would hold two numbers with a blank between them.
bool has_blank_between_numbers(std::string_view line) {
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    if (!is_blank(line[i])) continue;
    const std::size_t next = line.find_first_not_of(" \t", i);
    const char before = line[i - 1];
    if (next == std::string_view::npos) return false;
    const char after = line[next];
    if (before >= '0' && before <= '9' && ((after >= '0' && after <= '9') || after == '-')) {
      return true;
    }
  }
  return false;
}

char detect_separator(const std::vector<TextLine>& sample) {
  for (const char separator : {';', '\t', ','}) {
    const auto has_it = std::count_if(sample.begin(), sample.end(), [&](const TextLine& line) {
      return count_outside_quotes(trimmed(line.text), separator) > 0 &&
             (separator != ',' || !has_blank_between_numbers(line.text));
    });
    if (2 * static_cast<std::size_t>(has_it) >= sample.size()) return separator;
  }
  return ' ';
}

}  // namespace

std::string utf8_from_bytes(std::string_view bytes, const std::string& name) {
  if (const auto is_big_endian = is_big_endian_utf16(bytes)) {
    std::string text = from_utf16(bytes, *is_big_endian);
    if (text.rfind("\xef\xbb\xbf", 0) == 0) text.erase(0, 3);
    if (text.find('\0') == std::string::npos) return text;
  }
  if (bytes.substr(0, 3) == "\xef\xbb\xbf") bytes.remove_prefix(3);
  if (bytes.find('\0') != std::string_view::npos) {
    throw std::runtime_error(name +
                             ": is not a text table (it contains NUL bytes); export it as CSV");
  }
  if (is_utf8(bytes)) return std::string(bytes);
  std::string text;  // Latin-1, in which old instruments write the micro sign
  for (std::size_t i = 0; i < bytes.size(); ++i) append_utf8(text, byte_at(bytes, i));
  return text;
}

// The next "\n" is kept between lines: in a file whose lines end in "\r", searching it again for
// each line would make reading quadratic.
std::string_view LineReader::take_line() {
  const char* begin = rest_.data();
  if (newline_ < begin) {
    const std::size_t at = rest_.find('\n');
    newline_ = begin + std::min(at, rest_.size());
  }
  std::string_view line(begin, static_cast<std::size_t>(newline_ - begin));
  const std::size_t carriage_return = line.find('\r');
  std::size_t end_size = line.size() < rest_.size() ? 1 : 0;
  if (carriage_return != std::string_view::npos) {
    const bool is_crlf = carriage_return + 1 == line.size() && end_size == 1;
    line = line.substr(0, carriage_return);
    end_size = is_crlf ? 2 : 1;
  }
  rest_.remove_prefix(line.size() + end_size);
  return line;
}

bool LineReader::next(TextLine& line) {
  while (!rest_.empty()) {
    const std::string_view whole = take_line();
    const std::string_view text = trimmed(whole);
    ++number_;
    if (text.empty()) continue;
    if (is_comment(text)) {
      last_comment_ = trimmed(text.substr(std::min(text.size(), text.find_first_not_of("#%/"))));
      continue;
    }
    line = {number_, without_blanks(whole)};
    return true;
  }
  return false;
}

void split_cells(const TextLine& line, char separator, std::vector<std::string_view>& cells) {
  cells.clear();
  std::string_view rest = line.text;
  while (true) {
    while (!rest.empty() && is_blank(rest.front()) && rest.front() != separator) {
      rest.remove_prefix(1);
    }
    if (separator == ' ') rest = trimmed(rest);
    if (!rest.empty() && rest.front() == '"') {
      std::size_t close = rest.find('"', 1);
      while (close != std::string_view::npos && rest.substr(close, 2) == "\"\"") {
        close = rest.find('"', close + 2);
      }
      if (close == std::string_view::npos) {
        throw std::runtime_error("line " + std::to_string(line.number) +
                                 ": a quote is not closed on the same line; close it or remove it");
      }
      cells.push_back(trimmed(rest.substr(1, close - 1)));
      rest.remove_prefix(close + 1);
    } else {
      const std::size_t end = separator == ' ' ? rest.find_first_of(" \t") : rest.find(separator);
      cells.push_back(trimmed(rest.substr(0, end)));
      rest.remove_prefix(std::min(rest.size(), end));
    }
    if (separator == ' ') {
      rest = trimmed(rest);
      if (rest.empty()) return;
      continue;
    }
    const std::size_t next = rest.find(separator);
    if (next == std::string_view::npos) return;
    rest.remove_prefix(next + 1);
  }
}

std::vector<std::string_view> header_cells(const TextLine& line, char separator) {
  std::vector<std::string_view> cells;
  split_cells(line, separator, cells);
  if (separator != ' ') return cells;
  std::vector<std::string_view> joined;
  for (const std::string_view cell : cells) {
    const bool is_unit = !cell.empty() && (cell.front() == '(' || cell.front() == '[');
    const bool follows_name = !joined.empty() && !joined.back().empty() &&
                              joined.back().back() != ')' && joined.back().back() != ']';
    if (is_unit && follows_name) {
      const char* begin = joined.back().data();
      joined.back() = {begin, static_cast<std::size_t>(cell.data() + cell.size() - begin)};
    } else {
      joined.push_back(cell);
    }
  }
  return joined;
}

std::optional<double> number_from_cell(std::string_view cell, const Dialect& dialect) {
  std::array<char, 64> with_point{};
  if (dialect.has_decimal_comma) {
    if (cell.size() > with_point.size() || cell.find('.') != std::string_view::npos) {
      return std::nullopt;
    }
    std::replace_copy(cell.begin(), cell.end(), with_point.begin(), ',', '.');
    cell = {with_point.data(), cell.size()};
  }
  if (cell.size() > 1 && cell.front() == '+' && cell[1] != '-') cell.remove_prefix(1);
  double value = 0.0;
  const char* end = cell.data() + cell.size();
  const auto result = std::from_chars(cell.data(), end, value);
  if (result.ptr != end || cell.empty()) return std::nullopt;
  if (result.ec == std::errc::result_out_of_range) {
    const bool is_tiny =
        cell.find("e-") != std::string_view::npos || cell.find("E-") != std::string_view::npos;
    return is_tiny ? 0.0 : std::numeric_limits<double>::infinity();
  }
  if (result.ec != std::errc()) return std::nullopt;
  return value;
}

Dialect detect_dialect(const std::vector<TextLine>& sample, const std::string& name) {
  Dialect dialect{detect_separator(sample), false};
  if (dialect.separator == ',') return dialect;
  const TextLine* with_comma = nullptr;
  const TextLine* with_point = nullptr;
  std::vector<std::string_view> cells;
  for (const TextLine& line : sample) {
    split_cells(line, dialect.separator, cells);
    for (const std::string_view cell : cells) {
      const bool has_comma = cell.find(',') != std::string_view::npos;
      const bool has_point = cell.find('.') != std::string_view::npos;
      if (has_comma && number_from_cell(cell, {dialect.separator, true})) with_comma = &line;
      if (has_point && number_from_cell(cell, {dialect.separator, false})) with_point = &line;
    }
  }
  if (with_comma != nullptr && with_point != nullptr) {
    throw std::runtime_error(name + ": line " + std::to_string(with_comma->number) +
                             " has a decimal comma and line " + std::to_string(with_point->number) +
                             " a decimal point; use the same decimal sign in all numbers");
  }
  dialect.has_decimal_comma = with_comma != nullptr;
  return dialect;
}

}  // namespace viscard
