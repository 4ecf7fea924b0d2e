#include "io/scenes/scene_words.h"
#include "models/array/space/simulate_space.h"

#include <algorithm>
#include <optional>

namespace viscard {
namespace {

std::optional<int> small_number(const std::string& text) {
  const bool is_number =
      !text.empty() && text.size() < 7 && text.find_first_not_of("0123456789") == std::string::npos;
  return is_number ? std::optional<int>(std::stoi(text)) : std::nullopt;
}

// The place in "mean_voltage_3_4", whose map is `map`.
RowColumn place_in(const std::string& name, const std::string& map) {
  const std::string rest = name.substr(map.size() + 1);
  const std::size_t gap = rest.find('_');
  const auto row = small_number(rest.substr(0, gap));
  const auto column = gap == std::string::npos ? std::nullopt : small_number(rest.substr(gap + 1));
  if (row && column) return {*row, *column};
  throw SceneMistake(
      "want.quantities",
      "'" + name + "': a pillar is given by its row and column, such as " + map + "_1_1");
}

}  // namespace

void check_space_wanted(const SpaceScene& scene) {
  const std::vector<std::string> maps = result_names(scene);
  for (const std::string& name : scene.wanted) {
    const auto map = std::find_if(maps.begin(), maps.end(), [&](const std::string& one) {
      return name.starts_with(one + "_");
    });
    if (map == maps.end()) {
      check_wanted({name}, maps);
      continue;
    }
    if (name == *map + "_largest" || name == *map + "_smallest") {
      if (*map != "reading") continue;
      throw SceneMistake("want.quantities",
                         "'" + name + "': a reading is that of one pillar, such as reading_1_1");
    }
    const RowColumn place = place_in(name, *map);
    const std::optional<std::size_t> index = index_of(scene, place);
    if (!index) {
      throw SceneMistake("want.quantities", "'" + name + "': there is no pillar in row " +
                                                std::to_string(place.first) + " and column " +
                                                std::to_string(place.second) + " of " +
                                                std::to_string(scene.rows) + " rows and " +
                                                std::to_string(scene.columns) + " columns");
    }
    if (map->starts_with("crosstalk") && is_loaded(scene)[*index]) {
      throw SceneMistake("want.quantities",
                         "'" + name + "': cross-talk is that of a pillar without load");
    }
  }
}

}  // namespace viscard
