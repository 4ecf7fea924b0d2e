// Scenes that find forces from the voltages of quarters.
#include "models/answer/scene_mistake.h"
#include "models/array/sensing/thermal_noise.h"
#include "models/scene/plan.h"
#include "models/scene/simulate.h"
#include "tests/models/array/space/film_of_the_thesis.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>

using namespace viscard;
using namespace viscard::test;

namespace {

constexpr double kTop_m2 = std::numbers::pi * 20e-6 * 20e-6;

SpaceScene sheared_quarters() {
  SpaceScene scene;
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = 0.33;
  scene.pillar.rho_kg_m3 = 965.0;
  scene.film = pvdf_of_the_thesis();
  scene.rows = 4;
  scene.columns = 3;
  scene.pillars = lattice_places(SpaceLattice::kSquare, 4, 3, 100e-6);
  scene.film_edge_m = 300e-6;
  scene.tolerance = 2e-3;
  scene.electrode = SpaceElectrode::kQuadrants;
  scene.pressure_Pa = 1e3;
  scene.shear_x_Pa = 300.0;
  scene.shear_y_Pa = -200.0;
  scene.loaded = {{2, 2}, {3, 2}, {4, 1}};
  scene.wanted = {"sensed_normal_force",        "sensed_shear_x_force", "sensed_shear_y_force",
                  "without_neighbours_percent", "unexplained_voltage",  "gain_shear_x"};
  return scene;
}

const SceneMap& map_in(const SceneAnswer& answer, const std::string& name) {
  for (const SceneMap& map : answer.maps) {
    if (map.name == name) return map;
  }
  throw std::runtime_error("no map " + name);
}

const SceneResult& result_in(const SceneAnswer& answer, const std::string& name) {
  for (const SceneResult& one : answer.results) {
    if (one.name == name) return one;
  }
  throw std::runtime_error("no result " + name);
}

Eigen::MatrixXd quarters_of(const SceneAnswer& answer) {
  Eigen::MatrixXd voltages_V(static_cast<Eigen::Index>(answer.array.pillars.size()), 4);
  for (int q = 0; q < 4; ++q) {
    const SceneMap& map = map_in(answer, "quadrant_" + std::to_string(q + 1) + "_voltage");
    for (std::size_t i = 0; i < map.value.size(); ++i) {
      voltages_V(static_cast<Eigen::Index>(i), q) = map.value[i];
    }
  }
  return voltages_V;
}

std::string key_refused(const SpaceScene& scene) {
  try {
    plan_effects(scene);
  } catch (const SceneMistake& mistake) {
    return mistake.key();
  }
  return "";
}

}  // namespace

TEST_CASE("an array reads its own loads back from its quarters", "[models][array][space]") {
  const SpaceScene scene = sheared_quarters();
  const SceneAnswer answer = simulate(scene);
  const SceneMap& normal = map_in(answer, "sensed_normal_force");
  const SceneMap& along_x = map_in(answer, "sensed_shear_x_force");
  for (std::size_t i = 0; i < scene.pillars.size(); ++i) {
    const bool is_loaded = answer.array.pillars[i].is_loaded();
    CHECK(normal.value[i] == Approx(is_loaded ? 1e3 * kTop_m2 : 0.0).margin(1e-8 * kTop_m2));
    CHECK(along_x.value[i] == Approx(is_loaded ? 300.0 * kTop_m2 : 0.0).margin(1e-8 * kTop_m2));
    CHECK(normal.error[i] > 0.0);
    CHECK(normal.error[i] < 2e-3 * size_of(normal));
  }
  // A neighbour along x reads 3 % of a shear as pressure (the reference of the gains): 9 of 1000 Pa from each side.
  const double percent = result_in(answer, "without_neighbours_percent").value;
  CHECK(percent > 0.5);
  CHECK(percent < 2.0);
  CHECK(result_in(answer, "unexplained_voltage").value < 1e-9);
  CHECK(result_in(answer, "gain_shear_x").value == Approx(-32113.0).epsilon(1e-3));
}

