#include "models/array/film/disc_charge.h"
#include "models/array/space/space_array.h"
#include "tests/models/array/space/film_of_the_thesis.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <utility>

namespace viscard {
namespace {

// Constants of the makers' manual, without direction; the electrode on top, the bottom grounded.
LayeredFilm film_of_the_manual() {
  LayeredFilm film;
  film.layers = {{test::pvdf_of_the_thesis(23e-12, 23e-12, -33e-12), 25e-6}};
  film.grounded = FilmFace::kBottom;
  return film;
}

SpaceArray pillars_with_electrodes(const LayeredFilm& film, double radius_m) {
  SpaceArray array;
  array.classes = {{PillarGeometry{}, isotropic_medium(1.8e6, 0.33, 965.0)}};
  array.film = film;
  array.electrode = SpaceElectrode::kEquipotential;
  array.electrode_radius_m = radius_m;
  array.pillars = {{0.0, 0.0, 0}};
  return array;
}

TopLoads pressed(const SpaceArray& array, double pressure_Pa) {
  TopLoads loads = TopLoads::Zero(static_cast<Eigen::Index>(array.pillars.size()), kTopLoads);
  loads(0, 0) = pressure_Pa;
  return loads;
}

// A film of a dielectric without piezoelectricity.
LayeredFilm dielectric(double permittivity_F_m, double thickness_m) {
  LayeredFilm film;
  film.layers = {{piezo_medium(isotropic_moduli_Pa(2e9, 0.29), PiezoMatrix::Zero(),
                               permittivity_F_m * Eigen::Matrix3d::Identity(), 0.0),
                  thickness_m}};
  film.grounded = FilmFace::kBottom;
  return film;
}

TEST_CASE("the capacitance of a disc lies between plate and half-space", "[models]") {
  constexpr double kPermittivity_F_m = 1e-10;
  constexpr double kRadius_m = 20e-6;
  // Nothing lies above the film, so far from the ground a disc has half of 8 eps a: 4 eps a.
  const DiscCharge far(dielectric(kPermittivity_F_m, 100.0 * kRadius_m), kRadius_m, 1, 8, 10);
  CHECK(far.capacitance_F() == Approx(4.0 * kPermittivity_F_m * kRadius_m).epsilon(1e-2));
  CHECK(far.capacitance_F() > 4.0 * kPermittivity_F_m * kRadius_m);
  // On a thin film a parallel plate, whose edge adds (t/a)(ln(a/t) + ...)/pi-like terms.
  const double t_m = 0.01 * kRadius_m;
  const DiscCharge near(dielectric(kPermittivity_F_m, t_m), kRadius_m, 1, 24, 10);
  const double plate_F = kPermittivity_F_m * std::numbers::pi * kRadius_m * kRadius_m / t_m;
  CHECK(near.capacitance_F() > plate_F);
  CHECK(near.capacitance_F() < 1.02 * plate_F);
}

TEST_CASE("the capacitance of a disc on the film agrees with axisymmetric elements", "[models]") {
  const DiscCharge charge(film_of_the_manual(), 20e-6, 1, 6, 10);
  CHECK(charge.capacitance_F() == Approx(12.2289e-15).epsilon(5e-5));
  CHECK(charge.weight(0.0) == Approx(1.0).epsilon(1e-12));
}

TEST_CASE("electrodes influence each other as charge modes of another program do", "[models]") {
  const LayeredFilm film = film_of_the_manual();
  const DiscCharge charge(film, 20e-6, 1, 6, 10);
  CHECK(mutual_influence(film, charge, 100e-6, {}) == Approx(2.57e-3).epsilon(3e-3));
  // Far away, as between the plates of a thin capacitor, hardly anything is left.
  CHECK(std::abs(mutual_influence(film, charge, 400e-6, {})) < 1e-6);
}

TEST_CASE("an open electrode under the pillar agrees with coupled elements", "[models]") {
  const SpaceArray array = pillars_with_electrodes(film_of_the_manual(), 20e-6);
  const SpaceResponse response(array, space_accuracies(array)[5]);
  // The coupled axisymmetric solver on a film of 150 um radius: 18.1983 mV at 10 kPa, within 5e-4.
  CHECK(response.voltages_V(pressed(array, 1e4))(0, 0) == Approx(18.1983e-3).epsilon(5e-4));
  CHECK(response.capacitance_F() == Approx(12.2289e-15).epsilon(5e-5));
}

TEST_CASE("waves shorter than those of the sum are added under an electrode as wide as the foot",
          "[models][convergence]") {
  // Without what lies beyond them, 7e-5 of the voltage lacks at degree 7.
  const SpaceArray array = pillars_with_electrodes(film_of_the_manual(), 20e-6);
  const std::vector<SpaceAccuracy> levels = space_accuracies(array);
  const auto read_V = [&](std::size_t level) {
    return SpaceResponse(array, levels[level]).voltages_V(pressed(array, 1e4))(0, 0);
  };
  const double finest_V = read_V(6);
  CHECK(read_V(3) == Approx(finest_V).epsilon(1e-4));
  CHECK(read_V(4) == Approx(finest_V).epsilon(1e-5));
}

TEST_CASE("open electrodes beside a pressed pillar feel the charge that its own one gained",
          "[models]") {
  // Per cent of the pressed pillar's own voltage, charge modes in Fourier space of another program.
  const std::pair<double, double> expected[] = {
      {60e-6, 1.404}, {80e-6, -0.495}, {100e-6, -0.416}, {120e-6, -0.226}, {140e-6, -0.112}};
  for (const auto& [distance_m, percent] : expected) {
    INFO("distance " << distance_m);
    SpaceArray array = pillars_with_electrodes(film_of_the_manual(), 20e-6);
    array.pillars.push_back({distance_m, 0.0, 0});
    const SpaceResponse response(array, space_accuracies(array)[2]);
    const Eigen::MatrixXd V = response.voltages_V(pressed(array, 1e4));
    CHECK(100.0 * V(1, 0) / V(0, 0) == Approx(percent).margin(0.02));
  }
}

TEST_CASE("an electrode below the film sees what coupled elements see", "[models]") {
  // Electrode below, top grounded, as in a scene of one pillar with a film of 150 um radius.
  LayeredFilm film = film_of_the_manual();
  film.grounded = FilmFace::kTop;
  for (const double radius_m : {15e-6, 20e-6, 30e-6}) {
    const SpaceArray array = pillars_with_electrodes(film, radius_m);
    const SpaceResponse coarse(array, space_accuracies(array)[2]);
    const SpaceResponse fine(array, space_accuracies(array)[5]);
    const double V = fine.voltages_V(pressed(array, 1e4))(0, 0);
    CHECK(coarse.voltages_V(pressed(array, 1e4))(0, 0) == Approx(V).epsilon(5e-4));
    CHECK(V < 0.0);
  }
}

}  // namespace
}  // namespace viscard
