#include "io/tables/table_parts.h"

#include "models/maths/text_of_number.h"

#include <algorithm>
#include <stdexcept>

namespace viscard {
namespace {

std::string header_of(const std::string& name, const std::string& unit) {
  return unit.empty() || unit == "-" ? name : name + " [" + unit + "]";
}

std::string quoted_cell(std::string_view cell) {
  if (cell.find_first_of("\"\t") == std::string_view::npos) return std::string(cell);
  std::string out = "\"";
  for (const char c : cell) {
    if (c == '\t') continue;
    out += c;
    if (c == '"') out += c;
  }
  return out + "\"";
}

}  // namespace

void TableParts::begin(const std::string& segment, const std::vector<std::string>& names,
                       const std::vector<std::string>& units) {
  segment_ = segment.empty() ? std::to_string(segments_.size() + 1) : segment;
  const auto is_used = [&](const std::string& word) {
    return std::find(segments_.begin(), segments_.end(), word) != segments_.end();
  };
  if (is_used(segment_)) {  // a second part of the same name
    int n = 2;
    while (is_used(segment_ + " (" + std::to_string(n) + ")")) ++n;
    segment_ += " (" + std::to_string(n) + ")";
  }
  segments_.push_back(segment_);
  places_.clear();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string header = header_of(names[i], i < units.size() ? units[i] : "");
    std::size_t place = 0;
    while (place < headers_.size() &&
           (headers_[place] != header ||
            std::find(places_.begin(), places_.end(), place) != places_.end())) {
      ++place;
    }
    if (place == headers_.size()) headers_.push_back(header);
    places_.push_back(place);
  }
}

void TableParts::row(const std::vector<std::string_view>& cells) {
  if (cells.size() != places_.size()) {
    throw std::runtime_error("line " + std::to_string(lines_.size() + 1) + ": " +
                             counted(cells.size(), "cell") + ", but its part has " +
                             counted(places_.size(), "column"));
  }
  std::vector<std::string_view> all(headers_.size());
  for (std::size_t i = 0; i < cells.size(); ++i) all[places_[i]] = cells[i];
  std::string line = quoted_cell(segment_);
  for (const std::string_view cell : all) line += "\t" + quoted_cell(cell);
  if (!has_row_) first_row_ = lines_.size();
  has_row_ = true;
  widths_.resize(lines_.size() + 1, 0);
  widths_.back() = all.size();
  lines_.push_back(std::move(line));
}

std::string TableParts::text() const {
  std::string header = "segment";
  for (const std::string& one : headers_) header += "\t" + quoted_cell(one);
  std::string out;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const bool is_header = has_row_ && i + 1 == first_row_;
    const std::size_t width = i < widths_.size() ? widths_[i] : 0;
    out += is_header ? header : lines_[i];
    if (width > 0) out.append(headers_.size() - width, '\t');
    out += '\n';
  }
  return out;
}

std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find_first_of("\r\n");
  const std::string_view line = text.substr(0, end);
  if (end == std::string_view::npos) {
    text = {};
  } else {
    text.remove_prefix(end + (text.substr(end, 2) == "\r\n" ? 2 : 1));
  }
  return line;
}

std::vector<std::string_view> plain_cells(std::string_view line, char separator) {
  std::vector<std::string_view> cells;
  while (true) {
    const bool is_quoted = !line.empty() && line.front() == '"';
    const std::size_t close = is_quoted ? line.find('"', 1) : std::string_view::npos;
    const std::size_t end = line.find(separator, close == std::string_view::npos ? 0 : close);
    std::string_view cell = trimmed(line.substr(0, end));
    if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') {
      cell = trimmed(cell.substr(1, cell.size() - 2));
    }
    cells.push_back(cell);
    if (end == std::string_view::npos) return cells;
    line.remove_prefix(end + 1);
  }
}

std::vector<std::string_view> plain_words(std::string_view line) {
  std::vector<std::string_view> words;
  while (true) {
    const std::size_t begin = line.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return words;
    line.remove_prefix(begin);
    const std::size_t end = std::min(line.size(), line.find_first_of(" \t"));
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

}  // namespace viscard
