#include "models/array/space/simulate_space.h"

#include "models/array/space/contact_maps.h"
#include "models/maths/text_of_number.h"
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/mesh/scene_mistake.h"
#include "models/scene/common/error_control.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace viscard {
namespace {

constexpr double kCrosstalkScale = 10.0;  // %: a tolerance of 1e-3 gives per cents to 0.01 points
constexpr const char* kCrosstalk = "crosstalk_percent";
// At least this share of the tolerance is left for what the accuracies reduce.
constexpr double kShareOfAccuracy = 0.2;
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

SpaceAccuracy accuracy_for(const SpaceScene& scene, const SpaceArray& array,
                           const Discretisation& mesh) {
  const std::vector<SpaceAccuracy> all = space_accuracies(array);
  const auto found = std::find_if(all.begin(), all.end(), [&](const SpaceAccuracy& one) {
    return one.foot.degree >= mesh.degree;
  });
  SpaceAccuracy accuracy = found == all.end() ? all.back() : *found;
  // Electrodes do not overlap: within its own one, a pillar reads itself alone.
  if (!scene.feels_neighbours) accuracy.potential.reach_m = 2.0 * array.electrode_radius_m;
  return accuracy;
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

void add_result(const SceneMap& map, std::size_t at, const std::string& ending,
                SceneAnswer& answer) {
  const double error = map.error.empty() ? 0.0 : map.error[at];
  answer.results.push_back(
      {map.name + ending, map.value[at], map.unit, error, size_of(map), map.is_watched});
}

// Results are values of the maps.
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

// Relative errors that no accuracy of the array reduces: eq. S5, S7 and S8.
struct ConstantErrors {
  double foot = 0.0;          // of a voltage
  double electrodes = 0.0;    // of a voltage
  double neighbour = 0.0;     // share of a load's field at its nearest neighbour
  std::vector<double> edge;   // by pillar
  double largest_edge = 0.0;  // of them
};

ConstantErrors constant_errors(const SpaceScene& scene) {
  ConstantErrors errors;
  errors.foot = rigid_foot_error(scene);
  errors.electrodes = electrode_error(scene);
  errors.neighbour = neighbour_influence(smallest_gap_m(scene) / scene.film_thickness_m,
                                         scene.film_thickness_m / scene.diameter_m);
  errors.edge = film_edge_errors(scene);
  errors.largest_edge = *std::max_element(errors.edge.begin(), errors.edge.end());
  return errors;
}

// The part of a map's error, in its unit, that all pillars have, and that of the film's edge. A foot's
// traction that is slightly wrong acts on the neighbours like its load, as a part of the field there.
double common_error_of(const SceneMap& map, const ConstantErrors& errors) {
  if (map.unit == "V") return (errors.foot + errors.electrodes) * size_of(map);
  return 100.0 * errors.electrodes + 200.0 * errors.foot * errors.neighbour;
}
double edge_error_of(const SceneMap& map, double edge) {
  return edge * (map.unit == "V" ? size_of(map) : 100.0);
}

// The largest of them relative to what the tolerance refers to.
double largest_constant_error(const SpaceScene& scene, const ConstantErrors& errors) {
  SceneMap voltage{.name = "", .unit = "V", .scale = 1.0};
  const double of_voltages = common_error_of(voltage, errors) + errors.largest_edge;
  if (!has_crosstalk(scene) || !asks_for_map(scene, kCrosstalk)) return of_voltages;
  const SceneMap crosstalk{.name = kCrosstalk, .unit = "%", .scale = kCrosstalkScale};
  return std::max(of_voltages, (common_error_of(crosstalk, errors) +
                                edge_error_of(crosstalk, errors.largest_edge)) /
                                   kCrosstalkScale);
}

[[noreturn]] void refuse(const SpaceScene& scene, double error, const ConstantErrors& parts) {
  const std::string size = " of about " + text_of(error, 2) + ", too much for a tolerance of " +
                           text_of(scene.tolerance, 2) + "; ask for a larger one, or for a ";
  if (parts.electrodes > std::max(parts.largest_edge, parts.foot)) {
    throw SceneMistake(
        "geometry.electrode.radius",
        "the electrodes lie so close that the charges of all influence each other, which "
        "leaves a relative error" +
            size + "smaller radius");
  }
  if (parts.largest_edge > parts.foot) {
    throw SceneMistake(
        "geometry.film.edge",
        "the film is solved without its edge, which lies " + micrometres(scene.film_edge_m, 4) +
            " from the outer pillars. That leaves a relative error" + size + "wider film");
  }
  throw SceneMistake("materials",
                     "the pillars are solved on a rigid base. On this film that leaves a relative "
                     "error" +
                         size + "stiffer film");
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

std::vector<std::string> result_names(const SpaceScene& scene) {
  std::vector<std::string> names;
  for (const std::string& reading : reading_names(scene.electrode)) {
    names.push_back(reading + "_voltage");
  }
  if (has_crosstalk(scene)) names.emplace_back(kCrosstalk);
  if (!scene.press) return names;
  for (const auto& of_contact : {contact_maps(), contact_results()}) {
    names.insert(names.end(), of_contact.begin(), of_contact.end());
  }
  return names;
}

std::vector<Discretisation> space_meshes(const SpaceScene& scene) {
  std::vector<Discretisation> meshes;
  for (const SpaceAccuracy& one : space_accuracies(array_of(scene))) meshes.push_back(one.foot);
  return meshes;
}

namespace {

SceneAnswer voltages_on(const SpaceScene& scene, const TopLoads& loads_Pa,
                        const Discretisation& mesh) {
  const SpaceArray array = array_of(scene);
  const SpaceAccuracy accuracy = accuracy_for(scene, array, mesh);
  const SpaceResponse response(array, accuracy);
  SceneAnswer answer;
  answer.discretisation = accuracy.foot;
  answer.unknowns = response.unknowns();
  answer.array = array_of_answer(scene, loads_Pa);
  answer.maps = maps_of(scene, response, loads_Pa);
  set_results(scene, answer);
  return answer;
}

// What the last refinement of the tops changed in the voltages, as part of their errors.
void add_change_of_loads(const SpaceScene& scene, const SpaceContact& contact,
                         SceneAnswer& answer) {
  if (contact.change_Pa.isZero(0.0)) return;
  const SceneAnswer change = voltages_on(scene, contact.change_Pa, space_meshes(scene)[1]);
  for (std::size_t m = 0; m < answer.maps.size(); ++m) {
    for (std::size_t at = 0; at < answer.maps[m].value.size(); ++at) {
      answer.maps[m].error[at] += std::abs(change.maps[m].value[at]);
    }
  }
}

// The grids of the tops get a quarter of the tolerance.
constexpr double kShareOfContact = 0.25;

SpaceContact settled_contact(const SpaceScene& scene) {
  SpaceContact contact = contact_within(scene, kShareOfContact * scene.tolerance);
  const double error = contact_error(contact);
  if (error <= 2.0 * kShareOfContact * scene.tolerance) return contact;
  throw std::runtime_error("the finest grid of the tops leaves a relative error of about " +
                           text_of(error, 2) +
                           " in the forces, where a top is touched in part; ask for a larger "
                           "tolerance");
}

}  // namespace

SceneAnswer space_answer_on(const SpaceScene& scene, const Discretisation& mesh) {
  if (!scene.press) return voltages_on(scene, loads_of(scene), mesh);
  const SpaceContact contact = contact_on(scene, (mesh.degree - 3) / 2);
  SceneAnswer answer = voltages_on(scene, contact.loads_Pa, mesh);
  add_contact(scene, contact, answer);
  return answer;
}

SceneAnswer simulate_space(const SpaceScene& scene) {
  validate(scene);
  const ConstantErrors parts = constant_errors(scene);
  const double constant = largest_constant_error(scene, parts);
  if (constant > (1.0 - kShareOfAccuracy) * scene.tolerance) refuse(scene, constant, parts);
  std::optional<SpaceContact> contact;
  if (scene.press) contact = settled_contact(scene);
  const TopLoads loads_Pa = contact ? contact->loads_Pa : loads_of(scene);
  const double of_contact = contact ? contact_error(*contact) : 0.0;
  const double left =
      std::max(scene.tolerance - constant - of_contact, 0.5 * kShareOfAccuracy * scene.tolerance);
  SceneAnswer answer =
      answer_within({left, space_meshes(scene), scene.progress},
                    [&](const Discretisation& mesh) { return voltages_on(scene, loads_Pa, mesh); });
  if (contact) add_change_of_loads(scene, *contact, answer);
  for (SceneMap& map : answer.maps) {
    const double of_all = common_error_of(map, parts);
    for (std::size_t at = 0; at < map.value.size(); ++at) {
      map.error[at] += of_all + edge_error_of(map, parts.edge[map.pillar[at]]);
    }
  }
  answer.largest_relative_error += constant + of_contact;
  if (contact) add_contact(scene, *contact, answer);
  set_results(scene, answer);
  if (contact) answer.notes = contact_notes(scene, *contact);
  return answer;
}

}  // namespace viscard
