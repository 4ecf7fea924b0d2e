// Free bodies: their elastic modes, the motion by a voltage, and the scenes that are refused.
#include "models/answer/scene_mistake.h"
#include "models/pillar/analyses/simulate_pillar.h"
#include "models/pillar/body/pillar_model.h"
#include "models/pillar/body/pillar_modes.h"
#include "models/pillar/scene/pillar_scene.h"
#include "tests/models/pillar/analyses/answer_of.h"
#include "tests/models/pillar/drive_as.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace viscard;
using namespace viscard::test;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kE_Pa = 1.8e6, kRho = 965.0;

double free_Hz(const PillarGeometry& geometry, Motion motion, int number, double nu = .33,
               PlaneState plane = PlaneState::kStrain) {
  const Discretisation mesh{.degree = 8, .layers = 1, .shaft_elements = 3};
  const PillarModel model(geometry, mesh, {isotropic_medium(kE_Pa, nu, kRho), {}},
                          {.motion = motion, .plane = plane, .fixed_bottom = false});
  return lowest_modes(model, number).back().frequency_Hz;
}

PillarGeometry bar(double length_over_diameter) {
  return {.diameter_m = 40e-6, .length_m = 40e-6 * length_over_diameter};
}

// Nearly a film alone: the pillar on it is small and has no mass.
double disc_Hz(double thickness_over_radius, Motion motion) {
  const double R_m = 1e-3;
  const double t_m = thickness_over_radius * R_m;
  const PillarGeometry geometry{
      .diameter_m = 0.01 * R_m, .length_m = 0.005 * R_m, .film = FilmGeometry{t_m, R_m}};
  const Discretisation mesh{.degree = 6, .layers = 1, .shaft_elements = 1, .film_elements = 20};
  const PillarModel model(geometry, mesh,
                          {isotropic_medium(2e9, .33, 1e-3), isotropic_medium(2e9, .33, 1780.0)},
                          {.motion = motion, .fixed_bottom = false});
  return lowest_modes(model, 1).front().frequency_Hz;
}

PillarScene disc_under_voltage() {
  PillarScene scene;
  scene.geometry = {.diameter_m = 40e-6, .length_m = 40e-6, .film = FilmGeometry{25e-6, 60e-6}};
  scene.pillar.E0_Pa = 1.0;  // so soft that the film is free
  scene.pillar.nu = 0.0;     // and does not pass on that the film becomes wider
  PiezoMatrix charge = PiezoMatrix::Zero();
  charge(2, 0) = charge(2, 1) = 22e-12;
  charge(2, 2) = -30e-12;
  scene.film = piezo_medium(isotropic_medium(2e9, .29, 1780.0).stiffness_Pa, charge,
                            12.0 * kVacuumPermittivity_F_m * Eigen::Matrix3d::Identity(), 1780.0);
  scene.film_charge_C_N = charge;
  scene.electrodes = ElectrodeOptions{FilmFace::kBottom, 60e-6};
  scene.drive = StaticDrive{};
  test::as<StaticDrive>(scene).drive_V = 1.0;
  scene.fixed_bottom = false;
  return scene;
}

}  // namespace

TEST_CASE("rigid motions of every family have mass and no stiffness", "[pillar]") {
  struct Case {
    Motion motion;
    int count;
  };
  const auto c = GENERATE(Case{Motion::kLongitudinal, 1}, Case{Motion::kTorsion, 1},
                          Case{Motion::kLateral, 2}, Case{Motion::kOvalling, 0},
                          Case{Motion::kPlaneSymmetric, 1}, Case{Motion::kPlaneAntisymmetric, 2});
  PillarGeometry geometry{.film = FilmGeometry{25e-6, 60e-6}};
  if (c.motion != Motion::kPlaneSymmetric) geometry.foot = {10e-6, 20e-6};
  const PillarModel model(geometry, {.degree = 4},
                          {isotropic_medium(kE_Pa, .33, kRho), isotropic_medium(2e9, .29, 1780.0)},
                          {.motion = c.motion, .fixed_bottom = false});
  const Eigen::MatrixXd rigid = rigid_motions(model);
  REQUIRE(rigid.cols() == c.count);
  REQUIRE(rigid_motion_count(c.motion) == c.count);
  for (Eigen::Index i = 0; i < rigid.cols(); ++i) {
    const Eigen::VectorXd r = rigid.col(i);
    const double stiffness = std::abs(r.dot(times(model.stiffness(), r)));
    const double elastic_rad_s = 2.0 * kPi * lowest_modes(model, 1).front().frequency_Hz;
    const double mass = r.dot(times(model.mass(), r));
    CHECK(stiffness < 1e-7 * elastic_rad_s * elastic_rad_s * mass);  // rounding of the stiff film
  }
}

