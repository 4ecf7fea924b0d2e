// Static scenes that move the top by a given displacement.
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/buckling_limit.h"
#include "models/pillar/analyses/simulate_pillar.h"
#include "models/pillar/analyses/top_load.h"
#include "models/pillar/body/pillar_model.h"
#include "models/scene/simulate.h"
#include "tests/models/pillar/analyses/answer_of.h"
#include "tests/models/pillar/drive_as.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace viscard;
using viscard::test::value_of;

namespace {

constexpr double kPi = std::numbers::pi;

PillarScene moved_pillar(double displacement_m, double nu) {
  PillarScene scene;
  scene.tolerance = 1e-4;
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = nu;
  scene.pillar.rho_kg_m3 = 965.0;
  test::as<StaticDrive>(scene).displacement_m = displacement_m;
  return scene;
}

PillarScene on_piezo_film(PillarScene scene) {
  PiezoMatrix d = PiezoMatrix::Zero();
  d.row(2) << 23e-12, 23e-12, -33e-12, 0, 0, 0;
  scene.geometry.film = FilmGeometry{25e-6, 60e-6};
  scene.film = piezo_medium(isotropic_moduli_Pa(2e9, 0.29), d,
                            12.0 * kVacuumPermittivity_F_m * Eigen::Matrix3d::Identity(), 1780.0);
  scene.film_charge_C_N = d;
  scene.electrodes = ElectrodeOptions{FilmFace::kBottom, 20e-6};
  scene.discretisation = Discretisation{.degree = 6, .layers = 3};
  scene.tolerance = 0.1;  // of the mesh; the relations below hold on any
  return scene;
}

double area_m2(const PillarScene& scene) {
  return 0.25 * kPi * scene.geometry.diameter_m * scene.geometry.diameter_m;
}

}  // namespace

TEST_CASE("a pillar of Poisson ratio 0 takes the force E A u/L, evenly distributed", "[pillar]") {
  const PillarScene scene = moved_pillar(-1e-6, 0.0);
  const SceneAnswer answer = simulate_pillar(scene);
  const double stiffness_N_m = 1.8e6 * area_m2(scene) / 120e-6;
  CHECK(value_of(answer, "top_force") == Approx(-1e-6 * stiffness_N_m).epsilon(1e-11));
  CHECK(value_of(answer, "top_stiffness") == Approx(stiffness_N_m).epsilon(1e-11));
  CHECK(value_of(answer, "base_stress_at_half_radius") == Approx(-1.5e4).epsilon(1e-9));
}

TEST_CASE("a disc pressed by a frictionless plate is half of one bonded to two", "[pillar]") {
  // E_a/E of a disc bonded to two rigid plates at R/h = 2, by another finite-element program to
  // 1e-5. Its plane of symmetry is a frictionless plate: half the thickness, R/L = 4.
  const auto [nu, stiffening] =
      GENERATE(std::pair{.33, 1.27853}, std::pair{.49, 2.63372}, std::pair{.4999, 2.95147});
  PillarScene scene = moved_pillar(-1e-8, nu);
  scene.geometry = {.diameter_m = 40e-6, .length_m = 5e-6};
  scene.wanted = {"top_stiffness"};
  scene.tolerance = 1e-5;
  const SceneAnswer answer = simulate_pillar(scene);
  const double expected_N_m = stiffening * 1.8e6 * area_m2(scene) / 5e-6;
  CHECK(value_of(answer, "top_stiffness") == Approx(expected_N_m).epsilon(3e-5));
}

TEST_CASE("the force's error estimate contains what finer meshes change", "[pillar]") {
  PillarScene scene = moved_pillar(-1e-6, .4999);
  scene.wanted = {"top_force"};
  scene.tolerance = 1e-6;
  const double fine_N = value_of(simulate_pillar(scene), "top_force");
  scene.tolerance = GENERATE(1e-2, 1e-3, 1e-4);
  const SceneAnswer coarse = simulate_pillar(scene);
  const SceneResult& force = coarse.results[0];
  REQUIRE(force.name == "top_force");
  CHECK(std::abs(force.value - fine_N) <= force.error_estimate + 1e-6 * std::abs(fine_N));
  CHECK(force.error_estimate <= scene.tolerance * std::abs(force.value));
}

