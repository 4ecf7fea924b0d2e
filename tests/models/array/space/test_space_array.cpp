#include "models/answer/scene_mistake.h"
#include "models/array/space/space_array.h"
#include "models/array/space/space_maps.h"
#include "tests/models/array/space/film_of_the_thesis.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace viscard {
namespace {

using test::film_of_the_thesis;

constexpr int kCentre = 0;
constexpr int kMean = 1;
constexpr int kFirstQuadrant = 2;

// n x n pillars of 40 x 120 um, the first row at the lowest y; pillar (row, column) is row n + column.
SpaceArray square_array(int n, double spacing_m, const LayeredFilm& film) {
  SpaceArray array;
  array.classes = {{PillarGeometry{}, isotropic_medium(1.8e6, 0.33, 965.0)}};
  array.film = film;
  array.electrode = SpaceElectrode::kQuadrants;
  array.electrode_radius_m = 20e-6;
  const double pitch_m = 40e-6 + spacing_m;
  for (int row = 0; row < n; ++row) {
    for (int column = 0; column < n; ++column) {
      array.pillars.push_back(
          {(column - 0.5 * (n - 1)) * pitch_m, (row - 0.5 * (n - 1)) * pitch_m, 0});
    }
  }
  return array;
}

TopLoads load_on(const SpaceArray& array, int pillar, TopLoad load, double load_Pa = 1e3) {
  TopLoads loads = TopLoads::Zero(static_cast<Eigen::Index>(array.pillars.size()), kTopLoads);
  loads(pillar, static_cast<int>(load)) = load_Pa;
  return loads;
}

TEST_CASE("a pillar pressed on a wide film reads as converged codes do", "[models]") {
  const SpaceArray array = square_array(1, 60e-6, film_of_the_thesis(12.5e-12, 12.5e-12));
  const SpaceResponse response(array, space_accuracies(array).back());
  const Eigen::MatrixXd pressed = response.voltages_V(load_on(array, 0, TopLoad::kPressure));
  // Axisymmetric p-elements on a film of 150 um radius: -2.401641 and -1.923994 mV per kPa.
  CHECK(pressed(0, kCentre) == Approx(-2.401641e-3).epsilon(1e-4));
  CHECK(pressed(0, kMean) == Approx(-1.923994e-3).epsilon(1e-4));
  // The same for a quadrant under shear: 7.54984 +- 0.007 mV.
  const Eigen::MatrixXd sheared = response.voltages_V(load_on(array, 0, TopLoad::kShearX));
  CHECK(sheared(0, kFirstQuadrant) == Approx(-7.5500e-3).epsilon(2e-4));
}

TEST_CASE("a uniaxial film reads the pillar with all its harmonics", "[models]") {
  const SpaceArray array = square_array(1, 60e-6, film_of_the_thesis());
  const SpaceResponse response(array, space_accuracies(array).back());
  const auto read = [&](TopLoad load, int reading) {
    return response.voltages_V(load_on(array, 0, load))(0, reading);
  };
  // Fourier p-elements of another program; a 3-D finite-element solution of 141 000 unknowns (dolfinx)
  // has -2.40433 and -1.92189 mV.
  CHECK(read(TopLoad::kPressure, kCentre) == Approx(-2.40475e-3).epsilon(5e-5));
  CHECK(read(TopLoad::kPressure, kMean) == Approx(-1.92665e-3).epsilon(5e-5));
  CHECK(read(TopLoad::kShearX, kFirstQuadrant) == Approx(-7.78507e-3).epsilon(1e-4));
  CHECK(read(TopLoad::kShearY, kFirstQuadrant) == Approx(-7.32744e-3).epsilon(1e-4));
  CHECK(read(TopLoad::kTiltX, kFirstQuadrant) == Approx(0.32483e-3).epsilon(5e-4));
  CHECK(read(TopLoad::kTiltY, kFirstQuadrant) == Approx(0.29691e-3).epsilon(5e-4));
}

TEST_CASE("neighbours on a uniaxial film read what other codes read", "[models]") {
  // Per cent of the loaded pillar's own mean (centre) reading: along the stretch, across, diagonal, then
  // the second along and across, and the change of the middle one if all are loaded (endless array).
  struct Row {
    double spacing_m;
    double mean[5], centre[3], all_mean, all_centre;
  };
  const std::vector<Row> rows = {
      {20e-6, {1.7123, 4.1772, 0.1753, -0.1671, 0.0351}, {0.6189, 2.5884, 0.0671}, 11.580, 5.960},
      {40e-6,
       {-0.1790, 0.8683, -0.0686, -0.0435, -0.0036},
       {-0.2385, 0.5674, -0.0617},
       0.890,
       0.249},
      {60e-6,
       {-0.2633, 0.1928, -0.0423, -0.0096, -0.0016},
       {-0.2239, 0.1255, -0.0334},
       -0.354,
       -0.361},
      {100e-6,
       {-0.0885, 0.0012, -0.0061, -0.0004, -0.0001},
       {-0.0685, -0.0007, -0.0046},
       -0.201,
       -0.156},
  };
  constexpr int kSide = 9;
  constexpr int kMiddle = 40;
  constexpr double kOfOwn = 0.02;  // 2e-4 of the own reading, in per cent
  for (const Row& row : rows) {
    const SpaceArray array = square_array(kSide, row.spacing_m, film_of_the_thesis());
    const SpaceResponse response(array, space_accuracies(array)[3]);
    const Eigen::MatrixXd one = response.voltages_V(load_on(array, kMiddle, TopLoad::kPressure));
    const auto percent = [&](int pillar, int reading) {
      return 100.0 * one(pillar, reading) / one(kMiddle, reading);
    };
    INFO("spacing " << row.spacing_m);
    const int at[5] = {kMiddle + 1, kMiddle + kSide, kMiddle + kSide + 1, kMiddle + 2,
                       kMiddle + 2 * kSide};
    for (int i = 0; i < 5; ++i) CHECK(percent(at[i], kMean) == Approx(row.mean[i]).margin(kOfOwn));
    for (int i = 0; i < 3; ++i) {
      CHECK(percent(at[i], kCentre) == Approx(row.centre[i]).margin(kOfOwn));
    }
    TopLoads all = TopLoads::Zero(kSide * kSide, kTopLoads);
    all.col(0).setConstant(1e3);
    const Eigen::MatrixXd every = response.voltages_V(all);
    const auto change = [&](int reading) {
      return 100.0 * (every(kMiddle, reading) / one(kMiddle, reading) - 1.0);
    };
    CHECK(change(kMean) == Approx(row.all_mean).margin(kOfOwn));
    CHECK(change(kCentre) == Approx(row.all_centre).margin(kOfOwn));
  }
}

TEST_CASE("a symmetric array answers symmetrically", "[models]") {
  const SpaceArray array = square_array(3, 20e-6, film_of_the_thesis());
  const SpaceResponse response(array, space_accuracies(array)[1]);
  TopLoads loads = TopLoads::Zero(9, kTopLoads);
  loads.col(0).setConstant(1e3);
  const Eigen::MatrixXd V = response.voltages_V(loads);
  const double size = V.cwiseAbs().maxCoeff();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      const int here = 3 * row + column;
      CHECK(V(here, kMean) == Approx(V(3 * row + 2 - column, kMean)).margin(1e-12 * size));
      CHECK(V(here, kMean) == Approx(V(3 * (2 - row) + column, kMean)).margin(1e-12 * size));
      // Quadrant 1 (+,+) is the mirror image of 2 (-,+) at the mirrored pillar.
      CHECK(V(here, 2) == Approx(V(3 * row + 2 - column, 3)).margin(1e-12 * size));
      CHECK(V(here, 2) == Approx(V(3 * (2 - row) + column, 5)).margin(1e-12 * size));
    }
  }
}

