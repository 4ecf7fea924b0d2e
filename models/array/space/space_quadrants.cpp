// Forces of the pillars from the voltages of the quarters of their electrodes (models/array/quadrants).
#include "models/answer/scene_mistake.h"
#include "models/array/quadrants/sensed_array.h"
#include "models/array/space/simulate_space.h"
#include "models/array/space/space_maps.h"
#include "models/maths/near_sums.h"
#include "models/maths/text_of_number.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace viscard {
namespace {

struct SensedForce {
  TopLoad load;
  const char* what;  // in names
};
constexpr std::array<SensedForce, kSensedLoads> kForces = {
    {{TopLoad::kPressure, "normal"}, {TopLoad::kShearX, "shear_x"}, {TopLoad::kShearY, "shear_y"}}};
constexpr const char* kWithoutNeighbours = "without_neighbours_percent";
constexpr const char* kUnexplained = "unexplained_voltage";

std::string map_name(const SensedForce& one) {
  return std::string("sensed_") + one.what + "_force";
}

bool has_options(const QuadrantSensing& sensing) {
  return sensing.measured_V.size() > 0 || sensing.nodes || sensing.noise_V > 0.0 ||
         !sensing.by_neighbours;
}
// Most scenes want voltages only: forces are computed if they are asked for by name, or if the
// scene states how to find them.
bool asks_for_sensed(const SpaceScene& scene, const std::string& name) {
  return scene.wanted.empty() ? has_options(scene.quadrants) : asks_for_map(scene, name);
}

std::vector<double> top_areas_m2(const SpaceScene& scene) {  // by class
  std::vector<double> areas;
  for (const SpaceClass& one : classes_of(scene)) {
    areas.push_back(0.25 * std::numbers::pi * one.diameter_m * one.diameter_m);
  }
  return areas;
}

// The response must outlive it. Sums over all pillars are for voltages of the whole array.
QuadrantArray quadrant_array(const SpaceScene& scene, const SpaceResponse& response,
                             bool has_sums = true) {
  QuadrantArray array;
  array.pillars = sources_of(array_of(scene));
  array.classes = static_cast<int>(scene.others.size()) + 1;
  array.reach_m = response.reach_m();
  array.kernel = [&response](int of_class, double x_m, double y_m) -> Eigen::MatrixXd {
    return response.kernel(of_class, x_m, y_m).bottomLeftCorner<4, kSensedLoads>();
  };
  array.by_neighbours = scene.quadrants.by_neighbours && scene.feels_neighbours;
  if (!has_sums) return array;
  array.voltages_V = [sums =
                          response.sums_of({TopLoad::kPressure, TopLoad::kShearX, TopLoad::kShearY},
                                           std::vector<bool>(scene.pillars.size(), true))](
                         const Eigen::MatrixXd& loads_Pa) -> Eigen::MatrixXd {
    return sums(loads_Pa).rightCols<4>();
  };
  return array;
}

// Means over nodes at an offset from a loaded pillar: quarters x loads.
Eigen::MatrixXd node_means(const SpaceResponse& response, const std::vector<QuadrantNode>& nodes,
                           int of_class, double x_m, double y_m) {
  Eigen::MatrixXd means = Eigen::MatrixXd::Zero(4, kTopLoads);
  for (const QuadrantNode& node : nodes) {
    means.row(node.quarter) +=
        node.weight * response.potential(of_class, x_m + node.x_m, y_m + node.y_m).transpose();
  }
  return means;
}

// Readings of the quarters: measured ones, or those of the scene's loads.
Eigen::MatrixXd quarters_V(const SpaceScene& scene, const SpaceResponse& response,
                           const TopLoads& loads_Pa, const Eigen::MatrixXd& readings_V) {
  const QuadrantSensing& sensing = scene.quadrants;
  if (sensing.measured_V.size() > 0) return sensing.measured_V;
  if (!sensing.nodes) return readings_V.rightCols<4>();
  const std::vector<QuadrantNode> nodes = nodes_of(*sensing.nodes, electrode_radius_m(scene));
  const SpaceArray array = array_of(scene);
  return NearSums(sources_of(array), std::vector<bool>(scene.pillars.size(), true),
                  response.reach_m(),
                  [&](int of_class, double x_m, double y_m) {
                    return node_means(response, nodes, of_class, x_m, y_m);
                  })
      .apply(loads_Pa);
}

Eigen::MatrixXd forces_N(const SpaceScene& scene, Eigen::MatrixXd loads_Pa) {
  const std::vector<double> areas_m2 = top_areas_m2(scene);
  for (std::size_t i = 0; i < scene.pillars.size(); ++i) {
    loads_Pa.row(static_cast<Eigen::Index>(i)) *=
        areas_m2[static_cast<std::size_t>(scene.pillars[i].of_class)];
  }
  return loads_Pa;
}

// Reference value of voltage errors: the largest voltage.
double force_of_voltage_N(const SpaceScene& scene, const std::vector<QuadrantGains>& gains,
                          int load, double largest_V) {
  double largest_N = 0.0;
  const std::vector<double> areas_m2 = top_areas_m2(scene);
  for (std::size_t c = 0; c < gains.size(); ++c) {
    largest_N = std::max(largest_N, gains[c].row(load).cwiseAbs().sum() * areas_m2[c]);
  }
  return largest_N * largest_V;
}

}  // namespace

