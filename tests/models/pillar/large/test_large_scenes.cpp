#include "models/pillar/analyses/large_strain.h"
#include "models/pillar/analyses/simulate_pillar.h"
#include "models/scene/plan.h"
#include "models/scene/simulate.h"
#include "tests/models/pillar/drive_as.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace viscard;

namespace {

HyperelasticLaw law_of(HyperelasticForm form, const std::vector<double>& moduli_Pa,
                       const std::vector<double>& shapes = {}) {
  const auto vector = [](const std::vector<double>& v) {
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(v.data(), std::ssize(v)));
  };
  return {form, vector(moduli_Pa), vector(shapes)};
}

PillarScene rubber_pillar(const HyperelasticLaw& law, double nu) {
  PillarScene scene;
  scene.rubber = law;
  scene.pillar.E0_Pa = youngs_modulus_Pa(law);
  scene.pillar.nu = nu;
  scene.pillar.rho_kg_m3 = 930.0;
  scene.geometry = {.diameter_m = 100e-6, .length_m = 100e-6};
  return scene;
}

PillarScene on_film(PillarScene scene) {
  scene.geometry.film = FilmGeometry{25e-6, 100e-6};
  PiezoMatrix d = PiezoMatrix::Zero();
  d(2, 0) = d(2, 1) = 23e-12;
  d(2, 2) = -33e-12;
  scene.film = piezo_medium(isotropic_moduli_Pa(2e9, 0.29), d,
                            12.0 * kVacuumPermittivity_F_m * Eigen::Matrix3d::Identity(), 1780.0);
  scene.electrodes = ElectrodeOptions{FilmFace::kBottom, 50e-6};
  return scene;
}

const HyperelasticLaw kNeoHooke = law_of(HyperelasticForm::kNeoHooke, {0.3e6});

double value_of(const SceneAnswer& answer, const std::string& name) {
  for (const SceneResult& result : answer.results) {
    if (result.name == name) return result.value;
  }
  throw std::runtime_error("no result " + name);
}

SceneEffect finite_strain_of(const PillarScene& scene) {
  for (const SceneEffect& effect : plan_effects(scene).effects) {
    if (effect.name == "finite_strain") return effect;
  }
  throw std::runtime_error("no effect");
}

}  // namespace

TEST_CASE("the estimate of large strain covers what it changes", "[pillar][plan]") {
  const std::vector<HyperelasticLaw> laws = {
      kNeoHooke, law_of(HyperelasticForm::kMooneyRivlin, {0.1e6, 0.2e6}),
      law_of(HyperelasticForm::kYeoh, {0.3e6, -0.05e6, 0.01e6}),
      law_of(HyperelasticForm::kOgden1, {0.6e6}, {4.0}),
      law_of(HyperelasticForm::kGent, {0.6e6}, {5.0})};
  const Discretisation mesh{.degree = 4, .layers = 2};
  for (const HyperelasticLaw& law : laws) {
    for (const double nu : {0.33, 0.499}) {
      for (const double length_m : {40e-6, 100e-6, 300e-6}) {
        for (const double strain : {-0.06, -0.01, 0.03, 0.1}) {
          for (const bool is_moved : {false, true}) {
            PillarScene scene = rubber_pillar(law, nu);
            scene.geometry.length_m = length_m;
            auto& drive = test::as<StaticDrive>(scene);
            if (is_moved)
              drive.displacement_m = strain * length_m;
            else
              drive.pressure_Pa = -strain * scene.pillar.E0_Pa;
            const SceneAnswer large = pillar_answer_on(scene, mesh);
            scene.small_strain = true;
            const SceneAnswer linear = pillar_answer_on(scene, mesh);
            const double estimate = large_strain_error(scene, strain);
            for (const SceneResult& result : linear.results) {
              const double change = std::abs(value_of(large, result.name) / result.value - 1.0);
              INFO(name_of(law.form)
                   << ", nu " << nu << ", length " << length_m << " m, strain " << strain
                   << (is_moved ? ", moved: " : ", pressed: ") << result.name);
              CHECK(change <= estimate);
            }
          }
        }
      }
    }
  }
}

TEST_CASE("the plan answers a pillar of rubber at large strain where the tolerance needs it",
          "[pillar][plan]") {
  PillarScene scene = rubber_pillar(kNeoHooke, 0.49);
  scene.tolerance = 1e-2;
  test::as<StaticDrive>(scene).displacement_m = -8e-6;
  const SceneEffect on = finite_strain_of(scene);
  CHECK(on.on);
  CHECK(on.value == Approx(0.08));
  // Neo-Hooke: P = E_0 (s - 1/s^2)/3.
  const double s = 0.92;
  const double curvature = std::abs((s - 1.0 / (s * s)) / 3.0 / 0.08) - 1.0;
  const double confined = 2.0 / 16.0 / (1.0 + 2.0 / 16.0);  // S = 1/4
  CHECK(on.estimate == Approx(1.5 * curvature + 2.0 * 0.08 * confined).epsilon(1e-6));
  const SceneAnswer large = simulate(scene);
  CHECK(large.within_tolerance);
  CHECK(large.largest_relative_error <= 1e-2);

  // Small loads are answered as before, and the estimate is part of the error.
  PillarScene small = scene;
  test::as<StaticDrive>(small).displacement_m = -0.1e-6;
  const SceneEffect off = finite_strain_of(small);
  CHECK_FALSE(off.on);
  CHECK(off.is_counted);
  const SceneAnswer linear = simulate(small);
  CHECK(linear.largest_relative_error >= off.estimate);
  const double ratio = value_of(large, "top_force") / value_of(linear, "top_force") / 80.0;
  CHECK(ratio > 1.05);

  // The scene may decide.
  small.effects["finite_strain"] = EffectChoice::kOn;
  CHECK(finite_strain_of(small).on);
  CHECK(value_of(simulate(small), "top_force") ==
        Approx(value_of(linear, "top_force")).epsilon(5e-3));
  scene.effects["finite_strain"] = EffectChoice::kOff;
  const SceneAnswer forced = simulate(scene);
  CHECK_FALSE(forced.within_tolerance);
  CHECK(value_of(forced, "top_force") ==
        Approx(80.0 * value_of(linear, "top_force")).epsilon(1e-2));
}

