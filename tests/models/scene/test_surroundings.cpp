// Temperature, weight and air around a pillar, against closed forms.
#include "models/maths/text_of_number.h"
#include "models/pillar/analyses/air_damping.h"
#include "models/pillar/body/pillar_model.h"
#include "models/scene/plan.h"
#include "models/scene/simulate.h"
#include "tests/models/pillar/drive_as.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace viscard;
using Catch::Matchers::Contains;
using viscard::test::as;

namespace {

PillarScene bare_pillar(double nu) {
  PillarScene scene;
  scene.geometry.diameter_m = 40e-6;
  scene.geometry.length_m = 400e-6;
  scene.pillar.E0_Pa = 1e6;
  scene.pillar.nu = nu;
  scene.pillar.rho_kg_m3 = 965.0;
  scene.drive = StaticDrive{};
  scene.tolerance = 1e-6;
  scene.wanted = {"top_displacement"};
  return scene;
}

double result(const SceneAnswer& answer, const std::string& name) {
  for (const SceneResult& one : answer.results) {
    if (one.name == name) return one.value;
  }
  FAIL("no result " << name);
  return 0.0;
}

double top_m(const PillarScene& scene) {
  return result(simulate(scene), "top_displacement");
}

SceneEffect effect(const PillarScene& scene, const std::string& name) {
  for (const SceneEffect& one : plan_effects(scene).effects) {
    if (one.name == name) return one;
  }
  FAIL("no effect " << name);
  return {};
}

// Nearly anything: PVDF of the reference scenes, isotropic in its plane.
Medium piezo_film() {
  PiezoMatrix d = PiezoMatrix::Zero();
  d(2, 0) = d(2, 1) = 23e-12;
  d(2, 2) = -33e-12;
  const Eigen::Matrix3d permittivity = 12.0 * kVacuumPermittivity_F_m * Eigen::Matrix3d::Identity();
  return piezo_medium(isotropic_moduli_Pa(3e9, 0.35), d, permittivity, 1780.0);
}

}  // namespace

TEST_CASE("a pillar sinks under its weight by rho g L^2/(2 E), and the load adds to it",
          "[pillar][plan]") {
  PillarScene scene = bare_pillar(0.0);
  scene.surroundings.gravity_m_s2 = 9.81;
  const double L_m = scene.geometry.length_m;
  const double by_weight_m = -965.0 * 9.81 * L_m * L_m / (2.0 * 1e6);
  CHECK(top_m(scene) == Approx(by_weight_m).epsilon(1e-9));
  as<StaticDrive>(scene).pressure_Pa = 10.0;
  CHECK(top_m(scene) == Approx(by_weight_m - 10.0 * L_m / 1e6).epsilon(1e-9));

  SECTION("a top that is held carries half of it") {
    as<StaticDrive>(scene) = StaticDrive{.displacement_m = -1e-9};
    scene.wanted = {"top_force"};
    const double area_m2 = std::numbers::pi * 20e-6 * 20e-6;
    CHECK(result(simulate(scene), "top_force") ==
          Approx(area_m2 * 1e6 * (-1e-9 - by_weight_m) / L_m).epsilon(1e-9));
  }
  SECTION("under a load that is hundreds of times as large it is left out, within its estimate") {
    as<StaticDrive>(scene).pressure_Pa = 1e3;
    scene.tolerance = 1e-2;
    const SceneEffect weight = effect(scene, "weight");
    CHECK_FALSE(weight.on);
    CHECK(weight.estimate == Approx(965.0 * 9.81 * L_m / 1e3));
    PillarScene with = scene;
    with.effects["weight"] = EffectChoice::kOn;
    CHECK(std::abs(top_m(scene) / top_m(with) - 1.0) < weight.estimate);
  }
  SECTION("a body that nothing holds is refused") {
    scene.fixed_bottom = false;
    as<StaticDrive>(scene).pressure_Pa = 0.0;
    scene.surroundings.temperature_C = 24.0;  // which alone it may have
    scene.surroundings.made_at_C = 23.0;
    scene.surroundings.pillar_expansion_1_K = 3e-4;
    CHECK_THROWS_WITH(simulate(scene), Contains("against the weight"));
  }
}

