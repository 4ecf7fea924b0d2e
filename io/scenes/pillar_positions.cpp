#include "io/scenes/pillar_positions.h"

#include "io/basics/units.h"
#include "io/basics/words.h"
#include "io/tables/csv_table.h"

#include <cctype>
#include <cmath>
#include <stdexcept>
#include <string>

namespace viscard {
namespace {

// "x_um" -> "x" and "um"; the unit in brackets has priority.
std::pair<std::string, std::string> name_and_unit(const CsvColumn& column) {
  std::string name = column.name;
  std::string unit = column.unit;
  if (const std::size_t at = name.rfind('_'); unit.empty() && at != std::string::npos) {
    unit = name.substr(at + 1);
    name.erase(at);
  }
  for (char& letter : name) letter = static_cast<char>(std::tolower(letter));
  return {name, unit};
}

std::vector<double> lengths_m(const CsvTable& table, const std::string& axis) {
  std::vector<std::string> headers;
  for (const CsvColumn& column : table.columns) {
    headers.push_back("'" + column.header + "'");
    const auto [name, unit] = name_and_unit(column);
    if (name != axis) continue;
    if (!is_unit_of(unit, "m")) {
      throw std::runtime_error(table.file + ": column '" + column.header +
                               "' needs a unit of length, such as '" + axis + " [um]'");
    }
    if (column.first_bad_line > 0) {
      throw std::runtime_error(table.file + ":" + std::to_string(column.first_bad_line) +
                               ": column '" + column.header + "': '" + column.first_bad_cell +
                               "' is not a finite number");
    }
    std::vector<double> values = column.values;
    const double factor = scale_to_si(unit, "m").factor;
    for (double& value : values) value *= factor;
    return values;
  }
  throw std::runtime_error(table.file +
                           ": needs the columns x and y with units, such as 'x [um]'; " +
                           "it has " + listed(headers));
}

}  // namespace

std::vector<std::pair<double, double>> read_positions(const std::filesystem::path& path) {
  const CsvTable table = read_csv(path);
  const std::vector<double> x_m = lengths_m(table, "x");
  const std::vector<double> y_m = lengths_m(table, "y");
  std::vector<std::pair<double, double>> places;
  for (std::size_t i = 0; i < x_m.size(); ++i) places.emplace_back(x_m[i], y_m[i]);
  if (places.empty()) throw std::runtime_error(table.file + ": holds no pillar");
  return places;
}

}  // namespace viscard