TEST_CASE("what cannot be answered at large strain is warned of by the law's curvature",
          "[pillar][plan]") {
  PillarScene scene = rubber_pillar(kNeoHooke, 0.49);
  scene.geometry.length_m = 200e-6;
  SECTION("modes under a pressure") {
    scene.drive = ModalDrive{.pressure_Pa = 2e4};
  }
  SECTION("sideways") {
    scene.drive = StaticDrive{.direction = LoadDirection::kLateral, .pressure_Pa = 1e4};
  }
  SECTION("a strip") {
    scene.plane = PlaneState::kStrain;
    test::as<StaticDrive>(scene).pressure_Pa = 2e4;
  }
  const SceneEffect effect = finite_strain_of(scene);
  CHECK_FALSE(effect.on);
  CHECK(effect.is_outside);
  CHECK(effect.estimate == Approx(large_strain_error(scene, -effect.value)));
  scene.effects["finite_strain"] = EffectChoice::kOn;
  CHECK_THROWS_WITH(plan_effects(scene), Catch::Contains("cannot be on"));
}

TEST_CASE("a law that ends before the strain is not left out", "[pillar][plan]") {
  PillarScene scene = rubber_pillar(law_of(HyperelasticForm::kGent, {0.6e6}, {0.1}), 0.49);
  CHECK(large_strain_error(scene, 0.3) == 1.0);
  CHECK(large_strain_error(scene, 0.001) < 0.01);
}

TEST_CASE("every result of a pillar of rubber can be requested", "[pillar][plan]") {
  PillarScene scene = rubber_pillar(kNeoHooke, 0.49);
  scene.tolerance = 5e-2;
  test::as<StaticDrive>(scene).pressure_Pa = 1e5;
  scene.effects["finite_strain"] = EffectChoice::kOn;
  SECTION("no film") {}
  SECTION("electrode") {
    scene = on_film(scene);
  }
  SECTION("charge-free face") {
    scene = on_film(scene);
    scene.electrodes->electrode_radius_m = 0.0;
  }
  SECTION("moved top") {
    scene = on_film(scene);
    test::as<StaticDrive>(scene).pressure_Pa = 0.0;
    test::as<StaticDrive>(scene).displacement_m = -5e-6;
  }
  const std::vector<std::string> names = result_names(scene);
  const SceneAnswer answer = simulate(scene);
  CHECK(answer.results.size() >= 2);
  for (const SceneResult& result : answer.results) {
    CAPTURE(result.name);
    CHECK(std::find(names.begin(), names.end(), result.name) != names.end());
  }
  CHECK_FALSE(solution_fields(scene, {.degree = 3, .layers = 1}).empty());
}

TEST_CASE("the film's voltage at large strain is linear for small loads and follows the force",
          "[pillar][reduction]") {
  const Discretisation mesh{.degree = 4, .layers = 2};
  PillarScene scene = on_film(rubber_pillar(kNeoHooke, 0.49));
  const auto at = [&](double pressure_Pa, bool small_strain) {
    test::as<StaticDrive>(scene).pressure_Pa = pressure_Pa;
    scene.small_strain = small_strain;
    return pillar_answer_on(scene, mesh);
  };
  const double linear_V = value_of(at(1e3, true), "electrode_voltage");
  const auto change = [&](double pressure_Pa) {
    return value_of(at(pressure_Pa, false), "electrode_voltage") / (linear_V * pressure_Pa / 1e3) -
           1.0;
  };
  CHECK(std::abs(change(1.0)) < 1e-5);
  CHECK(change(2e3) / change(1e3) == Approx(2.0).epsilon(0.02));
  // The force on the film is the same; what changes is how it is spread over the foot.
  CHECK(std::abs(change(1e5)) < 0.1);
  // Shortening, charge and voltage belong together.
  const SceneAnswer large = at(1e5, false);
  const SceneAnswer small = at(1e5, true);
  CHECK(value_of(large, "electrode_charge") / value_of(small, "electrode_charge") ==
        Approx(value_of(large, "electrode_voltage") / value_of(small, "electrode_voltage")));
  CHECK(std::abs(value_of(large, "top_displacement")) <
        0.98 * std::abs(value_of(small, "top_displacement")));
}