TEST_CASE("a pillar that is warmed expands by alpha dT", "[pillar][plan]") {
  PillarScene scene = bare_pillar(GENERATE(0.0, 0.3, 0.49, 0.4999));
  scene.surroundings.temperature_C = 43.0;
  scene.surroundings.made_at_C = 23.0;
  scene.surroundings.pillar_expansion_1_K = 3e-4;
  const double free_m = 3e-4 * 20.0 * scene.geometry.length_m;
  SECTION("without a base") {
    scene.fixed_bottom = false;
    CHECK(top_m(scene) == Approx(free_m).epsilon(1e-7));
  }
  SECTION("on a rigid base the foot hinders it over a length of the order of its diameter") {
    const double share = top_m(scene) / free_m;
    // Where it is held sideways, a disc expands by (1 + nu)/(1 - nu) as much along the axis.
    if (scene.pillar.nu == 0.0) {
      CHECK(share == Approx(1.0).epsilon(1e-8));
    } else {
      CHECK(share > 1.0);
      CHECK(share < 1.1);
    }
  }
}

TEST_CASE("what heat and weight change is within their estimates on flat pillars and wide films",
          "[pillar][plan]") {
  PillarScene scene = bare_pillar(0.499);
  scene.geometry.diameter_m = 1e-3;
  scene.geometry.length_m = 20e-6;
  as<StaticDrive>(scene).pressure_Pa = 1e4;
  scene.tolerance = 1e-3;
  std::string name = "thermal_strain";
  SECTION("a flat pillar is held by its foot") {
    scene.surroundings.temperature_C = 23.09;
    scene.surroundings.made_at_C = 23.0;
    scene.surroundings.pillar_expansion_1_K = 3e-4;
  }
  SECTION("a slender one less") {
    scene.geometry.diameter_m = 40e-6;
    scene.geometry.length_m = 120e-6;
    scene.surroundings.temperature_C = 23.1;
    scene.surroundings.made_at_C = 23.0;
    scene.surroundings.pillar_expansion_1_K = 3e-4;
  }
  SECTION("an electrode adds up the weight of its film") {
    name = "weight";
    scene.geometry.diameter_m = 40e-6;
    scene.geometry.length_m = 120e-6;
    scene.pillar.nu = 0.33;
    scene.geometry.film = FilmGeometry{400e-6, 400e-6};
    scene.film = piezo_film();
    scene.electrodes = ElectrodeOptions{FilmFace::kTop, 200e-6};
    scene.surroundings.gravity_m_s2 = 9.81;
    as<StaticDrive>(scene).pressure_Pa = 200.0;
    scene.wanted = {"electrode_voltage"};
  }
  const std::string result_name = scene.wanted.front();
  PillarScene with = scene, without = scene;
  with.effects[name] = EffectChoice::kOn;
  without.effects[name] = EffectChoice::kOff;
  const double on = result(simulate(with), result_name),
               off = result(simulate(without), result_name);
  CAPTURE(on, off, effect(scene, name).estimate);
  CHECK(std::abs(on - off) <= 1.01 * effect(scene, name).estimate * std::abs(off));
}

TEST_CASE("a pillar that its own weight buckles is refused", "[pillar][plan]") {
  PillarScene scene = bare_pillar(0.49);
  scene.geometry.diameter_m = 1e-3;
  scene.geometry.length_m = 90e-3;
  scene.surroundings.gravity_m_s2 = 9.81;
  CHECK_THROWS_WITH(simulate(scene), Contains("buckles"));
  scene.surroundings.gravity_m_s2 = -9.81;  // it hangs
  CHECK_NOTHROW(simulate(scene));
}

