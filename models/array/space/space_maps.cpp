#include "models/array/space/space_maps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

namespace viscard {
namespace {

// The reading of one pillar that cross-talk compares: of a disc, in either kind.
struct DiscReading {
  const char* map;
  Eigen::Index row;  // of a kernel
};
DiscReading disc_reading(const SpaceScene& scene) {
  const bool has_electrodes = scene.electrode == SpaceElectrode::kEquipotential;
  return has_electrodes ? DiscReading{"electrode_voltage", 0} : DiscReading{"mean_voltage", 1};
}
// A pillar that is sheared has no centre or mean voltage of its own. What its neighbours leave there
// is judged beside this share of the voltage that the load would have as a pressure.
constexpr double kOfPressed = 0.01;

// The mean voltage of unloaded pillars over the largest of the loaded ones.
SceneMap crosstalk_map(const SceneMap& mean, const std::vector<bool>& loaded) {
  SceneMap map{kCrosstalk, "%", {}, {}, {}, kCrosstalkScale};
  double largest_V = 0.0;
  for (std::size_t i = 0; i < loaded.size(); ++i) {
    if (loaded[i] && std::abs(mean.value[i]) > std::abs(largest_V)) largest_V = mean.value[i];
  }
  for (std::size_t i = 0; i < loaded.size(); ++i) {
    if (loaded[i]) continue;
    map.pillar.push_back(i);
    map.value.push_back(100.0 * mean.value[i] / largest_V + 0.0);  // no negative zero
  }
  return map;
}

// Quarters of an electrode are read together, so that the tolerance refers to the largest of the four.
bool is_quarter(const SceneMap& map) {
  return map.name.starts_with("quadrant_");
}

void add_result(const SceneMap& map, std::size_t at, const std::string& ending,
                SceneAnswer& answer) {
  const double error = map.error.empty() ? 0.0 : map.error[at];
  answer.results.push_back(
      {map.name + ending, map.value[at], map.unit, error, size_of(map), map.is_watched});
}

}  // namespace

bool asks_for_map(const SpaceScene& scene, const std::string& map) {
  return scene.wanted.empty() ||
         std::any_of(scene.wanted.begin(), scene.wanted.end(), [&](const std::string& name) {
           return name == map || name.starts_with(map + "_");
         });
}

bool has_crosstalk(const SpaceScene& scene) {
  const std::vector<bool> loaded = is_loaded(scene);
  return scene.feels_neighbours && scene.pressure_Pa != 0.0 &&
         std::find(loaded.begin(), loaded.end(), false) != loaded.end();
}

SceneArray array_of_answer(const SpaceScene& scene, const TopLoads& loads_Pa) {
  const FilmExtent film = film_extent(scene);
  SceneArray array{scene.rows, scene.columns};
  array.left_m = film.left_m;
  array.right_m = film.right_m;
  array.low_m = film.low_m;
  array.high_m = film.high_m;
  const std::vector<SpaceClass> classes = classes_of(scene);
  for (std::size_t i = 0; i < scene.pillars.size(); ++i) {
    const SpacePillar& one = scene.pillars[i];
    const auto load = loads_Pa.row(static_cast<Eigen::Index>(i));
    array.pillars.push_back({one.row, one.column, one.x_m, one.y_m,
                             classes[static_cast<std::size_t>(one.of_class)].diameter_m,
                             load[static_cast<int>(TopLoad::kPressure)],
                             load[static_cast<int>(TopLoad::kShearX)],
                             load[static_cast<int>(TopLoad::kShearY)]});
  }
  const std::vector<SpacePillar>& all = scene.pillars;
  const auto next = std::adjacent_find(all.begin(), all.end(), [](const auto& a, const auto& b) {
    return a.row == b.row && a.column + 1 == b.column;
  });
  if (next == all.end()) {  // a list of places has one column
    array.cell_x_m = array.cell_y_m = smallest_pitch_m(scene);
    return array;
  }
  array.cell_x_m = array.cell_y_m = std::next(next)->x_m - next->x_m;
  const int rows = all.back().row - all.front().row;
  if (rows > 0) array.cell_y_m = (all.back().y_m - all.front().y_m) / rows;
  return array;
}

std::vector<SceneMap> maps_of(const SpaceScene& scene, const SpaceResponse& response,
                              const TopLoads& loads_Pa) {
  const Eigen::MatrixXd voltages = response.voltages_V(loads_Pa);
  const DiscReading disc = disc_reading(scene);
  const double pressed_V =
      std::abs(response.kernel(0, 0.0, 0.0)(disc.row, static_cast<int>(TopLoad::kPressure))) *
      loads_Pa.cwiseAbs().maxCoeff();
  const std::vector<std::string> names = reading_names(scene.electrode);
  std::vector<SceneMap> maps;
  SceneMap mean;
  double largest_quarter_V = 0.0;
  for (std::size_t r = 0; r < names.size(); ++r) {
    SceneMap map{names[r] + "_voltage", "V", {}, {}, {}, kOfPressed * pressed_V};
    for (std::size_t i = 0; i < scene.pillars.size(); ++i) {
      map.pillar.push_back(i);
      map.value.push_back(voltages(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(r)));
    }
    if (map.name == disc.map) mean = map;
    if (is_quarter(map)) largest_quarter_V = std::max(largest_quarter_V, size_of(map));
    if (asks_for_map(scene, map.name)) maps.push_back(std::move(map));
  }
  for (SceneMap& map : maps) {
    if (is_quarter(map)) map.scale = largest_quarter_V;
  }
  if (has_crosstalk(scene) && asks_for_map(scene, kCrosstalk)) {
    maps.push_back(crosstalk_map(mean, is_loaded(scene)));
  }
  return maps;
}

void set_results(const SpaceScene& scene, SceneAnswer& answer) {
  std::erase_if(answer.results, [&](const SceneResult& one) {
    return std::any_of(answer.maps.begin(), answer.maps.end(),
                       [&](const SceneMap& map) { return one.name.starts_with(map.name + "_"); });
  });
  for (const SceneMap& map : answer.maps) {
    const auto [low, high] = std::minmax_element(map.value.begin(), map.value.end());
    add_result(map, static_cast<std::size_t>(high - map.value.begin()), "_largest", answer);
    add_result(map, static_cast<std::size_t>(low - map.value.begin()), "_smallest", answer);
    const bool is_small = scene.pillars.size() <= kMostNamedPillars;
    const bool has_named =
        std::any_of(scene.wanted.begin(), scene.wanted.end(),
                    [&](const std::string& name) { return name.starts_with(map.name + "_"); });
    for (std::size_t at = 0; at < map.value.size() && (is_small || has_named); ++at) {
      const ScenePillar& pillar = answer.array.pillars[map.pillar[at]];
      const std::string ending =
          "_" + std::to_string(pillar.row) + "_" + std::to_string(pillar.column);
      const bool is_named = std::find(scene.wanted.begin(), scene.wanted.end(),
                                      map.name + ending) != scene.wanted.end();
      if (is_named || is_small) add_result(map, at, ending, answer);
    }
  }
}

}  // namespace viscard
