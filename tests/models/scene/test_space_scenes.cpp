// Arrays in the plane as scenes: maps, results, plan and refusals.
#include "models/answer/scene_mistake.h"
#include "models/array/space/simulate_space.h"
#include "models/scene/simulate.h"
#include "tests/models/array/space/film_of_the_thesis.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace viscard;
using namespace viscard::test;

namespace {

// Pillars of the thesis, d 40 um, l 120 um, s 60 um, on its film, with a wide edge.
SpaceScene array_of_the_thesis(int rows, int columns) {
  SpaceScene scene;
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = 0.33;
  scene.pillar.rho_kg_m3 = 965.0;
  scene.film = pvdf_of_the_thesis();
  scene.rows = rows;
  scene.columns = columns;
  scene.pillars = lattice_places(SpaceLattice::kSquare, rows, columns, 100e-6);
  scene.film_edge_m = 300e-6;
  scene.pressure_Pa = 1e3;
  return scene;
}

const SceneMap& map_of(const SceneAnswer& answer, const std::string& name) {
  const auto found = std::find_if(answer.maps.begin(), answer.maps.end(),
                                  [&](const SceneMap& map) { return map.name == name; });
  if (found == answer.maps.end()) throw std::runtime_error("no map " + name);
  return *found;
}

double value_at(const SceneAnswer& answer, const std::string& name, int row, int column) {
  const SceneMap& map = map_of(answer, name);
  for (std::size_t at = 0; at < map.value.size(); ++at) {
    const ScenePillar& one = answer.array.pillars[map.pillar[at]];
    if (one.row == row && one.column == column) return map.value[at];
  }
  throw std::runtime_error("no value there");
}

const SceneEffect& effect_of(const SceneAnswer& answer, const std::string& name) {
  const auto found = std::find_if(answer.effects.begin(), answer.effects.end(),
                                  [&](const SceneEffect& e) { return e.name == name; });
  if (found == answer.effects.end()) throw std::runtime_error("no effect " + name);
  return *found;
}

}  // namespace

// Converged values of an independent program (the same equations with feet of p = 8, four layers, 256
// angles instead of harmonics), confirmed for V_c and V_m at this spacing by a three-dimensional
// finite-element solution of 3 x 3 pillars (dolfinx, quadratic tetrahedra) to 0.6 % of each cross-talk.
TEST_CASE("one loaded pillar reads and disturbs its neighbours as the reference does",
          "[models][array][space]") {
  SpaceScene scene = array_of_the_thesis(7, 7);
  scene.loaded = {{4, 4}};
  const SceneAnswer answer = simulate(scene);
  CHECK(1e3 * value_at(answer, "centre_voltage", 4, 4) == Approx(-2.40475).epsilon(2e-4));
  CHECK(1e3 * value_at(answer, "mean_voltage", 4, 4) == Approx(-1.92665).epsilon(2e-4));
  struct Place {
    int row, column;
    double mean, centre;  // per cent of the loaded pillar's own; x (the columns) is the stretch
  };
  const double own_V = value_at(answer, "centre_voltage", 4, 4);
  for (const Place& place : {Place{4, 5, -0.2633, -0.2239}, Place{5, 4, 0.1928, 0.1255},
                             Place{5, 5, -0.0423, -0.0334}}) {
    CAPTURE(place.row, place.column);
    const double centre_V = value_at(answer, "centre_voltage", place.row, place.column);
    CHECK(value_at(answer, "crosstalk_percent", place.row, place.column) ==
          Approx(place.mean).margin(2e-3));
    CHECK(100.0 * centre_V / own_V == Approx(place.centre).margin(2e-3));
  }
  CHECK(value_at(answer, "crosstalk_percent", 4, 6) == Approx(-0.0096).margin(1e-3));
  CHECK(value_at(answer, "crosstalk_percent", 6, 4) == Approx(-0.0016).margin(1e-3));
  for (const SceneMap& map : answer.maps) {
    CHECK(largest_size(map.error) <= scene.tolerance * size_of(map) * (1.0 + 1e-12));
  }
}

