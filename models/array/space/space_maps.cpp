#include "models/array/space/space_maps.h"

#include "models/array/space/foot_motion.h"
#include "models/array/space/space_contact.h"
#include "models/maths/bessel_orders.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <string>
#include <utility>

namespace viscard {
namespace {

// The reading of a pillar from which cross-talk is computed: that of a disc, with either kind of
// electrode.
struct DiscReading {
  const char* map;
  Eigen::Index row;  // of a kernel
};
DiscReading disc_reading(const SpaceScene& scene) {
  return {is_metal(scene.electrode) ? "electrode_voltage" : "mean_voltage",
          whole_reading(scene.electrode)};
}
// A pillar under shear has no centre or mean voltage of its own. The contributions of its
// neighbours are judged relative to this share of the voltage that the same load would give as a
// pressure.
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

// The quarters of an electrode are read together, so the tolerance refers to the largest of the
// four.
bool is_quarter(const SceneMap& map) {
  return map.name.starts_with("quadrant_");
}

void add_result(const SceneMap& map, std::size_t at, const std::string& ending,
                SceneAnswer& answer) {
  const double error = map.error.empty() ? 0.0 : map.error[at];
  answer.results.push_back(
      {map.name + ending, map.value[at], map.unit, error, size_of(map), map.is_watched});
}

constexpr const char* kPerPressure = "voltage_per_pressure";
constexpr const char* kPerHeight = "voltage_per_height";

// Of a top under a uniform pressure, with the film.
double sinking_m_Pa(const SpaceScene& scene, const SpaceResponse& response) {
  const FootForces& foot = response.foot(0);
  return foot.sinking_m_Pa + foot_settling_m_Pa(array_of(scene).film, foot);
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

double least_voltage_V(const SpaceResponse& response, const TopLoads& loads_Pa,
                       Eigen::Index reading) {
  const double per_pressure =
      response.kernel(0, 0.0, 0.0)(reading, static_cast<int>(TopLoad::kPressure));
  return kOfPressed * std::abs(per_pressure) * loads_Pa.cwiseAbs().maxCoeff();
}

std::vector<SceneMap> maps_of(const SpaceScene& scene, const SpaceResponse& response,
                              const TopLoads& loads_Pa, const Eigen::MatrixXd& voltages) {
  const DiscReading disc = disc_reading(scene);
  const double least_V = least_voltage_V(response, loads_Pa, disc.row);
  const std::vector<std::string> names = voltage_names(scene.electrode);
  std::vector<SceneMap> maps;
  const bool senses = senses_forces(scene);  // whose error equals that of the voltages
  SceneMap mean;
  double largest_quarter_V = 0.0;
  for (std::size_t r = 0; r < names.size(); ++r) {
    SceneMap map{names[r], "V", {}, {}, {}, least_V};
    for (std::size_t i = 0; i < scene.pillars.size(); ++i) {
      map.pillar.push_back(i);
      map.value.push_back(voltages(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(r)));
    }
    if (map.name == disc.map) mean = map;
    if (is_quarter(map)) largest_quarter_V = std::max(largest_quarter_V, size_of(map));
    if (asks_for_map(scene, map.name) || (senses && is_quarter(map)))
      maps.push_back(std::move(map));
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

double square_pitch_m(const SpaceScene& scene) {
  if (scene.rows < 2 || scene.columns < 2 || !scene.others.empty()) return 0.0;
  const auto count = static_cast<std::size_t>(scene.rows) * static_cast<std::size_t>(scene.columns);
  if (scene.pillars.size() != count) return 0.0;
  const double pitch_m = scene.pillars[1].x_m - scene.pillars[0].x_m;
  for (const SpacePillar& one : scene.pillars) {
    const double x_m = scene.pillars[0].x_m + (one.column - 1) * pitch_m;
    const double y_m = scene.pillars[0].y_m + (one.row - 1) * pitch_m;
    if (std::hypot(one.x_m - x_m, one.y_m - y_m) > 1e-6 * pitch_m) return 0.0;
  }
  return pitch_m;
}

void add_transfer(const SpaceScene& scene, const SpaceResponse& response, double reach_m,
                  SceneAnswer& answer) {
  constexpr int kWaves = 49;
  constexpr double kLongestWave = 64.0;  // over the pitch; the shortest is 2
  const double pitch_m = square_pitch_m(scene);
  const int most = static_cast<int>(std::ceil(reach_m / pitch_m));
  const double R_m = 0.5 * scene.diameter_m;
  for (const char* const name : {kPerPressure, kPerHeight}) {
    if (std::find(scene.wanted.begin(), scene.wanted.end(), name) == scene.wanted.end()) continue;
    const bool is_pressure = name == std::string(kPerPressure);
    SceneCurve curve{.name = name, .unit = is_pressure ? "V/Pa" : "V/m", .x_name = "wavelength_m"};
    for (int i = 0; i < kWaves; ++i) {
      const double wavelength_m = 2.0 * pitch_m * std::pow(0.5 * kLongestWave, i / (kWaves - 1.0));
      const double k_1_m = 2.0 * std::numbers::pi / wavelength_m;
      double sum_V_Pa = 0.0;
      for (int column = -most; column <= most; ++column) {
        for (int row = -most; row <= most; ++row) {
          sum_V_Pa += std::cos(k_1_m * column * pitch_m) *
                      response.kernel(0, column * pitch_m, row * pitch_m)(
                          disc_reading(scene).row, static_cast<int>(TopLoad::kPressure));
        }
      }
      const double half = 0.5 * k_1_m * pitch_m;
      const double on_top =
          pitch_m * pitch_m / (std::numbers::pi * R_m * R_m) * std::sin(half) / half;
      const double of_height = disc_mean_of_wave(k_1_m * R_m) / sinking_m_Pa(scene, response);
      curve.x.push_back(wavelength_m);
      curve.value.push_back(sum_V_Pa * (is_pressure ? on_top : of_height));
    }
    answer.curves.push_back(std::move(curve));
  }
}

// The pressure on each top and the gap over its middle, along the row that is nearest to the shape's point.
void add_profiles(const SpaceScene& scene, const SpaceContact& contact, SceneAnswer& answer) {
  constexpr auto column = static_cast<Eigen::Index>(TopLoad::kPressure);
  const RigidShape& shape = scene.press->shape;
  const auto nearest = std::min_element(
      scene.pillars.begin(), scene.pillars.end(), [&](const SpacePillar& a, const SpacePillar& b) {
        return std::abs(a.y_m - shape.y_m) < std::abs(b.y_m - shape.y_m);
      });
  SceneCurve pressure{.name = kPressureProfile, .unit = "Pa", .x_name = "x_m", .is_watched = false};
  SceneCurve gap{.name = kGapProfile, .unit = "m", .x_name = "x_m", .is_watched = false};
  for (std::size_t i = 0; i < scene.pillars.size(); ++i) {
    const SpacePillar& one = scene.pillars[i];
    if (one.row != nearest->row) continue;
    const auto at = static_cast<Eigen::Index>(i);
    pressure.x.push_back(one.x_m);
    pressure.value.push_back(contact.loads_Pa(at, column));
    pressure.error.push_back(std::abs(contact.change_Pa(at, column)) +
                             contact.stiffness_error * std::abs(pressure.value.back()));
    const double height = height_m(shape, one.x_m, one.y_m);
    if (!std::isfinite(height)) continue;
    const SpaceClass kind = class_of(scene, one);
    // A top that is touched everywhere has no gap; the others are as high as they were.
    const double above_m = kind.length_m - scene.length_m;
    const bool is_touched = contact.pressed.tops[i].share > 0.0;
    gap.x.push_back(one.x_m);
    gap.value.push_back(is_touched ? 0.0
                                   : std::max(height - contact.pressed.depth_m - above_m, 0.0));
  }
  if (asks_for(scene, kPressureProfile)) answer.curves.push_back(std::move(pressure));
  // A backing sinks beside the contact too, which is known under the touched pillars only.
  if (asks_for(scene, kGapProfile) && !scene.backing) answer.curves.push_back(std::move(gap));
}

}  // namespace viscard