TEST_CASE("strips and liquids have no formula here, and are refused", "[pillar][plan]") {
  PillarScene scene = bare_pillar(0.33);
  scene.surroundings.temperature_C = 33.0;
  scene.surroundings.made_at_C = 23.0;
  scene.surroundings.pillar_expansion_1_K = 3e-4;
  scene.plane = PlaneState::kStress;
  CHECK_THROWS_WITH(simulate(scene), Contains("plane strain"));
  scene.surroundings = {};
  scene.plane.reset();
  scene.drive = ModalDrive{.modes = 1};
  scene.wanted = {};
  scene.surroundings.air = true;
  scene.surroundings.air_density_kg_m3 = 1000.0;
  CHECK_THROWS_WITH(simulate(scene), Contains("no liquid"));
}

TEST_CASE("heat strains no incompressible pillar that is held, and the message says so",
          "[pillar][stability]") {
  PillarScene scene = bare_pillar(0.5);
  scene.surroundings.temperature_C = 43.0;
  scene.surroundings.made_at_C = 23.0;
  scene.surroundings.pillar_expansion_1_K = 3e-4;
  CHECK_THROWS_WITH(simulate(scene), Contains("below 0.5"));
}

TEST_CASE("a film that is warmed gives the voltage of a plate that its base holds sideways",
          "[pillar][plan]") {
  PillarScene scene = bare_pillar(0.3);
  scene.geometry.length_m = 40e-6;
  scene.pillar.E0_Pa = 100.0;  // bears nothing
  const double t_m = 25e-6;
  scene.geometry.film = FilmGeometry{t_m, 900e-6};  // its rim is felt over some ten thicknesses
  scene.film = piezo_film();
  scene.electrodes = ElectrodeOptions{FilmFace::kBottom, 0.0};
  scene.surroundings.temperature_C = 24.0;
  scene.surroundings.made_at_C = 23.0;
  scene.surroundings.film_expansion_1_K = 1.3e-4;
  scene.surroundings.pyroelectric_C_m2K = GENERATE(0.0, -27e-6, 27e-6);
  scene.wanted = {"potential_at_centre"};
  scene.tolerance = 1e-4;
  // T_3 = 0 on the free face and D_3 = 0, with S_1 = S_2 = 0.
  const Medium& film = *scene.film;
  const double c33 = film.stiffness_Pa(2, 2), c13 = film.stiffness_Pa(0, 2);
  const double e33 = film.piezo_C_m2(2, 2), e31 = film.piezo_C_m2(2, 0);
  const double strain = 1.3e-4;
  const double field_V_m = (2.0 * e31 * strain - scene.surroundings.pyroelectric_C_m2K -
                            2.0 * e33 * c13 / c33 * strain) /
                           (film.permittivity_F_m(2, 2) + e33 * e33 / c33);
  const SceneAnswer answer = simulate(scene);
  CHECK(result(answer, "potential_at_centre") ==
        Approx(-field_V_m * t_m).epsilon(1e-6).margin(1e-5));
  CHECK(effect(scene, "thermal_strain").on);
}

TEST_CASE("air moves with a cylinder as Stokes computed", "[pillar]") {
  // K_0(1) = 0.42102443824, K_1(1) = 0.60190723019, K_2(1) = 1.62483889863 (Abramowitz & Stegun, table 9.8).
  CHECK(air_factor(AirMotion::kSideways, 1.0).real() ==
        Approx(1.0 + 4.0 * 0.60190723019 / 0.42102443824).epsilon(1e-9));
  CHECK(air_factor(AirMotion::kAlong, 1.0).real() ==
        Approx(2.0 * 0.60190723019 / 0.42102443824).epsilon(1e-9));
  CHECK(air_factor(AirMotion::kTurning, 1.0).real() ==
        Approx(4.0 * 1.62483889863 / 0.60190723019).epsilon(1e-9));
  // His expansions for a thin boundary layer, R sqrt(omega rho/mu) = m.
  const double m = GENERATE(30.0, 300.0);
  const std::complex<double> sideways =
      air_factor(AirMotion::kSideways, std::sqrt(std::complex<double>(0.0, m * m)));
  CHECK(sideways.real() == Approx(1.0 + 2.0 * std::sqrt(2.0) / m).epsilon(2.0 / (m * m)));
  CHECK(-sideways.imag() ==
        Approx(2.0 * std::sqrt(2.0) / m + 2.0 / (m * m)).epsilon(2.0 / (m * m)));
}

