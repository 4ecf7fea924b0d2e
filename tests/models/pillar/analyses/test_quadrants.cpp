#include "models/pillar/analyses/simulate_pillar.h"
#include "models/pillar/body/piezo_static.h"
#include "models/pillar/body/pillar_model.h"
#include "models/pillar/scene/pillar_scene.h"
#include "models/scene/simulate.h"
#include "tests/models/pillar/analyses/answer_of.h"
#include "tests/models/pillar/drive_as.h"

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

constexpr double kShear_Pa = 1e3;

PillarScene sideways_scene() {
  PillarScene scene;
  scene.geometry.film = FilmGeometry{.thickness_m = 25e-6, .radius_m = 60e-6};
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = .33;
  scene.film = film_medium();
  scene.electrodes = ElectrodeOptions{FilmFace::kBottom, 20e-6, true};
  scene.drive = StaticDrive{.direction = LoadDirection::kLateral, .pressure_Pa = kShear_Pa};
  scene.tolerance = 1e-3;
  return scene;
}

}  // namespace

// Under a force F at the end of a beam the stress at its foot is -4 F L x/(pi R^4); what lies
// beside that, from shear next to the clamped foot, does not depend on L, so it drops out of a
// difference. A quadrant then collects int_0^R int_0^(pi/2) of it: 4 F L/(3 pi R) times what a film
// gives per stress, known from the same film under pressure.
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
  PillarScene scene = sideways_scene();
  const SceneAnswer sensed = simulate_pillar(scene);
  const double force_N = kShear_Pa * kPi * 20e-6 * 20e-6;
  scene.drive = StaticDrive{.direction = LoadDirection::kLateral, .drive_V = 10.0};
  const SceneAnswer driven = simulate_pillar(scene);
  CHECK(force_N * value_of(driven, "top_displacement") ==
        Approx(4.0 * 10.0 * value_of(sensed, "quadrant_charge")).epsilon(2e-3));
  CHECK(value_of(driven, "top_displacement") !=
        Approx(value_of(sensed, "top_displacement")).epsilon(0.5));
}

// Timoshenko's cantilever, P L^3/(3 E I) + P L/(kappa G A), kappa by Cowper: the clamped foot of a
// solid is stiffer because it cannot contract.
TEST_CASE("a sideways push bends the pillar as a beam", "[pillar]") {
  PillarScene scene = sideways_scene();
  scene.geometry.film.reset();
  scene.film.reset();
  scene.electrodes.reset();
  scene.geometry.length_m = 1200e-6;
  const double A = kPi * 4e-10;
  const double I = kPi * std::pow(20e-6, 4) / 4.0;
  const double P = kShear_Pa * A;
  const double L = scene.geometry.length_m;
  const double kappa = 6.0 * 1.33 / (7.0 + 6.0 * 0.33);
  const double beam_m =
      P * L * L * L / (3.0 * 1.8e6 * I) + P * L / (kappa * 1.8e6 / (2.0 * 1.33) * A);
  CHECK(value_of(simulate_pillar(scene), "top_displacement") == Approx(beam_m).epsilon(3e-3));
}

TEST_CASE("results that quadrants cannot read are refused", "[pillar]") {
  PillarScene scene = sideways_scene();
  scene.electrodes->quadrants = false;
  CHECK_THROWS_WITH(simulate_pillar(scene), Catch::Contains("quadrants = true"));
  scene = sideways_scene();
  scene.plane = PlaneState::kStress;
  CHECK_THROWS_WITH(simulate_pillar(scene), Catch::Contains("sampled"));
}

TEST_CASE("a film left out under a sideways push stays within the reported error", "[pillar]") {
  PillarScene scene = sideways_scene();
  scene.electrodes.reset();
  scene.geometry.length_m = 60e-6;
  scene.film = isotropic_medium(40e6, .4, 965.0);  // soft enough to matter: 1.8 %
  const double with_film_m = value_of(simulate(scene), "top_displacement");
  scene.effects["film_compliance"] = EffectChoice::kOff;
  const SceneAnswer without = simulate(scene);
  const double missed_m = std::abs(value_of(without, "top_displacement") - with_film_m);
  CHECK(missed_m > 0.01 * with_film_m);
  CHECK(missed_m <= without.results[0].error_estimate);
}

namespace {

// Far below the first resonance (16 kHz) the answer is in phase with the load. One mesh for all
// analyses, so that the mesh does not differ.
PillarScene slow_scene(bool is_sampled) {
  PillarScene scene = sideways_scene();
  scene.pillar.rho_kg_m3 = 965.0;
  if (is_sampled) scene.electrodes->electrode_radius_m = 0.0;
  scene.discretisation = Discretisation{.degree = 4, .layers = 2};
  scene.tolerance = 0.1;
  scene.drive = HarmonicDrive{
      .direction = LoadDirection::kLateral, .pressure_Pa = kShear_Pa, .frequencies_Hz = {1.0}};
  return scene;
}

PillarScene at_rest(PillarScene scene) {
  scene.drive = StaticDrive{.direction = LoadDirection::kLateral, .pressure_Pa = kShear_Pa};
  return scene;
}

}  // namespace