TEST_CASE("on a film without direction an array may be turned", "[models]") {
  // Neighbours at the same distance read the same in all directions, loads turn with the readings.
  SpaceArray array = square_array(1, 60e-6, film_of_the_thesis(12.5e-12, 12.5e-12));
  constexpr double kDistance_m = 70e-6;
  array.pillars.push_back({kDistance_m, 0.0, 0});
  array.pillars.push_back({kDistance_m * std::cos(2.0), kDistance_m * std::sin(2.0), 0});
  const SpaceResponse response(array, space_accuracies(array)[2]);
  const Eigen::MatrixXd V = response.voltages_V(load_on(array, 0, TopLoad::kPressure));
  CHECK(V(1, kMean) == Approx(V(2, kMean)).epsilon(1e-9));
  TopLoads along = TopLoads::Zero(3, kTopLoads);
  along(0, 1) = 1e3 * std::cos(2.0);
  along(0, 2) = 1e3 * std::sin(2.0);
  const Eigen::MatrixXd turned = response.voltages_V(along);
  const Eigen::MatrixXd straight = response.voltages_V(load_on(array, 0, TopLoad::kShearX));
  CHECK(turned(2, kMean) == Approx(straight(1, kMean)).epsilon(1e-9));
}

TEST_CASE("the quarters of a disc have the mean of the disc", "[models]") {
  const SpaceArray array = square_array(2, 30e-6, film_of_the_thesis());
  const SpaceResponse response(array, space_accuracies(array)[3]);
  TopLoads loads = TopLoads::Zero(4, kTopLoads);
  loads.row(0) << 1e3, 300.0, -200.0, 500.0, 100.0;
  const Eigen::MatrixXd V = response.voltages_V(loads);
  const double size = V.cwiseAbs().maxCoeff();
  for (int pillar = 0; pillar < 4; ++pillar) {
    CHECK(V.row(pillar).segment(kFirstQuadrant, 4).mean() ==
          Approx(V(pillar, kMean)).margin(1e-6 * size));
  }
}

