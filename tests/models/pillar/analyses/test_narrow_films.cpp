// Films that end near the pillar or their electrode: the corner at the bottom of the film's rim is
// singular too, and so is the edge of an electrode that lies on a line of the mesh.
#include "models/pillar/analyses/simulate_pillar.h"
#include "models/pillar/mesh/film_mesh.h"
#include "models/pillar/mesh/pillar_mesh.h"
#include "tests/models/pillar/analyses/answer_of.h"
#include "tests/models/pillar/drive_as.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <string>
#include <vector>

using namespace viscard;

namespace {

// A pillar of 50 x 50 um under 1 kPa.
PillarScene on_film(const FilmGeometry& film, double electrode_radius_m) {
  PillarScene scene;
  scene.geometry.diameter_m = scene.geometry.length_m = 50e-6;
  scene.geometry.film = film;
  scene.pillar.E0_Pa = 3e6;
  scene.pillar.nu = 0.4;
  test::as<StaticDrive>(scene).pressure_Pa = 1e3;
  PiezoMatrix d = PiezoMatrix::Zero();
  d(2, 0) = d(2, 1) = 20e-12;
  d(2, 2) = -32e-12;
  const Eigen::Vector3d permittivity = kVacuumPermittivity_F_m * Eigen::Vector3d(9.0, 9.0, 11.0);
  scene.film = piezo_medium(isotropic_moduli_Pa(3e9, 0.35), d, permittivity.asDiagonal(), 1780.0);
  scene.electrodes = ElectrodeOptions{FilmFace::kBottom, electrode_radius_m};
  return scene;
}

// From a separate p-FEM program in Python (numpy, SciPy's SuperLU; tensor products in r and z, two-way
// coupled), degree 9 with six layers of ratio 0.15 toward every corner; degree 7 with five agrees
// to 3e-6. FreeFEM (P2 triangles that shrink toward the corners, 169 000 unknowns) finds
// 1.42569062 mV and 37.2400613 fF for the first.
struct NarrowFilm {
  double thickness_um, radius_um, electrode_um;
  double voltage_V, charge_C, capacitance_F, displacement_m;
};
const std::vector<NarrowFilm> kFilms = {
    {5.0, 25.0, 25.0, 1.425690637e-3, -5.30928068e-17, 3.72400614e-14, -1.58675623e-8},
    {20.0, 32.0, 25.0, 4.010271131e-3, -5.44652835e-17, 1.35814467e-14, -1.58701263e-8},
    {20.0, 32.0, 15.0, 4.297288071e-3, -3.17745128e-17, 7.39408488e-15, -1.58701252e-8},
    {20.0, 50.0, 50.0, 1.024767775e-3, -3.85289174e-17, 3.75977058e-14, -1.58691545e-8},
    // The edge lies where the layers toward the pillar end.
    {20.0, 100.0, 50.0, 5.319170714e-4, -2.65606164e-17, 4.99337544e-14, -1.58690516e-8}};

}  // namespace

TEST_CASE("answers on narrow films lie within their error estimates", "[pillar][convergence]") {
  const NarrowFilm film = GENERATE(Catch::Generators::from_range(kFilms));
  PillarScene scene =
      on_film({1e-6 * film.thickness_um, 1e-6 * film.radius_um}, 1e-6 * film.electrode_um);
  scene.tolerance = GENERATE(1e-2, 2e-4);
  CAPTURE(film.thickness_um, film.radius_um, film.electrode_um, scene.tolerance);
  const SceneAnswer answer = simulate_pillar(scene);
  const auto check = [&](const std::string& name, double expected) {
    const SceneResult& result = test::result_of(answer, name);
    CAPTURE(name, result.value, expected);
    constexpr double kLastDigits = 2e-6;  // of the expected values
    CHECK(std::abs(result.value - expected) <=
          result.error_estimate + kLastDigits * std::abs(expected));
    CHECK(result.error_estimate <= scene.tolerance * std::abs(result.value));
  };
  check("electrode_voltage", film.voltage_V);
  check("electrode_charge", film.charge_C);
  check("electrode_capacitance", film.capacitance_F);
  check("top_displacement", film.displacement_m);
}

TEST_CASE("a film deeper than it is wide is answered", "[pillar][convergence]") {
  PillarScene scene = on_film({30e-6, 0.957e-6}, 0.55e-6);
  scene.geometry.diameter_m = 1.1e-6;
  scene.geometry.length_m = 32e-6;
  scene.pillar.E0_Pa = 2273.0;
  scene.pillar.nu = 0.33;
  test::as<StaticDrive>(scene).pressure_Pa = 0.1;
  PiezoMatrix d = PiezoMatrix::Zero();
  d(2, 0) = d(2, 1) = 2e-12;
  d(2, 2) = -3.2e-12;
  scene.film = piezo_medium(isotropic_moduli_Pa(2e10, 0.35), d,
                            9.0 * kVacuumPermittivity_F_m * Eigen::Matrix3d::Identity(), 1780.0);
  scene.tolerance = 1e-3;
  const SceneAnswer answer = simulate_pillar(scene);  // one element below the pillar left 5e-3
  const SceneResult& voltage = test::result_of(answer, "electrode_voltage");
  // The Python program at degrees 7 and 9 agrees to 4e-6.
  CHECK(std::abs(voltage.value - 3.99407e-8) <= voltage.error_estimate + 2e-13);
  CHECK(voltage.error_estimate <= 1e-3 * voltage.value);
}

TEST_CASE("radii that agree to nine digits are equal", "[pillar][mesh]") {
  PillarGeometry geometry;
  geometry.film = FilmGeometry{25e-6, 0.5 * geometry.diameter_m * (1.0 - 5e-10)};
  CHECK_NOTHROW(validate(geometry));
  CHECK(pillar_mesh(geometry, {}).section.x().element_count() == 2);
  geometry.film->radius_m *= 1.0 - 5e-9;
  CHECK_THROWS_WITH(validate(geometry), Catch::Contains("19.99999989 um"));
}

TEST_CASE("quadrants on a narrow film lie within their error estimates", "[pillar][convergence]") {
  PillarScene scene = on_film({20e-6, 32e-6}, 25e-6);
  scene.electrodes->quadrants = true;
  test::as<StaticDrive>(scene).direction = LoadDirection::kLateral;
  scene.tolerance = 1e-3;
  const SceneAnswer answer = simulate_pillar(scene);
  // Degree 12 with seven layers; without layers at the film's rim the charge was off by 1.2e-3,
  // 1.8 times the estimate.
  const SceneResult& charge = test::result_of(answer, "quadrant_charge");
  CHECK(std::abs(charge.value - -4.392183e-17) <= charge.error_estimate);
  const SceneResult& moved = test::result_of(answer, "top_displacement");
  CHECK(std::abs(moved.value - 1.334827e-07) <= moved.error_estimate);
}

TEST_CASE("a wide film gets no layers at its rim", "[pillar][mesh]") {
  const Discretisation mesh{.degree = 8, .layers = 4};
  const auto layers = [&](double thickness_m, double radius_m, double electrode_m) {
    return film_rim_layers({thickness_m, radius_m, electrode_m}, 20e-6, mesh);
  };
  CHECK(layers(5e-6, 60e-6, 20e-6) == 1);
  CHECK(layers(5e-6, 60e-6, 0.0) == 1);
  CHECK(layers(5e-6, 60e-6, 60e-6) == 4);  // the electrode ends at the rim
  CHECK(layers(25e-6, 21e-6, 20e-6) == 4);
  CHECK(layers(25e-6, 100e-6, 20e-6) == 2);
}