std::vector<std::string> sensed_maps(const SpaceScene& scene) {
  std::vector<std::string> names;
  if (!has_quarters(scene.electrode)) return names;
  for (const SensedForce& one : kForces) names.push_back(map_name(one));
  return names;
}

std::vector<std::string> sensed_results(const SpaceScene& scene) {
  std::vector<std::string> names;
  if (!has_quarters(scene.electrode)) return names;
  names = {kWithoutNeighbours, kUnexplained, "decoupling_condition"};
  for (const SensedForce& one : kForces) {
    names.push_back(std::string("gain_") + one.what);
    if (scene.quadrants.measured_V.size() == 0)
      names.push_back(std::string("sensed_") + one.what + "_deviation");
    if (scene.quadrants.noise_V > 0.0 || scene.noise) {
      names.push_back(std::string("resolution_") + one.what + "_force");
    }
  }
  return names;
}

bool senses_forces(const SpaceScene& scene) {
  const auto asks = [&](const std::vector<std::string>& names) {
    return std::any_of(names.begin(), names.end(),
                       [&](const std::string& name) { return asks_for_sensed(scene, name); });
  };
  return asks(sensed_maps(scene)) || asks(sensed_results(scene));
}

TopLoads measured_loads_Pa(const SpaceScene& scene) {
  const SpaceArray array = array_of(scene);
  const SpaceResponse response(array, space_accuracies(array)[1]);
  const QuadrantArray quadrants = quadrant_array(scene, response);
  const SensedArray sensed =
      sensed_array(quadrants, gains_by_class(quadrants), scene.quadrants.measured_V);
  TopLoads loads_Pa = TopLoads::Zero(sensed.loads_Pa.rows(), kTopLoads);
  loads_Pa.leftCols<kSensedLoads>() = sensed.loads_Pa;
  return loads_Pa;
}