// f = n/(2 L) sqrt(G/rho): the shape is r cos(n pi z/L), and r is in every element.
TEST_CASE("torsion of the free bar is exact", "[pillar]") {
  const double first_Hz = std::sqrt(kE_Pa / 2.66 / kRho) / (2.0 * 400e-6);
  for (const int n : {1, 2, 3}) {
    CHECK(free_Hz(bar(10), Motion::kTorsion, n) == Approx(n * first_Hz).epsilon(1e-9));
  }
}

// Love's correction of the rod for the motion across it, 1 - (n pi nu R/L)^2/4; what is left is of
// fourth order, (2 R/L)^4 times numbers of order one. Source: Love, Mathematical Theory of
// Elasticity (1927), art. 278 (Pochhammer).
TEST_CASE("the free bar vibrates axially as Pochhammer's long waves", "[pillar]") {
  const double rod_Hz = std::sqrt(kE_Pa / kRho) / (2.0 * 400e-6);
  const double nu = GENERATE(.33, .49, .5);
  const double x = kPi * nu * 20e-6 / 400e-6;
  CHECK(free_Hz(bar(10), Motion::kLongitudinal, 1, nu) ==
        Approx(rod_Hz * (1.0 - 0.25 * x * x)).epsilon(5e-6));
  CHECK(free_Hz(bar(10), Motion::kLongitudinal, 1, nu) < rod_Hz * (1.0 - 0.2 * x * x));
}

// Euler-Bernoulli's 4.73004^2 sqrt(E I/(rho A))/(2 pi L^2) is the limit of slender ones, which
// shear and rotation approach as (d/L)^2. Source: Graff, Wave Motion in Elastic Solids (1975),
// ch. 3.
TEST_CASE("free bars and strips bend as free beams in the limit", "[pillar]") {
  const bool is_strip = GENERATE(false, true);
  const Motion motion = is_strip ? Motion::kPlaneAntisymmetric : Motion::kLateral;
  const double gyration_m = is_strip ? 40e-6 / std::sqrt(12.0) : 10e-6;
  const auto ratio = [&](double slenderness) {
    const double L = bar(slenderness).length_m;
    const double beam_Hz =
        4.730041 * 4.730041 * gyration_m / (2.0 * kPi * L * L) * std::sqrt(kE_Pa / kRho);
    return free_Hz(bar(slenderness), motion, 1, .33, PlaneState::kStress) / beam_Hz;
  };
  const double at_20 = ratio(20.0), at_40 = ratio(40.0);
  CHECK((4.0 * at_40 - at_20) / 3.0 == Approx(1.0).epsilon(3e-4));  // next order: (d/L)^4
  CHECK(1.0 - at_40 > 1e-3);                                        // and not there yet
}

// Kirchhoff's free plate at nu = 0.33: roots of the Bessel equation of its edge; Leissa, Vibration
// of Plates, NASA SP-160 (1969), 2.1.3, has 5.253 (m = 2), 9.084 (0) and 20.52 (1) with fewer
// digits.
TEST_CASE("a free disc vibrates as a free plate as it becomes thin", "[pillar]") {
  struct Case {
    Motion motion;
    double lambda2;
  };
  const auto c = GENERATE(Case{Motion::kOvalling, 5.262037}, Case{Motion::kLongitudinal, 9.068899},
                          Case{Motion::kLateral, 20.513087});
  const auto ratio = [&](double t_over_R) {
    const double plate_Hz = c.lambda2 * t_over_R / (2.0 * kPi * 1e-3) *
                            std::sqrt(2e9 / (12.0 * 1780.0 * (1.0 - .1089)));
    return disc_Hz(t_over_R, c.motion) / plate_Hz;
  };
  const double thick = ratio(0.08), medium = ratio(0.04), thin = ratio(0.02);
  CAPTURE(thick, medium, thin);
  // Shear and rotation take t^2 away from the limit, twist at the free edge t (Kirchhoff's edge).
  CHECK((thick - 6.0 * medium + 8.0 * thin) / 3.0 == Approx(1.0).epsilon(4e-4));
  CHECK(1.0 - thick > 8e-3);
}