TEST_CASE("the factor of air is finite from creeping to ideal flow", "[pillar][stability]") {
  for (double size = 1e-6; size < 1e7; size *= 10.0) {
    const std::complex<double> z = size * std::sqrt(std::complex<double>(0.0, 1.0));
    for (const AirMotion motion : {AirMotion::kSideways, AirMotion::kAlong, AirMotion::kTurning}) {
      const std::complex<double> factor = air_factor(motion, z);
      CAPTURE(size, factor.real(), factor.imag());
      CHECK(std::isfinite(factor.real()));
      CHECK(factor.imag() < 0.0);
      CHECK(factor.real() >= 0.0);
    }
  }
}

TEST_CASE("modes in air have its damping ratio, and it can be left out", "[pillar][plan]") {
  PillarScene scene = bare_pillar(0.3);
  scene.geometry.length_m = 120e-6;
  scene.drive = ModalDrive{.modes = 2};
  scene.wanted = {};
  scene.tolerance = 2e-3;
  const SceneAnswer in_vacuum = simulate(scene);
  CHECK_THAT(effect(scene, "air_damping").reason, Contains("would add a damping ratio"));
  scene.surroundings.air = true;
  const SceneAnswer in_air = simulate(scene);
  REQUIRE(in_air.modes.size() == in_vacuum.modes.size());
  for (std::size_t i = 0; i < in_air.modes.size(); ++i) {
    const SceneMode& mode = in_air.modes[i];
    CAPTURE(mode.family, i);
    REQUIRE(mode.damping_ratio);
    CHECK(*mode.damping_ratio > 0.0);
    CHECK(mode.damping_error <= 1.001 * *mode.damping_ratio);
    CHECK(mode.frequency_Hz < in_vacuum.modes[i].frequency_Hz);
    CHECK(mode.frequency_Hz > 0.99 * in_vacuum.modes[i].frequency_Hz);
  }
  const double omega_1_s = 2.0 * std::numbers::pi * in_vacuum.modes.front().frequency_Hz;
  const double layer_m = std::sqrt(18.2e-6 / (1.204 * omega_1_s));
  const std::complex<double> gamma =
      air_factor(AirMotion::kSideways, 20e-6 / layer_m * std::sqrt(std::complex<double>(0.0, 1.0)));
  CHECK(in_air.modes.front().family == "lateral");
  CHECK(*in_air.modes.front().damping_ratio ==
        Approx(-0.5 * 1.204 / 965.0 * gamma.imag()).epsilon(0.01));

  scene.effects["air_damping"] = EffectChoice::kOff;
  CHECK_FALSE(simulate(scene).modes.front().damping_ratio);
}

TEST_CASE("a shift of the times is left out where it changes nothing", "[pillar][plan]") {
  PillarScene scene = bare_pillar(0.3);
  scene.pillar.terms = {{.g = 0.1, .k = 0.1, .tau_s = 1.0}};
  scene.pillar.T_ref_C = 23.0;
  scene.drive = CreepDrive{.history = {{0.0, 0.0}, {0.1, 10.0}, {10.0, 10.0}}};
  scene.wanted = {};
  scene.tolerance = 1e-3;
  scene.surroundings.temperature_C = 23.2;
  CHECK(effect(scene, "temperature").estimate == 0.0);
  scene.surroundings.temperature_C = 40.0;
  CHECK(effect(scene, "temperature").is_outside);  // no shift is known
  CHECK(effect(scene, "temperature").estimate == Approx(0.1));

  scene.surroundings.shift_factor = GENERATE(0.999, 0.1);
  const SceneEffect shift = effect(scene, "temperature");
  CHECK(shift.on == (scene.surroundings.shift_factor == 0.1));
  CHECK(shift.estimate <= 0.1);
  const PillarScene reduced = std::get<PillarScene>(plan_effects(scene).reduced);
  CHECK(reduced.pillar.terms[0].tau_s == Approx(shift.on ? 1.0 : 1.0 / 0.999));
}
