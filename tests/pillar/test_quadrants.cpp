#include "models/pillar/piezo_quadrants.h"
#include "models/pillar/pillar_loads.h"
#include "models/pillar/plan.h"
#include "models/pillar/scene.h"
#include "tests/pillar/answer_of.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <string>

using namespace viscard;
using namespace viscard::test;

namespace {

constexpr double kPi = std::numbers::pi;

// Charge constants of a film poled along z, isotropic otherwise; no d15.
Medium film_medium() {
  PiezoMatrix charge = PiezoMatrix::Zero();
  charge(2, 0) = charge(2, 1) = 23e-12;
  charge(2, 2) = -33e-12;
  return piezo_medium(isotropic_medium(2e9, .29, 1780.0).stiffness_Pa, charge,
                      12.0 * kVacuumPermittivity_F_m * Eigen::Matrix3d::Identity(), 1780.0);
}

// A pillar without contraction on a film so thin that each spot of it feels the stress above it
// alone.
struct OnThinFilm {
  OnThinFilm(double length_m, Motion motion, double electrode_m)
      : model({.diameter_m = 40e-6,
               .length_m = length_m,
               .film = FilmGeometry{.thickness_m = 40e-9, .radius_m = 40e-6}},
              {.degree = 5, .layers = 4}, {isotropic_medium(1.8e6, 0.0, 965.0), film_medium()},
              {.motion = motion,
               .electrodes = ElectrodeOptions{FilmFace::kBottom, electrode_m, true}}) {}
  PillarModel model;
};

Scene sideways_scene() {
  Scene scene;
  scene.geometry.film = FilmGeometry{.thickness_m = 25e-6, .radius_m = 60e-6};
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = .33;
  scene.film = film_medium();
  scene.electrodes = ElectrodeOptions{FilmFace::kBottom, 20e-6, true};
  scene.kind = AnalysisKind::kStatic;
  scene.direction = LoadDirection::kLateral;
  scene.pressure_Pa = 1e3;
  scene.tolerance = 1e-3;
  return scene;
}

}  // namespace

// Under a force F at the end of a beam the stress at its foot is -4 F L x/(pi R^4); what lies
// beside that, from shear next to the clamped foot, does not depend on L, so it drops out of a
// difference. A quadrant then collects int_0^R int_0^(pi/2) of it: 4 F L/(3 pi R) times what a film
// gives per stress, which the same film under pressure tells.
TEST_CASE("quadrants of a thin film collect the bending stress of a beam", "[pillar]") {
  const double R = 20e-6;
  const double force_N = 1e-6;
  const OnThinFilm shorter(120e-6, Motion::kLateral, R);
  const OnThinFilm longer(200e-6, Motion::kLateral, R);
  const double more_C = piezo_quadrants(longer.model, force_N).charge_C -
                        piezo_quadrants(shorter.model, force_N).charge_C;
  const OnThinFilm pressed(120e-6, Motion::kLongitudinal, R);
  const double per_stress = piezo_static(pressed.model, 1.0).charge_C / (kPi * R * R);
  const double expected_C = per_stress * 4.0 * force_N * 80e-6 / (3.0 * kPi * R);
  CHECK(more_C == Approx(expected_C).epsilon(5e-3));  // t/R = 2e-3 spreads at the rim
}

TEST_CASE("mean voltages of quadrants of a thin film are those of a beam", "[pillar]") {
  const double R = 20e-6;
  const double force_N = 1e-6;
  const auto voltage_of = [&](double length_m) {
    const OnThinFilm of(length_m, Motion::kLateral, 0.0);
    const Eigen::VectorXd push = unit_top_force(of.model);
    return quadrant_mean_V(of.model, of.model.solve(force_N * push), 0.0, R);
  };
  const OnThinFilm pressed(120e-6, Motion::kLongitudinal, 0.0);
  const PillarState state = piezo_sampled(pressed.model, 1.0);
  const double per_stress = mean_potential_V(pressed.model, state, 0.0, R);
  const double expected_V = per_stress * 16.0 * force_N * 80e-6 / (3.0 * kPi * kPi * R * R * R);
  CHECK(voltage_of(200e-6) - voltage_of(120e-6) == Approx(expected_V).epsilon(5e-3));
}

// The work of a force on what a voltage moves is that of the voltage on the charge the force
// drives: F u = V (q1 + q4 - q2 - q3) = 4 V q1.
TEST_CASE("quadrants sense and drive reciprocally", "[pillar]") {
  Scene scene = sideways_scene();
  const SceneAnswer sensed = simulate(scene);
  const double force_N = scene.pressure_Pa * kPi * 20e-6 * 20e-6;
  scene.pressure_Pa = 0.0;
  scene.drive_V = 10.0;
  const SceneAnswer driven = simulate(scene);
  CHECK(force_N * value_of(driven, "top_displacement") ==
        Approx(4.0 * 10.0 * value_of(sensed, "quadrant_charge")).epsilon(2e-3));
  CHECK(value_of(driven, "top_displacement") !=
        Approx(value_of(sensed, "top_displacement")).epsilon(0.5));
}

// Timoshenko's cantilever, P L^3/(3 E I) + P L/(kappa G A), kappa by Cowper: the clamped foot of a
// solid is stiffer by what it may not contract.
TEST_CASE("a sideways push bends the pillar as a beam", "[pillar]") {
  Scene scene = sideways_scene();
  scene.geometry.film.reset();
  scene.film.reset();
  scene.electrodes.reset();
  scene.geometry.length_m = 1200e-6;
  const double A = kPi * 4e-10;
  const double I = kPi * std::pow(20e-6, 4) / 4.0;
  const double P = scene.pressure_Pa * A;
  const double L = scene.geometry.length_m;
  const double kappa = 6.0 * 1.33 / (7.0 + 6.0 * 0.33);
  const double beam_m =
      P * L * L * L / (3.0 * 1.8e6 * I) + P * L / (kappa * 1.8e6 / (2.0 * 1.33) * A);
  CHECK(value_of(simulate(scene), "top_displacement") == Approx(beam_m).epsilon(3e-3));
}

TEST_CASE("what quadrants cannot read is refused", "[pillar]") {
  Scene scene = sideways_scene();
  scene.electrodes->quadrants = false;
  CHECK_THROWS_WITH(simulate(scene), Catch::Contains("quadrants = true"));
  scene = sideways_scene();
  scene.plane = PlaneState::kStress;
  CHECK_THROWS_WITH(simulate(scene), Catch::Contains("sampled"));
}

TEST_CASE("a film left out under a sideways push is within the error told", "[pillar]") {
  Scene scene = sideways_scene();
  scene.electrodes.reset();
  scene.geometry.length_m = 60e-6;
  scene.film = isotropic_medium(40e6, .4, 965.0);  // soft enough to matter: 1.8 %
  const double with_film_m = value_of(simulate_planned(scene), "top_displacement");
  scene.effects["film_compliance"] = EffectChoice::kOff;
  const SceneAnswer without = simulate_planned(scene);
  const double missed_m = std::abs(value_of(without, "top_displacement") - with_film_m);
  CHECK(missed_m > 0.01 * with_film_m);
  CHECK(missed_m <= without.results[0].error_estimate);
}