TEST_CASE("the work of the plate is the strain energy, and a plate is stiffer than a pressure",
          "[pillar]") {
  const PillarScene scene = moved_pillar(-1e-6, .45);
  const Discretisation mesh{.degree = 5, .layers = 2};
  SceneAnswer answer;
  answer.discretisation = mesh;
  analysis_of(scene).run(scene, answer);
  const PillarModel model = model_of(scene, Motion::kLongitudinal, mesh);
  const double force_N = value_of(answer, "top_force");
  const Eigen::VectorXd per_N = model.top_traction() / model.top_traction().sum();
  const PillarState state = model.solve(force_N * per_N);
  CHECK(per_N.dot(state.unknowns) == Approx(-1e-6).epsilon(1e-10));
  const double twice_energy_J = state.unknowns.dot(times(model.stiffness(), state.unknowns));
  CHECK(force_N * -1e-6 == Approx(twice_energy_J).epsilon(1e-9));
  // Pressure minimises the mean displacement's energy among all tops: a bound from below; the
  // confined pillar (no lateral strain anywhere) is one from above.
  PillarScene pressed = scene;
  test::as<StaticDrive>(pressed).displacement_m.reset();
  test::as<StaticDrive>(pressed).pressure_Pa = 1e4;
  const SceneAnswer soft = pillar_answer_on(pressed, mesh);
  const double soft_N_m = -1e4 * area_m2(scene) / value_of(soft, "top_displacement");
  const double confined_N_m = 1.8e6 * (1 - .45) / (1 + .45) / (1 - .9) * area_m2(scene) / 120e-6;
  CHECK(value_of(answer, "top_stiffness") > soft_N_m);
  CHECK(value_of(answer, "top_stiffness") <
        1.001 * soft_N_m);  // slender: the top has little influence
  CHECK(value_of(answer, "top_stiffness") < confined_N_m);
}

TEST_CASE("a film under a moved pillar: open, shorted and held answers are reciprocal",
          "[pillar]") {
  const PillarScene scene = on_piezo_film(moved_pillar(-1e-6, .33));
  const SceneAnswer open = simulate_pillar(scene);
  // No charge flows: the voltage returns the charge of the shorted film (top held).
  CHECK(value_of(open, "electrode_voltage") * value_of(open, "electrode_capacitance") ==
        Approx(-value_of(open, "electrode_charge")).epsilon(1e-8));
  // Held by the plate and driven by the open voltage: no charge, the force of the open film less.
  PillarScene driven = scene;
  test::as<StaticDrive>(driven).drive_V = value_of(open, "electrode_voltage");
  const SceneAnswer at_open = simulate_pillar(driven);
  CHECK(value_of(at_open, "top_force") == Approx(value_of(open, "top_force")).epsilon(1e-8));
  CHECK(std::abs(value_of(at_open, "electrode_charge")) <
        1e-8 * std::abs(value_of(open, "electrode_charge")));
  // Blocked: 1 V on a pillar held at its length; force per volt = charge per displacement.
  test::as<StaticDrive>(driven).displacement_m = 0.0;
  test::as<StaticDrive>(driven).drive_V = 1.0;
  CHECK(value_of(simulate_pillar(driven), "top_force") ==
        Approx(-value_of(open, "electrode_charge") / -1e-6).epsilon(1e-7));
}

TEST_CASE("a pillar on its film moves nearly as far under the pressure of the same force",
          "[pillar]") {
  const PillarScene scene = on_piezo_film(moved_pillar(-1e-6, .33));
  const SceneAnswer moved = simulate_pillar(scene);
  PillarScene pressed = scene;
  test::as<StaticDrive>(pressed).displacement_m.reset();
  test::as<StaticDrive>(pressed).pressure_Pa = -value_of(moved, "top_force") / area_m2(scene);
  const SceneAnswer by_pressure = simulate_pillar(pressed);
  // The plate's uneven pressure is felt a diameter deep, far above the film: 1e-4 is left of it.
  CHECK(value_of(by_pressure, "electrode_voltage") ==
        Approx(value_of(moved, "electrode_voltage")).epsilon(1e-4));
  CHECK(value_of(by_pressure, "top_displacement") == Approx(-1e-6).epsilon(1e-3));
  // One way coupled the voltage is off by no more than the film's k^2.
  PillarScene one_way = scene;
  one_way.one_way_potential = true;
  CHECK(value_of(simulate_pillar(one_way), "electrode_voltage") ==
        Approx(value_of(moved, "electrode_voltage")).epsilon(0.05));
}