TEST_CASE("quarters of an electrode read pressure and shear as the reference does",
          "[models][array][space]") {
  SpaceScene scene = array_of_the_thesis(1, 1);
  scene.electrode = SpaceElectrode::kQuadrants;
  scene.pressure_Pa = 0.0;
  scene.shear_x_Pa = 1e3;
  const SceneAnswer along = simulate(scene);
  const double q1 = 1e3 * value_at(along, "quadrant_1_voltage", 1, 1);
  CHECK(q1 == Approx(-7.78507).epsilon(5e-4));
  for (const auto& [quadrant, sign] : {std::pair{2, -1.0}, {3, -1.0}, {4, 1.0}}) {
    const std::string name = "quadrant_" + std::to_string(quadrant) + "_voltage";
    CHECK(1e3 * value_at(along, name, 1, 1) == Approx(sign * q1).epsilon(1e-9));
  }
  scene.shear_x_Pa = 0.0;
  scene.shear_y_Pa = 1e3;
  CHECK(1e3 * value_at(simulate(scene), "quadrant_1_voltage", 1, 1) ==
        Approx(-7.32744).epsilon(5e-4));
}

// Voltage and neighbours as in tests/models/array/space/test_disc_electrodes.cpp.
TEST_CASE("equipotential electrodes on either face are a scene", "[models][array][space]") {
  SpaceScene scene = array_of_the_thesis(1, 3);
  scene.film = pvdf_of_the_thesis(23e-12, 23e-12, -33e-12);
  scene.grounded = FilmFace::kBottom;
  scene.electrode = SpaceElectrode::kEquipotential;
  scene.pressure_Pa = 1e4;
  scene.loaded = {{1, 2}};
  scene.tolerance = 2e-3;
  const SceneAnswer answer = simulate(scene);
  CHECK(1e3 * value_at(answer, "electrode_voltage", 1, 2) == Approx(18.1983).epsilon(1e-3));
  CHECK(value_at(answer, "crosstalk_percent", 1, 1) == Approx(-0.416).margin(0.02));
  CHECK(value_at(answer, "crosstalk_percent", 1, 3) ==
        Approx(value_at(answer, "crosstalk_percent", 1, 1)).epsilon(1e-9));

  scene.electrode = SpaceElectrode::kSampled;
  CHECK_THROWS_WITH(simulate(scene), Catch::Contains("cannot be the top"));

  // Electrodes that almost touch change each other's charge, which the answer contains (eq. S17).
  scene.electrode = SpaceElectrode::kEquipotential;
  scene.electrode_radius_m = 45e-6;
  scene.tolerance = 1e-2;
  CHECK(10.0 * electrode_error(scene) > scene.tolerance);
  CHECK(value_at(simulate(scene), "crosstalk_percent", 1, 1) == Approx(1.3204).margin(0.05));
}

TEST_CASE("an array that is its mirror image reads symmetrically", "[models][array][space]") {
  SpaceScene scene = array_of_the_thesis(3, 4);
  scene.tolerance = 1e-2;
  const SceneAnswer answer = simulate(scene);
  for (int row = 1; row <= 3; ++row) {
    for (int column = 1; column <= 4; ++column) {
      const double V = value_at(answer, "mean_voltage", row, column);
      CHECK(value_at(answer, "mean_voltage", 4 - row, column) == Approx(V).epsilon(1e-10));
      CHECK(value_at(answer, "mean_voltage", row, 5 - column) == Approx(V).epsilon(1e-10));
    }
  }
  // Without a direction of its own, the film makes rows and columns alike.
  SpaceScene square = array_of_the_thesis(3, 3);
  square.tolerance = 1e-2;
  square.film = pvdf_of_the_thesis(12.5e-12, 12.5e-12);
  const SceneAnswer turned = simulate(square);
  CHECK(value_at(turned, "mean_voltage", 1, 2) ==
        Approx(value_at(turned, "mean_voltage", 2, 1)).epsilon(1e-8));
}

