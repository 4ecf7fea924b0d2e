#include "io/cli/scene/map_output.h"

#include "io/basics/atomic_file.h"
#include "io/basics/inputs.h"
#include "io/pictures/map_picture.h"
#include "io/tables/npy_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace viscard {
namespace {

std::string column_of(const SceneMap& map) {
  if (map.unit == "%") return map.name;
  std::string unit = map.unit;
  std::erase(unit, ' ');  // moment_x_Nm
  return map.name + "_" + unit;
}

std::string csv_of_pillars(const SceneAnswer& answer, const std::string& command) {
  std::string text = fmt::format(
      "{}row,column,x_m,y_m,pressure_Pa,shear_x_Pa,"
      "shear_y_Pa",
      head_of_table(command));
  std::vector<std::pair<std::vector<double>, std::vector<double>>> columns;
  for (const SceneMap& map : answer.maps) {
    text += fmt::format(",{0},{0}_error", column_of(map));
    columns.emplace_back(by_pillar(answer.array, map, map.value),
                         by_pillar(answer.array, map, map.error));
  }
  text += "\n";
  for (std::size_t i = 0; i < answer.array.pillars.size(); ++i) {
    const ScenePillar& one = answer.array.pillars[i];
    text += fmt::format("{},{},{:.9g},{:.9g},{:.9g},{:.9g},{:.9g}", one.row, one.column, one.x_m,
                        one.y_m, one.pressure_Pa, one.shear_x_Pa, one.shear_y_Pa);
    for (const auto& [value, error] : columns) {
      text += std::isnan(value[i]) ? "," : fmt::format(",{:.9g}", value[i]);
      text += std::isnan(error[i]) ? "," : fmt::format(",{:.3g}", error[i]);
    }
    text += "\n";
  }
  return text;
}

std::string npy_of(const SceneArray& array, const SceneMap& map) {
  const auto rows = static_cast<std::size_t>(array.rows);
  const auto columns = static_cast<std::size_t>(array.columns);
  std::vector<double> matrix(rows * columns, NAN);
  for (std::size_t at = 0; at < map.value.size(); ++at) {
    const ScenePillar& one = array.pillars[map.pillar[at]];
    matrix[static_cast<std::size_t>(one.row - 1) * columns +
           static_cast<std::size_t>(one.column - 1)] = map.value[at];
  }
  return npy_from_matrix(matrix, rows, columns);
}

}  // namespace

void write_maps(const SceneAnswer& answer, const std::string& folder, const std::string& command,
                bool overwrite) {
  if (answer.maps.empty()) return;
  const std::filesystem::path in = folder;
  write_file(in / "pillars.csv", csv_of_pillars(answer, command), overwrite);
  for (const SceneMap& map : answer.maps) {
    write_file(in / (map.name + ".npy"), npy_of(answer.array, map), overwrite);
  }
}

Pictures pictures_of_maps(const SceneAnswer& answer) {
  Pictures pictures;
  for (const SceneMap& map : answer.maps) {
    std::string title = map.name;
    if (const std::size_t at = title.find("_percent"); at != std::string::npos) title.erase(at);
    std::replace(title.begin(), title.end(), '_', ' ');
    pictures.emplace_back(map.name, svg_from_map(answer.array, map, title));
  }
  const auto find = [&](const char* name) {
    const auto found = std::find_if(answer.maps.begin(), answer.maps.end(),
                                    [&](const SceneMap& map) { return map.name == name; });
    return found == answer.maps.end() ? nullptr : &*found;
  };
  const SceneMap* const normal = find("sensed_normal_force");
  const SceneMap* const along_x = find("sensed_shear_x_force");
  const SceneMap* const along_y = find("sensed_shear_y_force");
  if (normal && along_x && along_y) {
    pictures.emplace_back("sensed_forces",
                          svg_from_forces(answer.array, {*normal, *along_x, *along_y},
                                          "sensed normal force, and shear as arrows"));
  }
  return pictures;
}

}  // namespace viscard