TEST_CASE("a top moved sideways takes the shear that causes the same displacement", "[pillar]") {
  PillarScene moved = moved_pillar(1e-6, .33);
  test::as<StaticDrive>(moved).direction = LoadDirection::kLateral;
  if (GENERATE(false, true)) {
    moved = on_piezo_film(moved);
    moved.electrodes->quadrants = true;
  }
  moved.discretisation = Discretisation{.degree = 6, .layers = 3};
  moved.tolerance = 0.1;
  const SceneAnswer answer = simulate_pillar(moved);
  const double force_N = value_of(answer, "top_force");
  // 3 E I/L^3, less by shear and the foot: within 7 % at L = 3 d.
  const double beam_N = 3.0 * 1.8e6 * kPi / 64.0 * std::pow(40e-6, 4) / std::pow(120e-6, 3) * 1e-6;
  CHECK(force_N < beam_N);
  CHECK(force_N > 0.9 * beam_N);
  CHECK(value_of(answer, "top_stiffness") == Approx(force_N / 1e-6).epsilon(1e-12));
  PillarScene pushed = moved;
  test::as<StaticDrive>(pushed).displacement_m.reset();
  test::as<StaticDrive>(pushed).pressure_Pa = force_N / area_m2(moved);
  CHECK(value_of(simulate_pillar(pushed), "top_displacement") == Approx(1e-6).epsilon(1e-9));
}

TEST_CASE("a strip takes E b u/L per metre, and a film left out changes force within its budget",
          "[pillar][plan]") {
  PillarScene strip = moved_pillar(-1e-6, 0.0);
  strip.plane = PlaneState::kStress;
  CHECK(value_of(simulate_pillar(strip), "top_force") ==
        Approx(-1.8e6 * 40e-6 / 120.0).epsilon(1e-11));
  PillarScene scene = moved_pillar(-1e-6, .33);
  scene.tolerance = 1e-2;
  scene.geometry.film = FilmGeometry{25e-6, 60e-6};
  scene.film = isotropic_medium(2e9, 0.29, 1780.0);
  scene.wanted = {"top_force", "base_stress_at_half_radius"};
  const SceneAnswer planned = simulate(scene);
  scene.effects["film_compliance"] = EffectChoice::kOn;
  scene.tolerance = 1e-4;
  const SceneAnswer full = simulate(scene);
  for (const std::string& name : scene.wanted) {
    CAPTURE(name);
    CHECK(value_of(planned, name) == Approx(value_of(full, name)).epsilon(1e-2));
  }
}

TEST_CASE("a force on a wider tip stays the same force", "[pillar]") {
  PillarScene scene = moved_pillar(-1e-6, .33);
  scene.geometry.tip = {10e-6, 10e-6};
  const PillarModel model = model_of(scene, Motion::kLongitudinal, Discretisation{});
  CHECK(unit_top_force(model).sum() == Approx(1.0).epsilon(1e-12));
}

TEST_CASE("the buckling load under a thin rim claims no more than meshes agree on", "[pillar]") {
  PillarScene scene = moved_pillar(-1e-6, .33);
  scene.drive = BucklingDrive{};
  scene.wanted = {};
  scene.geometry.tip = {10e-6, 5e-6};
  scene.tolerance = 3e-3;
  CHECK_THROWS_WITH(simulate_pillar(scene), Catch::Contains("in the buckling_pressure"));
  scene.tolerance = 0.1;
  const SceneAnswer thin = simulate_pillar(scene);
  const double claimed_Pa = thin.results.at(0).error_estimate;
  const SceneAnswer fine = pillar_answer_on(scene, {.degree = 10, .layers = 2});
  CHECK(std::abs(fine.results.at(0).value - thin.results.at(0).value) < claimed_Pa);
  CHECK(claimed_Pa < 0.1 * thin.results.at(0).value);
  scene.geometry.tip = {10e-6, 7e-6};
  scene.tolerance = 1e-3;
  CHECK_NOTHROW(simulate_pillar(scene));
}