TEST_CASE("a dead pillar is missing in the maps and changes no other reading",
          "[models][array][space]") {
  SpaceScene scene = array_of_the_thesis(3, 3);
  scene.loaded = {{1, 1}, {2, 2}};
  scene.tolerance = 1e-2;
  const SceneAnswer whole = simulate(scene);
  scene.pillars.erase(scene.pillars.begin() + 5);  // [2, 3]
  const SceneAnswer without = simulate(scene);
  CHECK(map_of(without, "mean_voltage").value.size() == 8);
  CHECK(map_of(without, "crosstalk_percent").value.size() == 6);
  CHECK_THROWS(value_at(without, "mean_voltage", 2, 3));
  for (const ScenePillar& one : without.array.pillars) {
    CHECK(value_at(without, "mean_voltage", one.row, one.column) ==
          Approx(value_at(whole, "mean_voltage", one.row, one.column)).epsilon(1e-12));
  }
}

TEST_CASE("a class of pillars that are like the others changes nothing, one of shorter ones does",
          "[models][array][space]") {
  SpaceScene scene = array_of_the_thesis(1, 2);
  scene.tolerance = 1e-2;
  scene.electrode = SpaceElectrode::kQuadrants;
  scene.shear_x_Pa = 100.0;
  const SceneAnswer usual = simulate(scene);
  scene.others = {{scene.diameter_m, scene.length_m, scene.pillar}};
  scene.pillars[1].of_class = 1;
  const std::string name = "quadrant_1_voltage";
  CHECK(value_at(simulate(scene), name, 1, 2) ==
        Approx(value_at(usual, name, 1, 2)).epsilon(1e-12));
  // The moment at the foot of a sheared pillar goes with its length: 120 to 100 um.
  scene.others.front().length_m = 100e-6;
  scene.pressure_Pa = 0.0;
  scene.loaded = {{1, 2}};
  const double shorter_V = value_at(simulate(scene), name, 1, 2);
  scene.others.front().length_m = 120e-6;
  const double longer_V = value_at(simulate(scene), name, 1, 2);
  CHECK(shorter_V / longer_V == Approx(100.0 / 120.0).epsilon(0.02));
}

TEST_CASE("results are extremes of the maps and the pillars that are asked for",
          "[models][array][space]") {
  SpaceScene scene = array_of_the_thesis(6, 6);
  scene.tolerance = 1e-2;
  scene.loaded = {{2, 5}};
  scene.wanted = {"mean_voltage", "mean_voltage_2_5", "crosstalk_percent_2_4"};
  const SceneAnswer answer = simulate(scene);
  std::vector<std::string> names;
  for (const SceneResult& result : answer.results) names.push_back(result.name);
  CHECK(names == std::vector<std::string>{"mean_voltage_largest", "mean_voltage_smallest",
                                          "mean_voltage_2_5", "crosstalk_percent_largest",
                                          "crosstalk_percent_smallest", "crosstalk_percent_2_4"});
  CHECK(answer.results[1].value == answer.results[2].value);  // the loaded one is the lowest
  CHECK(answer.results[2].value == value_at(answer, "mean_voltage", 2, 5));
  const SceneAnswer all = simulate(array_of_the_thesis(5, 5));
  CHECK(all.results.size() == 2 * (25 + 2));
}

TEST_CASE("cross-talk that is off leaves each pillar its own reading", "[models][array][space]") {
  SpaceScene scene = array_of_the_thesis(3, 3);
  scene.wanted = {"mean_voltage"};
  scene.tolerance = 2e-3;
  const SceneAnswer on = simulate(scene);
  CHECK(effect_of(on, "crosstalk").on);
  scene.effects["crosstalk"] = EffectChoice::kOff;
  const SceneAnswer off = simulate(scene);
  CHECK_FALSE(effect_of(off, "crosstalk").on);
  const SceneMap& map = map_of(off, "mean_voltage");
  CHECK(1e3 * map.value.front() == Approx(-1.92665).epsilon(2e-3));
  for (std::size_t i = 0; i < map.value.size(); ++i) {
    CHECK(map.value[i] == map.value.front());
    CHECK(map.error[i] > std::abs(map.value[i] - map_of(on, "mean_voltage").value[i]));
  }
  scene.loaded = {{1, 1}};
  scene.wanted = {"mean_voltage", "crosstalk_percent"};
  CHECK_THROWS_AS(simulate(scene), SceneMistake);
}