// Freeing the bottom removes constraints: by Rayleigh no frequency rises, counted with the rigid
// ones. The pillar swings faster against a film that moves the opposite way.
TEST_CASE("the modes of a free pillar interlace with those of the held one", "[pillar]") {
  const Discretisation mesh{.degree = 6, .layers = 2};
  const PillarMedia media{isotropic_medium(kE_Pa, .33, kRho), isotropic_medium(2e9, .29, 1780.0)};
  const Motion motion = GENERATE(Motion::kLongitudinal, Motion::kLateral, Motion::kTorsion);
  const PillarGeometry geometry{.film = FilmGeometry{25e-6, 60e-6}};
  const auto modes = [&](bool fixed) {
    const PillarModel model(geometry, mesh, media, {.motion = motion, .fixed_bottom = fixed});
    return lowest_modes(model, 4);
  };
  const auto held = modes(true), freed = modes(false);
  const auto rigid = static_cast<std::size_t>(rigid_motion_count(motion));
  for (std::size_t i = 0; i + rigid < 4; ++i) {
    CHECK(freed[i].frequency_Hz <= held[i + rigid].frequency_Hz);
  }
  CHECK(freed[0].frequency_Hz > held[0].frequency_Hz);
}

TEST_CASE("the six rigid motions of a free body, three of a strip, are counted and removed",
          "[pillar]") {
  PillarScene scene;
  scene.tolerance = 1e-2;
  scene.geometry = bar(3.0);
  scene.pillar.E0_Pa = kE_Pa;
  scene.pillar.nu = .33;
  scene.pillar.rho_kg_m3 = kRho;
  scene.drive = ModalDrive{.modes = 2};
  scene.fixed_bottom = false;
  std::string told = "6 motions";
  SECTION("cylinder") {}
  SECTION("strip") {
    scene.plane = PlaneState::kStress;
    told = "3 motions";
  }
  const SceneAnswer answer = simulate_pillar(scene);
  CHECK(answer.notes.at(0).find(told) != std::string::npos);
  for (const SceneMode& mode : answer.modes) CHECK(mode.frequency_Hz > 1e4);
}

TEST_CASE("a free film between electrodes becomes thicker by d33 times the voltage", "[pillar]") {
  const SceneAnswer answer = simulate_pillar(disc_under_voltage());
  // Case 5 of a free plate: 30.00 pm/V; the pillar is 2e9 times as soft.
  CHECK(value_of(answer, "displacement_per_volt") == Approx(30e-12).epsilon(1e-7));
  CHECK(value_of(answer, "top_displacement") == Approx(30e-12).epsilon(1e-7));
  const double plate_F = 12.0 * kVacuumPermittivity_F_m * kPi * 3.6e-9 / 25e-6;
  CHECK(value_of(answer, "electrode_capacitance") == Approx(plate_F).epsilon(1e-7));
  CHECK_THROWS(value_of(answer, "stiffness_open"));
}

// A wide plate on a rigid base cannot become wider, so its thickness changes by d33 + 2 nu/(1 - nu)
// d31 = -12.03 pm/V instead (IEEE Std 176-1987 with S1 = S2 = 0).
TEST_CASE("a film that is held moves less under a voltage", "[pillar]") {
  PillarScene scene = disc_under_voltage();
  const double free_m = value_of(simulate_pillar(scene), "top_displacement");
  scene.fixed_bottom = true;
  const double held_m = value_of(simulate_pillar(scene), "top_displacement");
  CHECK(held_m < 0.9 * free_m);
  scene.geometry.film->radius_m = 600e-6;
  scene.electrodes->electrode_radius_m = 600e-6;
  CHECK(value_of(simulate_pillar(scene), "top_displacement") == Approx(12.03e-12).epsilon(1e-3));
}

TEST_CASE("analyses that need support are refused for a free bottom, with the reason", "[pillar]") {
  PillarScene scene = disc_under_voltage();
  const auto key_of = [](const PillarScene& refused) {
    try {
      validate(refused);
    } catch (const SceneMistake& mistake) {
      CHECK(std::string(mistake.what()).find("free") != std::string::npos);
      return mistake.key();
    }
    return std::string("not refused");
  };
  test::as<StaticDrive>(scene).pressure_Pa = 1e3;
  CHECK(key_of(scene) == "geometry.film.bottom");
  test::as<StaticDrive>(scene).pressure_Pa = 0.0;
  test::as<StaticDrive>(scene).drive_V = 0.0;
  CHECK(key_of(scene) == "geometry.film.bottom");
  test::as<StaticDrive>(scene).displacement_m = 1e-9;
  CHECK(key_of(scene) == "geometry.film.bottom");
  scene = disc_under_voltage();
  scene.pillar.rho_kg_m3 = kRho;
  for (const PillarDrive& drive :
       {PillarDrive(BucklingDrive{}), PillarDrive(CreepDrive{}), PillarDrive(RelaxationDrive{})}) {
    scene.drive = drive;
    CHECK(key_of(scene) == "geometry.film.bottom");
  }
  scene.film.reset();
  scene.geometry.film.reset();
  scene.electrodes.reset();
  CHECK(key_of(scene) == "geometry.bottom");
}
