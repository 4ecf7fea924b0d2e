// The results that a scene may ask for are those that its analyses return.
#include "models/pillar/analyses/simulate_pillar.h"
#include "models/scene/plan.h"
#include "models/scene/simulate.h"
#include "tests/models/pillar/drive_as.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace viscard;

namespace {

PillarScene sensor() {
  PillarScene scene;
  scene.tolerance = 5e-2;
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = 0.33;
  scene.pillar.rho_kg_m3 = 965.0;
  scene.pillar.terms = {{0.1, 0.1, 1e-3}};
  test::as<StaticDrive>(scene).pressure_Pa = 1e3;
  scene.geometry.film = FilmGeometry{25e-6, 60e-6};
  PiezoMatrix d = PiezoMatrix::Zero();
  d(2, 2) = -33e-12;
  scene.film = piezo_medium(isotropic_moduli_Pa(2e9, 0.29), d,
                            12.0 * kVacuumPermittivity_F_m * Eigen::Matrix3d::Identity(), 1780.0);
  scene.electrodes = ElectrodeOptions{FilmFace::kBottom, 20e-6};
  return scene;
}

void check_listed(const PillarScene& scene) {
  const std::vector<std::string> names = result_names(scene);
  const auto is_listed = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  const SceneAnswer answer = simulate(scene);
  for (const SceneResult& result : answer.results) {
    CAPTURE(result.name);
    CHECK(is_listed(result.name));
  }
  for (const SceneCurve& curve : answer.curves) {
    CAPTURE(curve.name);
    CHECK(is_listed(curve.name));
  }
  CHECK(answer.results.size() + answer.curves.size() + answer.modes.size() > 0);
}

}  // namespace

TEST_CASE("every static result can be requested", "[pillar][plan]") {
  PillarScene scene = sensor();
  SECTION("electrode") {}
  SECTION("driven electrode") {
    test::as<StaticDrive>(scene).drive_V = 1.0;
  }
  SECTION("charge-free face") {
    scene.electrodes->electrode_radius_m = 0.0;
  }
  SECTION("moved top") {
    test::as<StaticDrive>(scene).pressure_Pa = 0.0;
    test::as<StaticDrive>(scene).displacement_m = -1e-7;
    SECTION("electrode") {}
    SECTION("wired electrode") {
      scene.readout = Readout{.resistance_Ohm = 1e9};
    }
    SECTION("driven electrode") {
      test::as<StaticDrive>(scene).drive_V = 1.0;
    }
    SECTION("charge-free face") {
      scene.electrodes->electrode_radius_m = 0.0;
    }
    SECTION("no electrode, sideways") {
      scene.electrodes.reset();
      test::as<StaticDrive>(scene).direction = LoadDirection::kLateral;
    }
  }
  SECTION("no electrode") {
    scene.electrodes.reset();
  }
  SECTION("no film") {
    scene.electrodes.reset();
    scene.film.reset();
    scene.geometry.film.reset();
  }
  check_listed(scene);
}

TEST_CASE("every result in time and frequency can be requested", "[pillar][plan]") {
  PillarScene scene = sensor();
  SECTION("creep") {
    scene.drive = CreepDrive{{{0.0, 0.0}, {1e-2, 1e3}, {1.0, 1e3}}};
  }
  SECTION("relaxation") {
    scene.drive = RelaxationDrive{{{0.0, 0.0}, {1e-2, 1e-7}, {1.0, 1e-7}}};
  }
  SECTION("harmonic") {
    scene.drive = HarmonicDrive{.pressure_Pa = 1e3, .frequencies_Hz = {1e3, 1e4, 5e4}};
  }
  check_listed(scene);
}

TEST_CASE("a wanted curve keeps its film and electrode in the plan", "[pillar][plan]") {
  PillarScene scene = sensor();
  scene.tolerance = 1e-1;
  scene.drive = CreepDrive{{{0.0, 0.0}, {1e-2, 1e3}, {1.0, 1e3}}};
  scene.wanted = {"electrode_voltage_peak"};
  CHECK(std::get<PillarScene>(plan_effects(scene).reduced).electrodes.has_value());
  scene.wanted = {"top_displacement"};
  CHECK_FALSE(std::get<PillarScene>(plan_effects(scene).reduced).electrodes.has_value());
}