TEST_CASE("impossible displacements are refused with the reason", "[pillar]") {
  PillarScene scene = moved_pillar(-1e-6, .33);
  SECTION("beyond buckling between foot and plate") {
    test::as<StaticDrive>(scene).displacement_m = -9e-6;  // Engesser: 7.2 um
    CHECK_THROWS_WITH(simulate_pillar(scene), Catch::Contains("buckles between"));
    test::as<StaticDrive>(scene).displacement_m = -5e-6;
    CHECK_NOTHROW(simulate_pillar(scene));
    test::as<StaticDrive>(scene).displacement_m = 9e-6;  // a pull
    CHECK_NOTHROW(simulate_pillar(scene));
  }
  SECTION("nowhere") {
    test::as<StaticDrive>(scene).displacement_m = 0.0;
    CHECK_THROWS_WITH(simulate_pillar(scene), Catch::Contains("needs"));
  }
  SECTION("a pressure as well") {
    test::as<StaticDrive>(scene).pressure_Pa = 1e3;
    CHECK_THROWS_WITH(simulate_pillar(scene), Catch::Contains("not both"));
  }
  SECTION("further than the pillar is long") {
    test::as<StaticDrive>(scene).displacement_m = -130e-6;
    CHECK_THROWS_WITH(simulate_pillar(scene), Catch::Contains("no smaller than"));
  }
}

// Clamped below and upright above, free to slide: half a wave over the length, pi^2 E I/L^2 with
// Engesser's correction for shear, four times a free top's. Source: Timoshenko & Gere, Theory of
// Elastic Stability (1961), 2.1, 2.17.
TEST_CASE("a slender pillar under a plate buckles as an upright column", "[pillar]") {
  PillarScene scene;
  scene.geometry.length_m = 1200e-6;  // 30 diameters
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = .33;
  scene.drive = BucklingDrive{};
  const double free_Pa = value_of(simulate_pillar(scene), "buckling_pressure");
  test::as<BucklingDrive>(scene).plate_on_top = true;
  const double upright_Pa = value_of(simulate_pillar(scene), "buckling_pressure");
  const double euler_Pa = std::pow(std::numbers::pi * 10e-6 / 1200e-6, 2) * 1.8e6;
  const double kappa = 6.0 * 1.33 / (7.0 + 6.0 * .33);
  const double column_Pa = euler_Pa / (1.0 + euler_Pa / (kappa * 1.8e6 / 2.66));
  CHECK(upright_Pa == Approx(column_Pa).epsilon(5e-3));  // a clamped foot adds (R/L)/10 or so
  CHECK(upright_Pa / free_Pa == Approx(4.0).epsilon(1e-2));
}

TEST_CASE("a plate presses a pillar up to buckling but not beyond", "[pillar]") {
  PillarScene scene;
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = .33;
  scene.drive = BucklingDrive{};
  test::as<BucklingDrive>(scene).plate_on_top = true;
  const double critical_Pa = value_of(simulate_pillar(scene), "buckling_pressure");
  CHECK(critical_Pa > 2.5 * 29368.9);  // of a free top; at 3 diameters shear takes its share
  CHECK(critical_Pa < 4.0 * 29368.9);
  scene.drive = StaticDrive{};
  test::as<StaticDrive>(scene).displacement_m = -1e-6;
  const double area_m2 = std::numbers::pi * 4e-10;
  const double moved_m_Pa = area_m2 * 1e-6 / -value_of(simulate_pillar(scene), "top_force");
  // The check takes a coarse mesh, 2e-3 off at most.
  test::as<StaticDrive>(scene).displacement_m = -0.99 * critical_Pa * moved_m_Pa;
  CHECK_NOTHROW(refuse_beyond_buckling(scene));
  test::as<StaticDrive>(scene).displacement_m = -1.01 * critical_Pa * moved_m_Pa;
  CHECK_THROWS_WITH(refuse_beyond_buckling(scene), Catch::Contains("buckles between"));
}