// Noise of a tenth of the largest voltage: the intervals hold in about 95 of 100 forces, and without it in nearly none.
TEST_CASE("errors of forces from measured voltages contain the noise of the readings",
          "[models][array][space][stability]") {
  SpaceScene made = sheared_quarters();
  made.wanted = {"sensed_normal_force"};
  const SceneAnswer truth = simulate(made);
  const Eigen::MatrixXd clean_V = quarters_of(truth);
  SpaceScene read = sheared_quarters();
  read.pressure_Pa = read.shear_x_Pa = read.shear_y_Pa = 0.0;
  read.loaded.clear();
  read.tolerance = 1e-2;
  read.quadrants.noise_V = 0.1 * clean_V.cwiseAbs().maxCoeff();
  std::mt19937 bits(417);
  int inside = 0, inside_alone = 0, all = 0;
  for (int draw = 0; draw < 6; ++draw) {
    read.quadrants.measured_V = clean_V;
    for (double& V : read.quadrants.measured_V.reshaped()) {
      // Twelve uniform numbers: nearly normal, and the same everywhere.
      double sum = -6.0;
      for (int k = 0; k < 12; ++k) sum += static_cast<double>(bits()) / 4294967296.0;
      V += read.quadrants.noise_V * sum;
    }
    const SceneAnswer answer = simulate(read);
    SpaceScene unsaid = read;
    unsaid.quadrants.noise_V = 0.0;
    const SceneAnswer without = simulate(unsaid);
    const SceneMap &found = map_in(answer, "sensed_normal_force"),
                   &alone = map_in(without, "sensed_normal_force"),
                   &right = map_in(truth, "sensed_normal_force");
    for (std::size_t i = 0; i < found.value.size(); ++i) {
      const double off_N = std::abs(found.value[i] - right.value[i]);
      ++all;
      inside += off_N <= found.error[i] ? 1 : 0;
      inside_alone += off_N <= alone.error[i] ? 1 : 0;
    }
  }
  INFO(inside << " and " << inside_alone << " of " << all);
  CHECK(inside >= 0.9 * all);
  CHECK(inside_alone < 0.6 * all);
}

TEST_CASE("measured voltages give the forces that made them, within their errors",
          "[models][array][space]") {
  SpaceScene made = sheared_quarters();
  made.tolerance = 5e-4;
  made.film_edge_m = 400e-6;
  made.wanted = {"sensed_normal_force"};
  Eigen::MatrixXd voltages_V = quarters_of(simulate(made));
  SpaceScene read = sheared_quarters();
  read.pressure_Pa = read.shear_x_Pa = read.shear_y_Pa = 0.0;
  read.loaded.clear();
  read.tolerance = 1e-2;
  read.quadrants.measured_V = voltages_V;
  const SceneAnswer answer = simulate(read);
  const std::vector<RowColumn> loaded = made.loaded;
  const double sheared_Pa[] = {1e3, 300.0, -200.0};
  const char* const names[] = {"sensed_normal_force", "sensed_shear_x_force",
                               "sensed_shear_y_force"};
  for (int load = 0; load < 3; ++load) {
    const SceneMap& map = map_in(answer, names[load]);
    for (std::size_t i = 0; i < map.value.size(); ++i) {
      const SpacePillar& one = read.pillars[i];
      const bool is_loaded =
          std::count(loaded.begin(), loaded.end(), RowColumn(one.row, one.column)) > 0;
      const double error = std::abs(map.value[i] - (is_loaded ? sheared_Pa[load] * kTop_m2 : 0.0));
      CHECK(error <= map.error[i]);
      CHECK(error < 1e-2 * size_of(map));
    }
  }
  CHECK(result_in(answer, "unexplained_voltage").value < 1e-3 * voltages_V.cwiseAbs().maxCoeff());
  // A quarter that reads nothing shows: no loads explain what is left.
  voltages_V(4, 1) = 0.0;
  read.quadrants.measured_V = voltages_V;
  CHECK(result_in(simulate(read), "unexplained_voltage").value >
        1e-2 * voltages_V.cwiseAbs().maxCoeff());
}

TEST_CASE("means over nodes come with a note of their error", "[models][array][space]") {
  SpaceScene scene = sheared_quarters();
  scene.rows = scene.columns = 1;
  scene.pillars = {{1, 1, 0.0, 0.0, 0}};
  scene.loaded.clear();
  scene.shear_x_Pa = scene.shear_y_Pa = 0.0;
  scene.quadrants.nodes = NodeMeans{};
  SceneAnswer answer = simulate(scene);
  CHECK(map_in(answer, "sensed_normal_force").value[0] == Approx(1.0517e3 * kTop_m2).epsilon(1e-3));
  REQUIRE(answer.notes.size() == 1);
  CHECK(answer.notes[0].find("105 %") != std::string::npos);
  CHECK(answer.notes[0].find("-14 %") != std::string::npos);
  scene.pressure_Pa = 0.0;
  scene.shear_x_Pa = 1e3;
  answer = simulate(scene);
  CHECK(map_in(answer, "sensed_normal_force").value[0] == Approx(-0.140e3 * kTop_m2).epsilon(1e-2));
  CHECK(map_in(answer, "sensed_shear_x_force").value[0] == Approx(0.870e3 * kTop_m2).epsilon(2e-3));
}

