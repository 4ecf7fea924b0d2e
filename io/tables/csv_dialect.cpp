#include "io/tables/csv_dialect.h"

#include "io/basics/words.h"
#include "io/tables/table_limits.h"
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
  if (line.find(':') != std::string_view::npos) return false;  // a date and a time
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

std::string_view first_line(std::string_view text) {
  const std::size_t at = text.find_first_of("\r\n");
  if (at == std::string_view::npos) return text;
  const bool is_crlf = text[at] == '\r' && at + 1 < text.size() && text[at + 1] == '\n';
  return text.substr(0, at + (is_crlf ? 2 : 1));
}

// The next "\n" is kept between lines, and is searched near by first: in a file whose lines end in "\r", a search to
// its end for each line, or for each of its tables, would make reading quadratic.
std::string_view LineReader::take_line() {
  constexpr std::size_t kNear = std::size_t{1} << 12;
  const char* const begin = rest_.data();
  const char* const end = begin + rest_.size();
  const auto search = [&](std::size_t n_bytes) {
    const std::string_view near = rest_.substr(0, n_bytes);
    newline_ = begin + std::min(near.size(), near.find('\n'));
  };
  if (newline_ < begin) search(kNear);
  const auto found = [&] {
    return std::string_view(begin, static_cast<std::size_t>(newline_ - begin));
  };
  // Without either end of a line so far, the line is longer.
  for (std::size_t n_bytes = kNear;
       newline_ < end && *newline_ != '\n' && found().find('\r') == std::string_view::npos;) {
    n_bytes *= 2;
    search(n_bytes);
  }
  std::string_view line = found();
  const std::size_t carriage_return = line.find('\r');
  std::size_t end_size = newline_ < end ? 1 : 0;
  if (carriage_return != std::string_view::npos) {
    const bool is_crlf = carriage_return + 1 == line.size() && newline_ < end && *newline_ == '\n';
    line = line.substr(0, carriage_return);
    end_size = is_crlf ? 2 : 1;
  }
  rest_.remove_prefix(line.size() + end_size);
  return line;
}