TEST_CASE("quadrants read a slow sideways load as they read a static one", "[pillar]") {
  const bool is_sampled = GENERATE(false, true);
  const std::string name = is_sampled ? "quadrant_voltage" : "quadrant_charge";
  PillarScene scene = slow_scene(is_sampled);
  const SceneAnswer slow = simulate_pillar(scene);
  const double resting = value_of(simulate_pillar(at_rest(scene)), name);
  // (1 Hz/16 kHz)^2 = 4e-9 apart.
  CHECK(curve_of(slow, name + "_real").value[0] == Approx(resting).epsilon(1e-7));
  CHECK(std::abs(curve_of(slow, name + "_imaginary").value[0]) < 1e-9 * std::abs(resting));
  scene.drive = TransientDrive{.direction = LoadDirection::kLateral,
                               .history = {{0.0, 0.0}, {2e-3, kShear_Pa}},
                               .end_time_s = 2e-3};
  // A ramp of t leaves ringing of 1/(pi f t) = 1 %.
  CHECK(value_of(simulate_pillar(scene), name + "_end") == Approx(resting).epsilon(0.015));
}

// A shaken beam bends at its foot by rho A a L^2/2, as a force F at its end does by F L; what lies
// beside that, from shear next to the foot, goes with the shear force, rho A a L or F.
TEST_CASE("quadrants on a shaken base read the pillar's inertia", "[pillar]") {
  const double a_m_s2 = 10.0;
  const auto shaken_C = [&](double length_m) {
    PillarScene scene = slow_scene(false);
    scene.geometry.length_m = length_m;
    scene.drive = HarmonicDrive{.load_place = LoadPlace::kBase,
                                .direction = LoadDirection::kLateral,
                                .base_acceleration_m_s2 = a_m_s2,
                                .frequencies_Hz = {1.0}};
    return curve_of(simulate_pillar(scene), "quadrant_charge_real").value[0];
  };
  const auto pushed_C_N = [&](double length_m) {
    PillarScene scene = at_rest(slow_scene(false));
    scene.geometry.length_m = length_m;
    return value_of(simulate_pillar(scene), "quadrant_charge") / (kShear_Pa * kPi * 4e-10);
  };
  const double L = 120e-6, longer = 240e-6;
  const double by_moment = (pushed_C_N(longer) - pushed_C_N(L)) / (longer - L);  // C per N m
  const double by_shear = pushed_C_N(L) - L * by_moment;                         // C per N
  const double mass_1_m = 965.0 * kPi * 4e-10;
  const auto expected_C = [&](double l) {  // the base to the right pushes the pillar to the left
    return -mass_1_m * a_m_s2 * (0.5 * l * l * by_moment + l * by_shear);
  };
  // The film's own inertia, 4e-2 of the pillar's moment, does not depend on the pillar's length.
  CHECK(shaken_C(longer) - shaken_C(L) == Approx(expected_C(longer) - expected_C(L)).epsilon(5e-3));
}

TEST_CASE("a charge amplifier reads a quadrant", "[pillar]") {
  PillarScene scene = slow_scene(false);
  scene.readout = Readout{ReadoutKind::kCharge, 1e10, 1e-12};  // 10 ms: a corner at 16 Hz
  test::as<HarmonicDrive>(scene).frequencies_Hz = {1.0, 1000.0};
  const SceneAnswer answer = simulate_pillar(scene);
  const double charge_C = curve_of(answer, "quadrant_charge_real").value[0];
  const double x = 2.0 * kPi * 0.01;  // omega T at 1 Hz
  CHECK(curve_of(answer, "reading_imaginary").value[0] ==
        Approx(-charge_C / 1e-12 * x / (1.0 + x * x)).epsilon(1e-9));
  CHECK(curve_of(answer, "reading_magnitude").value[1] ==
        Approx(curve_of(answer, "quadrant_charge_magnitude").value[1] / 1e-12).epsilon(2e-4));
  CHECK(value_of(answer, "readout_time_constant") == Approx(0.01).epsilon(1e-12));
  scene.readout->kind = ReadoutKind::kVoltage;
  CHECK_THROWS_WITH(simulate_pillar(scene), Catch::Contains("between touching quadrants"));
  scene.readout->kind = ReadoutKind::kCharge;
  scene.electrodes->quadrants = false;
  CHECK_THROWS_WITH(simulate_pillar(scene), Catch::Contains("quadrants = true"));
}