TEST_CASE("each level of accuracy comes closer to the finest", "[models][convergence]") {
  const SpaceArray array = square_array(2, 20e-6, film_of_the_thesis());
  TopLoads loads = TopLoads::Zero(4, kTopLoads);
  loads.row(0) << 1e3, 200.0, 0.0, 0.0, 0.0;
  const std::vector<SpaceAccuracy> levels = space_accuracies(array);
  const Eigen::MatrixXd finest = SpaceResponse(array, levels.back()).voltages_V(loads);
  double last = 1.0;
  for (const std::size_t level : {0U, 1U, 3U, 5U}) {
    const Eigen::MatrixXd V = SpaceResponse(array, levels[level]).voltages_V(loads);
    const double error = (V - finest).cwiseAbs().maxCoeff() / finest.cwiseAbs().maxCoeff();
    CHECK(error < 0.3 * last);
    last = error;
  }
  CHECK(last < 1e-5);
}

TEST_CASE("classes of pillars carry their own feet", "[models]") {
  SpaceArray array = square_array(2, 60e-6, film_of_the_thesis());
  PillarGeometry shorter;
  shorter.length_m = 60e-6;
  array.classes.push_back({shorter, isotropic_medium(1.8e6, 0.33, 965.0)});
  array.pillars[1].of_class = 1;
  const SpaceResponse response(array, space_accuracies(array)[1]);
  // Sideways the foot feels the moment, which grows with the length.
  const double tall = response.voltages_V(load_on(array, 0, TopLoad::kShearX))(0, kFirstQuadrant);
  const double low = response.voltages_V(load_on(array, 1, TopLoad::kShearX))(1, kFirstQuadrant);
  CHECK(std::abs(low) < 0.7 * std::abs(tall));
  CHECK(std::abs(low) > 0.3 * std::abs(tall));
}

TEST_CASE("arrays that overlap are refused with the pillars at fault", "[models]") {
  CHECK_THROWS_WITH(validate(square_array(2, 3e-6, film_of_the_thesis())),
                    Catch::Contains("gap between pillars 1 and 2") && Catch::Contains("3 um"));
  SpaceArray wide = square_array(2, 20e-6, film_of_the_thesis());
  wide.electrode_radius_m = 31e-6;
  CHECK_THROWS_WITH(validate(wide), Catch::Contains("electrodes of pillars 1 and 2 overlap"));
  CHECK_THROWS_WITH(validate(SpaceArray{}), Catch::Contains("no pillars"));
  CHECK_NOTHROW(validate(square_array(2, 5e-6, film_of_the_thesis())));
}

