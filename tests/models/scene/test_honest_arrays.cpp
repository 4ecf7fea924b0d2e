// Arrays in the plane where an answer could be surer than it is: electrodes that touch, charges that are left out, a film
// that ends, and pillars that buckle.
#include "models/answer/scene_mistake.h"
#include "models/array/film/disc_coupling.h"
#include "models/array/space/simulate_space.h"
#include "models/pillar/analyses/buckling_limit.h"
#include "models/scene/simulate.h"
#include "tests/models/array/space/film_of_the_thesis.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <string>

using namespace viscard;
using namespace viscard::test;

namespace {

SpaceScene array_at(std::vector<SpacePillar> pillars, double diameter_m) {
  SpaceScene scene;
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = 0.33;
  scene.pillar.rho_kg_m3 = 965.0;
  scene.film = pvdf_of_the_thesis();
  scene.rows = 1;
  scene.columns = 1;
  for (const SpacePillar& one : pillars) {
    scene.rows = std::max(scene.rows, one.row);
    scene.columns = std::max(scene.columns, one.column);
  }
  scene.pillars = std::move(pillars);
  scene.diameter_m = diameter_m;
  scene.film_edge_m = 300e-6;
  scene.pressure_Pa = 1e3;
  return scene;
}

std::string refusal_of(const SpaceScene& scene) {
  try {
    validate(scene);
  } catch (const SceneMistake& mistake) {
    return mistake.what();
  }
  return "";
}

}  // namespace

TEST_CASE("electrodes that touch, or are nearer than their charges are resolved, are refused",
          "[models][array][space][stability]") {
  const double pitch_m = 70e-6;
  const auto lattice = GENERATE(SpaceLattice::kSquare, SpaceLattice::kHexagonal);
  SpaceScene scene = array_at(lattice_places(lattice, 3, 2, pitch_m), 40e-6);
  scene.electrode = SpaceElectrode::kEquipotential;
  scene.grounded = GENERATE(FilmFace::kTop, FilmFace::kBottom);
  // Touching as far as numbers can tell: as half of the pitch, or one rounding beside it.
  for (const double radius_m : {0.5 * pitch_m, 0.5 * pitch_m * (1.0 - 1e-13), 35e-6}) {
    scene.electrode_radius_m = radius_m;
    CHECK_THAT(refusal_of(scene), Catch::Contains("one conductor"));
  }
  const double least_m = least_gap_m(scene.film_thickness_m, 0.5 * pitch_m);
  scene.electrode_radius_m = 0.5 * (pitch_m - 0.9 * least_m);
  CHECK_THAT(refusal_of(scene), Catch::Contains("not resolved"));
  scene.electrode_radius_m = 0.51 * pitch_m;
  CHECK_THAT(refusal_of(scene), Catch::Contains("overlap"));
  scene.electrode_radius_m = 0.5 * (pitch_m - 1.1 * least_m);
  CHECK(refusal_of(scene).empty());
  // Means over discs of a face without metal may touch.
  scene.grounded = FilmFace::kTop;
  scene.electrode = SpaceElectrode::kSampled;
  scene.electrode_radius_m = 0.5 * pitch_m;
  CHECK(refusal_of(scene).empty());
}

TEST_CASE("electrodes at places of a list that touch are refused, however far the others are",
          "[models][array][space][stability]") {
  SpaceScene scene =
      array_at({{1, 1, 0.0, 0.0, 0}, {1, 2, 300e-6, 0.0, 0}, {2, 1, 330e-6, 40e-6, 0}}, 40e-6);
  scene.electrode = SpaceElectrode::kEquipotential;
  scene.electrode_radius_m = 25e-6;
  CHECK_THAT(refusal_of(scene), Catch::Contains("pillars 2 and 3"));
  scene.electrode_radius_m = 22e-6;
  CHECK(refusal_of(scene).empty());
}

// What the charges add that electrodes induce on each other lies within what leaving them out is taken to cost. The
// nearest pair alone is a part of it.
TEST_CASE("charges that are left out change a voltage by less than is stated",
          "[models][array][space]") {
  const double pitch_m = GENERATE(74e-6, 90e-6);
  SpaceScene scene = array_at(lattice_places(SpaceLattice::kSquare, 4, 3, pitch_m), 58e-6);
  scene.film_thickness_m = GENERATE(15e-6, 42e-6);
  scene.electrode = SpaceElectrode::kEquipotential;
  scene.electrode_radius_m = 18e-6;
  const double stated = electrode_error(scene);
  const SpaceArray array = array_of(scene);
  const SpaceAccuracy accuracy = space_accuracies(array)[1];
  TopLoads loads = TopLoads::Zero(static_cast<Eigen::Index>(scene.pillars.size()), kTopLoads);
  for (Eigen::Index i = 0; i < loads.rows(); ++i) {
    loads(i, static_cast<int>(TopLoad::kPressure)) = 1e3;
    loads(i, static_cast<int>(TopLoad::kTiltX)) = i % 2 == 0 ? 300.0 : -300.0;
  }
  const Eigen::MatrixXd with_V = SpaceResponse(array, accuracy).voltages_V(loads);
  const Eigen::MatrixXd without_V =
      SpaceResponse(array, without_coupling(accuracy)).voltages_V(loads);
  const double change = (with_V - without_V).cwiseAbs().maxCoeff() / with_V.cwiseAbs().maxCoeff();
  INFO("changed " << change << ", stated " << stated);
  CHECK(change <= stated);
  SpaceScene two = scene;
  two.pillars.resize(2);
  CHECK(stated > 3.0 * electrode_error(two));
}