void add_sensed(const SpaceScene& scene, const SpaceResponse& response, const TopLoads& loads_Pa,
                const Eigen::MatrixXd& readings_V, SceneAnswer& answer) {
  const bool is_measured = scene.quadrants.measured_V.size() > 0;
  const QuadrantArray quadrants = quadrant_array(scene, response);
  const std::vector<QuadrantGains> gains = gains_by_class(quadrants);
  const Eigen::MatrixXd read_V = quarters_V(scene, response, loads_Pa, readings_V);
  const SensedArray sensed = sensed_array(quadrants, gains, read_V);
  const Eigen::MatrixXd force_N = forces_N(scene, sensed.loads_Pa);
  const Eigen::MatrixXd alone_N = forces_N(scene, sensed.alone_Pa);
  const double largest_V = read_V.cwiseAbs().maxCoeff();
  const double largest_N = force_N.cwiseAbs().maxCoeff();
  for (int l = 0; l < kSensedLoads; ++l) {
    SceneMap map{
        map_name(kForces.at(static_cast<std::size_t>(l))), "N", {}, {}, {}, 0.0, is_measured};
    map.scale = force_of_voltage_N(scene, gains, l, largest_V);
    for (std::size_t i = 0; i < scene.pillars.size(); ++i) {
      map.pillar.push_back(i);
      map.value.push_back(force_N(static_cast<Eigen::Index>(i), l));
    }
    if (!is_measured) map.error.assign(map.value.size(), 0.0);  // that of the voltages, set later
    if (asks_for_sensed(scene, map.name)) answer.maps.push_back(std::move(map));
    if (is_measured) continue;
    const Eigen::MatrixXd borne_N = forces_N(
        scene, loads_Pa.col(static_cast<int>(kForces.at(static_cast<std::size_t>(l)).load)));
    answer.results.push_back(
        {std::string("sensed_") + kForces.at(static_cast<std::size_t>(l)).what + "_deviation",
         (force_N.col(l) - borne_N).cwiseAbs().maxCoeff(), "N", 0.0,
         force_of_voltage_N(scene, gains, l, largest_V), false});
  }
  const double percent =
      largest_N > 0.0 ? 100.0 * (alone_N - force_N).cwiseAbs().maxCoeff() / largest_N : 0.0;
  answer.results.push_back({kWithoutNeighbours, percent, "%", 0.0, kCrosstalkScale, false});
  answer.results.push_back(
      {kUnexplained, sensed.left_V.cwiseAbs().maxCoeff(), "V", 0.0, largest_V, false});
}

void add_reading_noise(const SpaceScene& scene, SceneAnswer& answer) {
  constexpr double kIn95 = 1.96;  // standard deviations
  const double noise_V = quarter_noise_V(scene);
  if (scene.quadrants.measured_V.size() == 0 || noise_V == 0.0) return;
  const SpaceArray array = array_of(scene);
  const SpaceResponse response(array, space_accuracies(array)[1]);
  const QuadrantArray quadrants = quadrant_array(scene, response, false);
  const std::vector<QuadrantGains> gains = gains_by_class(quadrants);
  const NoiseGrowth growth = growth_in_middle(quadrants, gains);
  const std::vector<double> areas_m2 = top_areas_m2(scene);
  double largest_N = 0.0;
  for (int l = 0; l < kSensedLoads; ++l) {
    for (SceneMap& map : answer.maps) {
      if (map.name != map_name(kForces.at(static_cast<std::size_t>(l)))) continue;
      map.is_watched = false;  // no finer accuracy makes it less
      for (std::size_t at = 0; at < map.error.size(); ++at) {
        const auto c = static_cast<std::size_t>(scene.pillars[map.pillar[at]].of_class);
        const double noise_N =
            kIn95 * growth.factor[l] * sensed_noise_Pa(gains[c], noise_V)[l] * areas_m2[c];
        map.error[at] += noise_N;
        largest_N = std::max(largest_N, noise_N);
      }
    }
  }
  answer.notes.push_back("the errors of the forces contain the noise of the readings, " +
                         text_of(noise_V, 3) + " V rms: up to " + text_of(largest_N, 3) +
                         " N (95 %)");
}

void finish_sensed(const SpaceScene& scene, SceneAnswer& answer) {
  // Results that are computed from the voltages have the same relative error, with their own
  // reference value.
  const std::vector<std::string> names = sensed_results(scene);
  for (SceneResult& one : answer.results) {
    if (std::find(names.begin(), names.end(), one.name) == names.end()) continue;
    one.error_estimate = answer.largest_relative_error * std::max(std::abs(one.value), one.scale);
  }
  const SpaceArray array = array_of(scene);
  const std::vector<SpaceAccuracy> accuracies = space_accuracies(array);
  const SpaceResponse coarse(array, accuracies[1]), response(array, accuracies[2]);
  const QuadrantGains before = gains_by_class(quadrant_array(scene, coarse, false)).front();
  const QuadrantArray quadrants = quadrant_array(scene, response, false);
  const std::vector<QuadrantGains> gains = gains_by_class(quadrants);
  const NoiseGrowth growth = growth_in_middle(quadrants, gains);
  const double noise_V = quarter_noise_V(scene);
  const double area_m2 = top_areas_m2(scene).front();
  const Eigen::Vector3d alone_Pa = sensed_noise_Pa(gains.front(), noise_V);
  for (int l = 0; l < kSensedLoads; ++l) {
    const std::string what = kForces.at(static_cast<std::size_t>(l)).what;
    const double gain = gains.front()(l, 0);  // of quarter 1; the others have the same size
    const double share = rigid_foot_error(scene) + std::abs(before(l, 0) / gain - 1.0);
    answer.results.push_back({"gain_" + what, gain, "Pa/V", share * std::abs(gain), 0.0, false});
    if (noise_V == 0.0) continue;
    const double resolution_N = growth.factor[l] * alone_Pa[l] * area_m2;
    answer.results.push_back(
        {"resolution_" + what + "_force", resolution_N, "N", share * resolution_N, 0.0, false});
  }
  answer.results.push_back({"decoupling_condition", growth.condition, "1",
                            2.0 * rigid_foot_error(scene) * growth.condition, 0.0, false});
}