TEST_CASE("pillars of an endless lattice pass waves as an independent program finds", "[models]") {
  // Fourier p-elements of another program: mean voltage per mean pressure and thickness 0.61110 V m/N for long
  // waves, 1.01410 of it at 200 um besides sinc(pi/2); 29.20 mV per um of a top, of which the mean over a
  // top leaves 0.95146 at 200 um and all pillars together 1 - 0.00354 for long waves.
  SpaceScene scene;
  scene.rows = scene.columns = 3;
  scene.pillars = lattice_places(SpaceLattice::kSquare, 3, 3, 100e-6);
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = 0.33;
  scene.pillar.rho_kg_m3 = 965.0;
  scene.film = test::pvdf_of_the_thesis();
  scene.wanted = {"voltage_per_pressure", "voltage_per_height"};
  const SpaceArray array = array_of(scene);
  SceneAnswer answer;
  add_transfer(scene, SpaceResponse(array, space_accuracies(array)[3]),
               space_accuracies(array)[3].potential.reach_m, answer);
  REQUIRE(answer.curves.size() == 2);
  const SceneCurve& pressure = answer.curves[0];
  const SceneCurve& height = answer.curves[1];
  CHECK(pressure.x.front() == Approx(200e-6).epsilon(1e-12));
  const double long_waves = 0.61110 * 25e-6;
  CHECK(std::abs(pressure.value.back()) == Approx(long_waves).epsilon(1e-3));
  CHECK(std::abs(pressure.value.front()) == Approx(1.01410 * 0.63662 * long_waves).epsilon(2e-4));
  const double per_height_V_m = 29.20e3 * (1.0 - 0.00354);
  CHECK(std::abs(height.value.back()) == Approx(per_height_V_m).epsilon(1e-3));
  CHECK(std::abs(height.value.front()) == Approx(1.01410 * 0.95146 * per_height_V_m).epsilon(5e-4));
}

// Fourier p-elements of another program, by Poisson's sum over the reciprocal lattice: what all pillars of an endless
// lattice read of waves of 200 um, over the same sum for long waves.
TEST_CASE("short waves along and across the stretch read as an independent program finds",
          "[models]") {
  constexpr double kPitch_m = 100e-6;
  constexpr int kReach = 5;
  SpaceArray array = square_array(2 * kReach + 1, 60e-6, film_of_the_thesis());
  const SpaceResponse response(array, space_accuracies(array)[3]);
  std::array<double, 2> all{}, along{}, across{};
  for (int i = -kReach; i <= kReach; ++i) {
    for (int j = -kReach; j <= kReach; ++j) {
      const auto V_Pa = response.kernel(0, i * kPitch_m, j * kPitch_m);
      for (const std::size_t reading : {0U, 1U}) {
        const double one = V_Pa(static_cast<int>(reading), 0);
        all[reading] += one;
        along[reading] += i % 2 == 0 ? one : -one;
        across[reading] += j % 2 == 0 ? one : -one;
      }
    }
  }
  // Per pressure over the lattice and thickness: P^2/A of what a pillar reads.
  const double of_lattice = kPitch_m * kPitch_m / (std::numbers::pi * 400e-12) / 25e-6;
  CHECK(-all[0] * of_lattice == Approx(0.76268).epsilon(1e-4));
  CHECK(-all[1] * of_lattice == Approx(0.61110).epsilon(1e-4));
  CHECK(along[0] / all[0] == Approx(1.01178).margin(2e-4));
  CHECK(along[1] / all[1] == Approx(1.01410).margin(2e-4));
  CHECK(across[0] / all[0] == Approx(0.99786).margin(2e-4));
  CHECK(across[1] / all[1] == Approx(0.99593).margin(2e-4));
}

}  // namespace
}  // namespace viscard