TEST_CASE("noise of the quarters is a resolution of the forces", "[models][array][space]") {
  SpaceScene scene = sheared_quarters();
  scene.wanted = {"resolution_normal_force", "resolution_shear_x_force", "decoupling_condition"};
  scene.quadrants.noise_V = 1e-4;
  const SceneAnswer stated = simulate(scene);
  // 2 k v for a pillar alone (eq. Q4); neighbours at this pitch add some 0.1 %.
  CHECK(result_in(stated, "resolution_normal_force").value ==
        Approx(2.0 * 129759.0 * 1e-4 * kTop_m2).epsilon(5e-3));
  CHECK(result_in(stated, "resolution_shear_x_force").value ==
        Approx(2.0 * 32113.0 * 1e-4 * kTop_m2).epsilon(5e-3));
  CHECK(result_in(stated, "decoupling_condition").value == Approx(1.06).margin(0.06));
  // That of an amplifier: a quarter has a quarter of 12.23 fF.
  scene.quadrants.noise_V = 0.0;
  scene.noise = NoiseBand{.loss_tangent = 0.02, .amplifier_V_rtHz = 20e-9};
  scene.noise_readout =
      Readout{.kind = ReadoutKind::kVoltage, .resistance_Ohm = 1e13, .capacitance_F = 0.1e-12};
  const SceneAnswer amplified = simulate(scene);
  const double noise_V =
      result_in(amplified, "resolution_normal_force").value / (2.0 * 129759.0 * kTop_m2);
  const ThermalNoise quarter = thermal_noise(*scene.noise, *scene.noise_readout, 0.25 * 12.229e-15);
  CHECK(noise_V == Approx(quarter.total_V() / quarter.gain).epsilon(2e-2));
}

TEST_CASE("a quarter electrode resolves what an independent calculation finds", "[models]") {
  // Bias 1e13 ohm, tan d 0.02, 20 nV/rtHz, 1 to 100 Hz, 1.8198 mV/kPa of the manual's film: 0.876 kPa at 5 fF, 1.18 at 5 pF.
  const NoiseBand band{.loss_tangent = 0.02, .amplifier_V_rtHz = 20e-9};
  const auto resolution_kPa = [&](double input_F) {
    const Readout readout{
        .kind = ReadoutKind::kVoltage, .resistance_Ohm = 1e13, .capacitance_F = input_F};
    const ThermalNoise noise = thermal_noise(band, readout, 0.25 * 12.229e-15);
    return noise.total_V() / noise.gain / 1.8198e-3;
  };
  CHECK(resolution_kPa(5e-15) == Approx(0.876).epsilon(2e-2));
  CHECK(resolution_kPa(5e-12) == Approx(1.18).epsilon(2e-2));
}

TEST_CASE("a tilted top is sensed as a shear, and a note says so", "[models][array][space]") {
  SpaceScene scene = sheared_quarters();
  scene.pressure_Pa = scene.shear_x_Pa = scene.shear_y_Pa = 0.0;
  scene.loaded.clear();
  scene.tolerance = 2e-2;
  scene.wanted = {"sensed_shear_x_force", "sensed_shear_x_deviation", "moment_x"};
  ShapePress press;
  press.shape.kind = ShapeKind::kPlane;
  press.shape.tilt_x = 1e-3;
  press.depth_m = 1e-6;
  scene.press = press;
  const SceneAnswer answer = simulate(scene);
  const SceneMap& sensed = map_in(answer, "sensed_shear_x_force");
  const SceneMap& moment = map_in(answer, "moment_x");
  for (std::size_t i = 0; i < sensed.value.size(); ++i) {
    CHECK(std::abs(sensed.value[i]) == Approx(std::abs(moment.value[i]) / 120e-6).epsilon(2e-2));
  }
  CHECK(result_in(answer, "sensed_shear_x_deviation").value > 0.0);
  CHECK(std::any_of(answer.notes.begin(), answer.notes.end(), [](const std::string& note) {
    return note.find("moment") != std::string::npos;
  }));
}

TEST_CASE("quarters that contradict the scene are refused with the key", "[models][array][space]") {
  const auto with = [](const std::function<void(SpaceScene&)>& change) {
    SpaceScene scene = sheared_quarters();
    change(scene);
    return key_refused(scene);
  };
  CHECK(with([](SpaceScene& s) { s.quadrants.measured_V = Eigen::MatrixXd::Zero(12, 4); }) ==
        "quadrants.voltages");
  CHECK(with([](SpaceScene& s) {
          s.electrode = SpaceElectrode::kSampled;
          s.wanted.clear();
          s.quadrants.noise_V = 1e-4;
        }) == "quadrants");
  CHECK(with([](SpaceScene& s) {
          s.quadrants.nodes = NodeMeans{};
          s.backing = Backing{20e9, 0.3};
        }) == "quadrants.averages");
  CHECK(with([](SpaceScene& s) {
          s.pressure_Pa = s.shear_x_Pa = s.shear_y_Pa = 0.0;
          s.loaded.clear();
          s.quadrants.measured_V = Eigen::MatrixXd::Zero(11, 4);
        }) == "quadrants.voltages");
}
