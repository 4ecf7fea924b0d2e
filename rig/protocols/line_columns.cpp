#include "rig/protocols/line_columns.h"

#include "models/maths/text_of_number.h"

#include <algorithm>

namespace viscard {
namespace {

// The columns of a line: blanks separate only where there is no other sign.
std::vector<std::string> cells_of(std::string_view line) {
  const std::size_t colon = line.find(':');
  if (colon != std::string_view::npos) line.remove_prefix(colon + 1);
  const bool has_signs = line.find_first_of(",;\t") != std::string_view::npos;
  const char* separators = has_signs ? ",;\t" : " ";
  std::vector<std::string> cells;
  while (!line.empty()) {
    const std::size_t end = line.find_first_of(separators);
    const std::string_view cell = trimmed(line.substr(0, end));
    if (has_signs || !cell.empty()) cells.emplace_back(cell);
    if (end == std::string_view::npos) break;
    line.remove_prefix(end + 1);
  }
  return cells;
}

}  // namespace

std::optional<LineColumns> line_columns_from_word(std::string_view word) {
  LineColumns columns;
  for (const std::string_view part : split(word, ',')) columns.words.emplace_back(trimmed(part));
  const auto n_of = [&](const char* one) {
    return std::count(columns.words.begin(), columns.words.end(), one);
  };
  const auto n_known = n_of("counts") + n_of("volts") + n_of("micros") + n_of("millis") + n_of("-");
  const bool is_list = n_known == static_cast<std::ptrdiff_t>(columns.words.size()) &&
                       n_of("counts") + n_of("volts") == 1 && n_of("micros") + n_of("millis") <= 1;
  // Nothing distinguishes volts with a clock from counts with one.
  if (!is_list || (n_of("volts") == 1 && n_of("micros") + n_of("millis") == 1)) return std::nullopt;
  if (n_of("volts") == 1) columns.format = Hx711Format::kVolts;
  if (n_of("micros") == 1) columns.format = Hx711Format::kMicrosCounts;
  if (n_of("millis") == 1) columns.format = Hx711Format::kMillisCounts;
  return columns;
}

std::optional<std::string> picked_columns(std::string_view line, const LineColumns& columns) {
  const std::vector<std::string> cells = cells_of(line);
  if (cells.size() < columns.words.size()) return std::nullopt;
  std::string ticks, value;
  for (std::size_t i = 0; i < columns.words.size(); ++i) {
    const std::string& word = columns.words[i];
    if (word == "micros" || word == "millis") ticks = cells[i] + ",";
    if (word == "counts" || word == "volts") value = cells[i];
  }
  return ticks + value;
}

}  // namespace viscard