TEST_CASE("far neighbours are left out where the tolerance allows it", "[models][array][space]") {
  SpaceScene scene = array_of_the_thesis(2, 2);
  scene.pillars = lattice_places(SpaceLattice::kSquare, 2, 2, 300e-6);
  CHECK_FALSE(effect_of(simulate(scene), "crosstalk").on);
  scene.shear_x_Pa = 10.0;  // but not where they are sheared
  CHECK(effect_of(simulate(scene), "crosstalk").on);
}

TEST_CASE("an array warns of effects that no analysis computes", "[models][array][space]") {
  SpaceScene scene = array_of_the_thesis(2, 2);
  scene.tolerance = 1e-2;
  scene.pressure_Pa = 1e4;
  scene.shear_x_Pa = 100.0;
  const SceneAnswer answer = simulate(scene);
  // tan(u)/u - 1 with u = (pi/2) sqrt(10/29.4): the moment of a cantilever under an axial load.
  CHECK(effect_of(answer, "geometric_stiffness").estimate == Approx(0.43).margin(0.02));
  const auto is_warned = [&](const std::string& effect) {
    return std::any_of(answer.notes.begin(), answer.notes.end(),
                       [&](const std::string& note) { return note.starts_with(effect + ":"); });
  };
  CHECK(is_warned("geometric_stiffness"));
  CHECK(is_warned("finite_strain"));
  CHECK_FALSE(is_warned("adhesion"));
  scene.pillars = lattice_places(SpaceLattice::kSquare, 2, 2, 46e-6);
  scene.length_m = 160e-6;
  scene.pressure_Pa = 1e3;
  CHECK(effect_of(simulate(scene), "adhesion").estimate == 1.0);
}

TEST_CASE("a film too soft or an edge too near is refused with the tolerance it would need",
          "[models][array][space]") {
  SpaceScene scene = array_of_the_thesis(2, 2);
  scene.film_edge_m = 10e-6;
  CHECK_THROWS_WITH(simulate(scene), Catch::Contains("edge, which lies 10 um"));
  scene.loaded = {{1, 1}};
  scene.film_edge_m = 300e-6;
  scene.pillar.E0_Pa = 1e8;
  CHECK_THROWS_WITH(simulate(scene), Catch::Contains("on a rigid base"));
}

TEST_CASE("the estimate of leaving out a backing covers what that changes",
          "[models][array][space]") {
  for (const double E_Pa : {4e9, 20e9, 200e9}) {
    SpaceScene scene = array_of_the_thesis(5, 5);
    scene.tolerance = 1e-3;
    scene.film_edge_m = 5e-3;
    const double rigid_V = value_at(simulate(scene), "mean_voltage", 3, 3);
    scene.backing = Backing{E_Pa, 0.3};
    const SceneAnswer answer = simulate(scene);
    CAPTURE(E_Pa);
    const SceneEffect& effect = effect_of(answer, "backing");
    CHECK(effect.on);
    const double change = std::abs(rigid_V / value_at(answer, "mean_voltage", 3, 3) - 1.0);
    CHECK(effect.estimate >= change);
    CHECK(effect.estimate <= 10.0 * change);
  }
}

TEST_CASE("a film that ends near loads on a soft backing is refused with the way out",
          "[models][array][space]") {
  SpaceScene scene = array_of_the_thesis(5, 5);
  scene.backing = Backing{1.8e6, 0.49};
  CHECK_THROWS_WITH(simulate(scene),
                    Catch::Contains("geometry.film.edge") || Catch::Contains("without its edge"));
  scene.tolerance = 0.5;
  const SceneAnswer answer = simulate(scene);
  // All pillars under 1 kPa: the stretch of the film reads more than the pressure.
  const bool says_so = std::any_of(answer.notes.begin(), answer.notes.end(), [](const auto& note) {
    return note.find("stretching") != std::string::npos;
  });
  CHECK(says_so);
}