std::vector<std::string> sensed_notes(const SpaceScene& scene) {
  std::vector<std::string> notes;
  if (scene.press) {
    notes.emplace_back(
        "quarters cannot tell a shear from a moment on the top: a sensed shear force is that of "
        "the shear plus the "
        "moment over the pillar's length");
  }
  if (!scene.quadrants.nodes) return notes;
  const SpaceArray array = array_of(scene);
  const SpaceResponse response(array, space_accuracies(array)[1]);
  const Eigen::MatrixXd means = node_means(
      response, nodes_of(*scene.quadrants.nodes, electrode_radius_m(scene)), 0, 0.0, 0.0);
  const Eigen::MatrixXd seen =
      quadrant_gains(response.kernel(0, 0.0, 0.0).bottomLeftCorner<4, kSensedLoads>()) *
      means.leftCols<kSensedLoads>();
  const auto percent = [&](int reads, int of) {
    return text_of(100.0 * seen(reads, of), 3) + " %";
  };
  notes.push_back(
      "means over nodes count nodes on an axis to one side only, so that quarters are weighted "
      "unevenly. Of a lone pillar, a "
      "pressure reads as " +
      percent(0, 0) + " of itself; a shear along x as " + percent(0, 1) +
      " of it as pressure and " + percent(1, 1) + " of itself; a shear along y as " +
      percent(0, 2) + " of it as pressure and " + percent(2, 2) +
      " of itself. Means over the quarters have none of this");
  return notes;
}

void check_quadrants(const SpaceScene& scene) {
  const QuadrantSensing& sensing = scene.quadrants;
  const bool is_measured = sensing.measured_V.size() > 0;
  if (!has_options(sensing)) return;
  if (!has_quarters(scene.electrode)) {
    throw SceneMistake(
        "quadrants",
        "belongs to electrodes in quarters: say electrode = { quadrants = true, ... }");
  }
  if (sensing.noise_V > 0.0 && scene.noise) {
    throw SceneMistake(
        "quadrants.noise",
        "cannot stand beside [noise], which gives the noise of an amplifier; leave one out");
  }
  if (sensing.nodes) {
    if (is_metal(scene.electrode)) {
      throw SceneMistake("quadrants.averages",
                         "as means over nodes are those of a charge-free face; quarters of metal "
                         "have one voltage each: write electrode.kind = \"sampled\"");
    }
    at_key("quadrants", [&] { nodes_of(*sensing.nodes, electrode_radius_m(scene)); });
    if (is_measured) {
      throw SceneMistake(
          "quadrants.averages",
          "belongs to voltages that are computed; measured ones are read by electrodes");
    }
    if (scene.backing) {
      throw SceneMistake("quadrants.averages",
                         "as means over nodes are answered on a rigid backing only");
    }
  }
  if (!is_measured) return;
  if (has_load(scene) || scene.press) {
    throw SceneMistake(
        "quadrants.voltages",
        "cannot stand beside a load or a shape: the forces are found from the voltages");
  }
  if (sensing.measured_V.rows() != static_cast<Eigen::Index>(scene.pillars.size()) ||
      sensing.measured_V.cols() != 4 || !sensing.measured_V.allFinite()) {
    throw SceneMistake("quadrants.voltages", "needs four finite voltages for each pillar");
  }
}

}  // namespace viscard