std::vector<std::string> leading_comments(std::string_view text) {
  std::vector<std::string> comments;
  while (!text.empty()) {
    const std::string_view whole = first_line(text), line = trimmed(whole);
    text.remove_prefix(whole.size());
    if (line.empty()) continue;
    if (!is_comment(line)) break;
    const std::size_t mark = std::min(line.size(), line.find_first_not_of("#%/"));
    comments.emplace_back(trimmed(line.substr(mark)));
  }
  return comments;
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
    if (cells.size() == kSheetColumns) {
      throw std::runtime_error("line " + std::to_string(line.number) + ": has more than " +
                               std::to_string(kSheetColumns) +
                               " columns, the limit; remove those that are no data");
    }
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

namespace {

bool is_decimal_digit(char c) {
  return c >= '0' && c <= '9';
}

// "1,498" or "-1,498,996.2": one to three digits, then groups of three behind the sign.
bool has_groups_of_three(std::string_view cell, char sign = ',', std::size_t fewest = 1) {
  if (!cell.empty() && (cell.front() == '-' || cell.front() == '+')) cell.remove_prefix(1);
  std::size_t n = 0;
  while (n < cell.size() && is_decimal_digit(cell[n])) ++n;
  if (n < 1 || n > 3 || cell[0] == '0') return false;
  cell.remove_prefix(n);
  std::size_t n_groups = 0;
  while (cell.size() >= 4 && cell[0] == sign &&
         std::all_of(cell.begin() + 1, cell.begin() + 4, is_decimal_digit)) {
    cell.remove_prefix(4);
    ++n_groups;
  }
  return n_groups >= fewest && (cell.empty() || !(is_decimal_digit(cell[0]) || cell[0] == sign));
}

// Signs between groups of three digits that are no decimal sign anywhere: apostrophes, and blanks.
constexpr std::string_view kGroupSigns[] = {"'",        "\xE2\x80\x99", " ",
                                            "\xC2\xA0", "\xE2\x80\xAF", "\xE2\x80\x89"};

// "1'498'996.2" without its apostrophes. Nothing for a cell without such groups, or with signs elsewhere.
std::optional<std::string> without_group_signs(std::string_view cell) {
  for (const std::string_view sign : kGroupSigns) {
    if (cell.find(sign) == std::string_view::npos) continue;
    std::string plain;
    std::size_t n_digits = 0, at = !cell.empty() && (cell[0] == '-' || cell[0] == '+') ? 1 : 0;
    plain = cell.substr(0, at);
    bool is_first = true;
    while (at < cell.size() && is_decimal_digit(cell[at])) {
      for (n_digits = 0; at < cell.size() && is_decimal_digit(cell[at]); ++n_digits)
        plain += cell[at++];
      if (is_first ? n_digits > 3 : n_digits != 3) return std::nullopt;
      is_first = false;
      if (cell.substr(at, sign.size()) != sign) break;
      at += sign.size();
      n_digits = 0;
    }
    // A sign at the end of the groups, or behind them, is none between thousands.
    if (n_digits == 0 || cell.find(sign, at) != std::string_view::npos) return std::nullopt;
    return plain + std::string(cell.substr(at));
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> number_from_cell(std::string_view cell, const Dialect& dialect) {
  const std::string_view given = cell;
  std::array<char, 64> changed{};
  const auto change = [&] {
    if (cell.size() > changed.size()) return false;
    std::copy(cell.begin(), cell.end(), changed.begin());
    cell = {changed.data(), cell.size()};
    return true;
  };
  const auto remove_all = [&](char sign) {
    const auto* end = std::remove(changed.begin(), changed.begin() + cell.size(), sign);
    cell = {changed.data(), static_cast<std::size_t>(end - changed.data())};
  };
  if (dialect.has_decimal_comma) {
    if (dialect.has_thousands_point && has_groups_of_three(cell, '.') && change()) remove_all('.');
    if (cell.find('.') != std::string_view::npos || !change()) return std::nullopt;
    std::replace(changed.begin(), changed.end(), ',', '.');
  } else if (dialect.has_thousands_comma && has_groups_of_three(cell) && change()) {
    remove_all(',');
  }
  if (cell.size() > 1 && cell.front() == '+' && cell[1] != '-') cell.remove_prefix(1);
  double value = 0.0;
  auto result = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  // 1.498D+06, as Fortran writes a double.
  if (const std::size_t at = cell.find_first_of("Dd");
      at != std::string_view::npos && result.ptr == cell.data() + at && at > 0 && change()) {
    changed[at] = 'e';
    result = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  }
  if (result.ptr != cell.data() + cell.size() || cell.empty()) {
    const std::optional<std::string> plain = without_group_signs(given);
    return plain ? number_from_cell(*plain, dialect) : std::nullopt;
  }
  if (result.ec == std::errc::result_out_of_range) {
    const bool is_tiny =
        cell.find("e-") != std::string_view::npos || cell.find("E-") != std::string_view::npos;
    return is_tiny ? 0.0 : std::numeric_limits<double>::infinity();
  }
  if (result.ec != std::errc()) return std::nullopt;
  return value;
}

bool is_gap(std::string_view cell) {
  constexpr std::string_view kGaps[] = {
      "",        "-",        "--",     "---",      "nan",       "na",   "n/a",       "#n/a",
      "n.a.",    "null",     "none",   "inf",      "-inf",      "+inf", "#div/0!",   "#value!",
      "#num!",   "infinity", "*",      "**",       "***",       "?",    ".",         "missing",
      "1.#qnan", "-1.#ind",  "1.#inf", "nan(ind)", "-nan(ind)", "-nan", "-infinity", "#na"};
  std::string lower(cell);
  for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return std::find(std::begin(kGaps), std::end(kGaps), lower) != std::end(kGaps);
}

Dialect detect_dialect(const std::vector<TextLine>& sample, const std::string& name) {
  Dialect dialect{detect_separator(sample)};
  const TextLine* with_comma = nullptr;
  const TextLine* with_point = nullptr;
  const TextLine* grouped = nullptr;
  std::string example;
  bool is_certain = false;       // that a comma stands between thousands: "1,498,996" or "1,498.2"
  bool has_plain_point = false;  // "0.5", which no sign between thousands has
  // By column: a number such as "1,038", and one such as "990". Together they are hardly 1.038 and 990.
  std::vector<std::array<bool, 2>> found;
  std::vector<std::string_view> cells;
  for (const TextLine& line : sample) {
    split_cells(line, dialect.separator, cells);
    bool has_group = false, has_point_number = false;  // in this line
    if (found.size() < cells.size()) found.resize(cells.size(), {false, false});
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::string_view cell = cells[i];
      found[i][0] = found[i][0] || has_groups_of_three(cell);
      found[i][1] = found[i][1] || (cell.size() == 3 && cell[0] != '0' &&
                                    std::all_of(cell.begin(), cell.end(), is_decimal_digit));
      // Two points in one number are between thousands, so the others are, too.
      if (has_groups_of_three(cell, '.', 2)) dialect.has_thousands_point = true;
      const bool has_comma = cell.find(',') != std::string_view::npos;
      const bool has_point = cell.find('.') != std::string_view::npos;
      if (has_comma && has_groups_of_three(cell)) {
        has_group = true;
        if (grouped == nullptr) {
          grouped = &line;
          example = std::string(cell);
        }
        is_certain = is_certain || has_point || std::count(cell.begin(), cell.end(), ',') > 1;
      } else if (has_comma && number_from_cell(cell, {dialect.separator, true, false})) {
        with_comma = &line;
      }
      if (has_point && number_from_cell(cell, {dialect.separator, false, true})) {
        with_point = &line;
        has_point_number = true;
        has_plain_point = has_plain_point || !has_groups_of_three(cell, '.');
      }
    }
    // A point in the same row; one in a note above would say nothing of the rows.
    is_certain = is_certain || (has_group && has_point_number);
  }
  const bool has_thousands = grouped != nullptr && with_comma == nullptr && is_certain;
  if (grouped != nullptr && !has_thousands) {
    // Where commas separate the cells, nothing else than the quotes shows what the comma in "1,498" is.
    const bool is_mixed =
        std::any_of(found.begin(), found.end(), [](const auto& one) { return one[0] && one[1]; });
    if (with_comma == nullptr && with_point == nullptr && (dialect.separator == ',' || is_mixed)) {
      throw std::runtime_error(
          name + ": line " + std::to_string(grouped->number) + " has '" + example +
          "', which may be " +
          "a number with thousands or with a decimal comma; write it without the comma" +
          (is_mixed ? ", or with as many decimals in all rows"
                    : ", or separate the cells by semicolons"));
    }
    if (with_comma == nullptr) with_comma = grouped;
  }
  dialect.has_thousands_point = dialect.has_thousands_point && !has_plain_point;
  if (dialect.has_thousands_point) {
    dialect.has_decimal_comma = true;
    return dialect;
  }
  if (dialect.separator == ',' && with_point != nullptr) with_comma = nullptr;  // a quoted note
  if (with_comma != nullptr && with_point != nullptr) {
    throw std::runtime_error(name + ": line " + std::to_string(with_comma->number) +
                             " has a decimal comma and line " + std::to_string(with_point->number) +
                             " a decimal point; use the same decimal sign in all numbers");
  }
  dialect.has_decimal_comma = with_comma != nullptr;
  dialect.has_thousands_comma = has_thousands;
  return dialect;
}

}  // namespace viscard
