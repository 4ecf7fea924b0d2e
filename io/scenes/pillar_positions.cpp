#include "io/scenes/pillar_positions.h"

#include "io/basics/units.h"
#include "io/basics/words.h"
#include "io/tables/csv_table.h"
#include "models/answer/scene_mistake.h"

#include <algorithm>
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

// A column of numbers in SI.
struct WantedColumn {
  const char* name;
  const char* unit;     // SI; "1": a number
  const char* example;  // of a header
};
std::vector<double> column_of(const CsvTable& table, const WantedColumn& wanted,
                              const std::string& all) {
  std::vector<std::string> headers;
  const bool has_unit = std::string(wanted.unit) != "1";
  for (const CsvColumn& column : table.columns) {
    headers.push_back("'" + column.header + "'");
    const auto [name, unit] =
        has_unit ? name_and_unit(column) : std::pair{column.name, std::string()};
    if (name != wanted.name) continue;
    if (has_unit && !is_unit_of(unit, wanted.unit)) {
      throw std::runtime_error(table.file + ": column '" + column.header + "' needs a unit of " +
                               (std::string(wanted.unit) == "m" ? "length" : "voltage") +
                               ", such as '" + wanted.example + "'");
    }
    if (column.first_bad_line > 0) {
      throw std::runtime_error(table.file + ":" + std::to_string(column.first_bad_line) +
                               ": column '" + column.header + "': '" + column.first_bad_cell +
                               "' is not a finite number");
    }
    std::vector<double> values = column.values;
    const double factor = has_unit ? scale_to_si(unit, wanted.unit).factor : 1.0;
    for (double& value : values) value *= factor;
    return values;
  }
  throw std::runtime_error(table.file + ": needs the columns " + all + "; it has " +
                           listed(headers));
}

std::vector<double> lengths_m(const CsvTable& table, const std::string& axis,
                              const std::string& all = "x and y") {
  const std::string example = axis + " [um]";
  return column_of(table, {axis.c_str(), "m", example.c_str()},
                   all + " with units, such as 'x [um]'");
}

// The values in order, those that agree to 1e-9 of their range once.
std::vector<double> distinct(std::vector<double> values) {
  if (values.empty()) return values;
  std::sort(values.begin(), values.end());
  const double same = 1e-9 * (values.back() - values.front());
  values.erase(
      std::unique(values.begin(), values.end(), [&](double a, double b) { return b - a <= same; }),
      values.end());
  return values;
}

std::size_t nearest(const std::vector<double>& axis, double at) {
  const auto above = std::lower_bound(axis.begin(), axis.end(), at);
  if (above == axis.begin()) return 0;
  if (above == axis.end()) return axis.size() - 1;
  const auto index = static_cast<std::size_t>(above - axis.begin());
  return axis[index] - at < at - axis[index - 1] ? index : index - 1;
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

HeightTable read_heights(const std::filesystem::path& path) {
  const CsvTable file = read_csv(path);
  const std::string axes = "x, y and z";
  const std::vector<double> x_m = lengths_m(file, "x", axes);
  const std::vector<double> y_m = lengths_m(file, "y", axes);
  const std::vector<double> z_m = lengths_m(file, "z", axes);
  HeightTable table{distinct(x_m), distinct(y_m), {}};
  if (table.x_m.size() < 2 || table.y_m.size() < 2) {
    throw std::runtime_error(file.file + ": needs at least two places along x and along y");
  }
  table.height_m.assign(table.x_m.size() * table.y_m.size(), NAN);
  const double lowest_m = *std::min_element(z_m.begin(), z_m.end());
  for (std::size_t i = 0; i < z_m.size(); ++i) {
    double& height_m =
        table.height_m[nearest(table.y_m, y_m[i]) * table.x_m.size() + nearest(table.x_m, x_m[i])];
    if (!std::isnan(height_m)) {
      throw std::runtime_error(file.file + ": row " + std::to_string(i + 1) +
                               " gives the height of a place that has one already");
    }
    height_m = z_m[i] - lowest_m;
  }
  if (z_m.size() < table.height_m.size()) {
    throw std::runtime_error(file.file + ": " + std::to_string(table.x_m.size()) + " x " +
                             std::to_string(table.y_m.size()) + " places along x and y, but only " +
                             std::to_string(z_m.size()) + " heights; the grid must be full");
  }
  return table;
}

std::vector<QuadrantVoltages> read_quadrant_voltages(const std::filesystem::path& path) {
  const std::string all =
      "row, column and quadrant_1_voltage to quadrant_4_voltage with units, such as "
      "'quadrant_1_voltage [mV]'";
  const CsvTable table = read_csv(path);
  const std::vector<double> row = column_of(table, {"row", "1", "row"}, all);
  const std::vector<double> column = column_of(table, {"column", "1", "column"}, all);
  std::vector<QuadrantVoltages> voltages(row.size());
  for (std::size_t i = 0; i < row.size(); ++i) {
    for (const double number : {row[i], column[i]}) {
      if (number == std::floor(number) && number >= 1.0 && number <= 1e6) continue;
      throw std::runtime_error(table.file + ": row " + std::to_string(i + 1) +
                               ": 'row' and 'column' are numbers of a pillar, from 1");
    }
    voltages[i].row = static_cast<int>(row[i]);
    voltages[i].column = static_cast<int>(column[i]);
  }
  for (std::size_t q = 0; q < 4; ++q) {
    const std::string name = "quadrant_" + std::to_string(q + 1) + "_voltage";
    const std::string example = name + " [mV]";
    const std::vector<double> values_V =
        column_of(table, {name.c_str(), "V", example.c_str()}, all);
    for (std::size_t i = 0; i < row.size(); ++i) voltages[i].voltage_V.at(q) = values_V[i];
  }
  return voltages;
}

std::vector<std::pair<int, int>> places_of(const std::string& key,
                                           const std::vector<std::pair<double, double>>& pairs) {
  std::vector<std::pair<int, int>> places;
  for (const auto& [row, column] : pairs) {
    for (const double number : {row, column}) {
      if (number != std::floor(number) || number < 1.0 || number > 1e6) {
        throw SceneMistake(key, "are rows and columns of pillars, such as [[3, 7]], from 1");
      }
    }
    places.emplace_back(static_cast<int>(row), static_cast<int>(column));
  }
  return places;
}

}  // namespace viscard