TEST_CASE("a load in the middle does not feel the edge of the film, one at its rim does",
          "[models][array][space]") {
  SpaceScene scene = array_at(lattice_places(SpaceLattice::kSquare, 21, 21, 100e-6), 40e-6);
  scene.film_edge_m = 60e-6;
  TopLoads loads = TopLoads::Zero(441, kTopLoads);
  const auto errors_of = [&](int row, int column, double pressure_Pa) {
    loads(static_cast<Eigen::Index>(*index_of(scene, {row, column})), 0) = pressure_Pa;
    return film_edge_errors(scene, loads);
  };
  const auto corner = *index_of(scene, {1, 1});
  const auto middle = *index_of(scene, {11, 11});
  std::vector<double> errors = errors_of(11, 11, 1e3);
  // 60 um and 1060 um over 25 um.
  CHECK(errors[corner] == Approx(std::exp(-0.9215 * 44.8)).epsilon(1e-9));
  CHECK(errors[middle] < errors[corner]);
  // A thousandth of it at the rim brings a thousandth of what a load there does.
  errors = errors_of(1, 1, 1.0);
  CHECK(errors[corner] == Approx(1e-3 * std::exp(-0.9215 * 4.8)).epsilon(1e-9));
  errors = errors_of(1, 1, 1e3);
  CHECK(errors[corner] == Approx(std::exp(-0.9215 * 4.8)).epsilon(1e-9));
}

TEST_CASE("a shape far from the film's edge is answered where a load up to it is refused",
          "[models][array][space]") {
  SpaceScene scene = array_at(lattice_places(SpaceLattice::kSquare, 15, 15, 100e-6), 40e-6);
  scene.film_edge_m = 60e-6;
  scene.wanted = {"mean_voltage_largest"};
  CHECK_THROWS_WITH(simulate(scene), Catch::Contains("solved without its edge"));
  scene.pressure_Pa = 0.0;
  scene.tolerance = 5e-3;
  scene.press =
      ShapePress{.shape = {.kind = ShapeKind::kParaboloid, .radius_m = 50e-3}, .depth_m = 0.5e-6};
  const SceneAnswer near = simulate(scene);
  scene.film_edge_m = 600e-6;
  const SceneAnswer wide = simulate(scene);
  CHECK(near.maps.front().value == wide.maps.front().value);
  // The same shape over the rim.
  scene.film_edge_m = 60e-6;
  scene.press->shape.x_m = 650e-6;
  CHECK_THROWS_WITH(simulate(scene), Catch::Contains("solved without its edge"));
}

// A column that is clamped at its foot: Euler's loads are as 1, 4 and 16, and shear takes the more of them the shorter
// the half wave is. The pillar's own meshes are the independent numbers.
TEST_CASE(
    "buckling loads of all ends of a column have Euler's factor before the correction for shear",
    "[pillar]") {
  PillarScene scene;
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = 0.33;
  scene.pillar.rho_kg_m3 = 965.0;
  scene.geometry.diameter_m = 40e-6;
  scene.geometry.length_m = GENERATE(120e-6, 200e-6, 400e-6);
  const double free_Pa = engesser_pressure_Pa(scene, TopEnd::kFree);
  const double slides_Pa = engesser_pressure_Pa(scene, TopEnd::kSlides);
  const double sticks_Pa = engesser_pressure_Pa(scene, TopEnd::kSticks);
  CHECK(euler_pressure_Pa(scene, TopEnd::kSlides) ==
        Approx(4.0 * euler_pressure_Pa(scene, TopEnd::kFree)));
  CHECK(euler_pressure_Pa(scene, TopEnd::kSticks) ==
        Approx(16.0 * euler_pressure_Pa(scene, TopEnd::kFree)));
  CHECK(free_Pa == Approx(pillar_buckling_pressure_Pa(scene)).epsilon(0.01));
  CHECK(slides_Pa == Approx(pillar_buckling_pressure_Pa(scene, TopEnd::kSlides)).epsilon(0.035));
  CHECK(slides_Pa < 4.0 * free_Pa);
  CHECK(sticks_Pa < 4.0 * slides_Pa);
  // 1/P = 1/P_e + 1/(kappa G A) for each.
  const double shear = 1.0 / free_Pa - 1.0 / euler_pressure_Pa(scene, TopEnd::kFree);
  CHECK(1.0 / sticks_Pa - 1.0 / euler_pressure_Pa(scene, TopEnd::kSticks) ==
        Approx(shear).epsilon(1e-9));
}

// 29.369 and 99.594 kPa of one pillar of the thesis, solved on its own mesh.
TEST_CASE("a note on buckling under a plate that slides has the load of the pillar's own mesh",
          "[models][array][space]") {
  SpaceScene scene = array_at(lattice_places(SpaceLattice::kSquare, 2, 2, 100e-6), 40e-6);
  scene.pressure_Pa = 0.0;
  scene.tolerance = 1e-2;
  scene.press = ShapePress{.shape = {.kind = ShapeKind::kPlane}, .depth_m = 3e-6};
  std::string note;
  for (const std::string& one : simulate(scene).notes) {
    if (one.starts_with("beyond buckling")) note = one;
  }
  CHECK_THAT(note, Catch::Contains("under a plate that slides at about "));
  const double held_Pa = std::stod(note.substr(note.find("slides at about ") + 16));
  CHECK(held_Pa == Approx(99594.0).epsilon(0.02));
}
