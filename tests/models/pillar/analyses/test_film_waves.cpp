// Voltages of a film under waves in a pillar whose shapes change as it relaxes.
#include "models/pillar/analyses/simulate_pillar.h"
#include "models/pillar/scene/pillar_scene.h"
#include "tests/models/pillar/analyses/answer_of.h"
#include "tests/models/pillar/drive_as.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <string>

using namespace viscard;
using namespace viscard::test;

namespace {

// A pulse on a pillar whose shear modulus relaxes twice as much as its bulk modulus, within the
// pulse and after it.
PillarScene pulse_on_film() {
  PiezoMatrix charge = PiezoMatrix::Zero();
  charge(2, 0) = charge(2, 1) = 23e-12;
  charge(2, 2) = -33e-12;
  PillarScene scene;
  scene.geometry.film = FilmGeometry{.thickness_m = 25e-6, .radius_m = 60e-6};
  scene.film = piezo_medium(isotropic_medium(3e9, .3, 1780.0).stiffness_Pa, charge,
                            12.0 * kVacuumPermittivity_F_m * Eigen::Matrix3d::Identity(), 1780.0);
  scene.electrodes = ElectrodeOptions{FilmFace::kBottom, 20e-6};
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = .33;
  scene.pillar.rho_kg_m3 = 965.0;
  scene.pillar.terms = {{.2, .1, 2e-6}, {.2, .1, 2e-5}};
  TransientDrive drive;
  drive.end_time_s = 1e-4;
  drive.outputs = 400;
  for (int i = 0; i <= 32; ++i) {  // half a sine of 10 us
    drive.history.push_back({1e-5 * i / 32, 1e3 * std::sin(std::numbers::pi * i / 32)});
  }
  drive.history.push_back({drive.end_time_s, 0.0});
  scene.drive = drive;
  return scene;
}

SceneAnswer answer_at(double tolerance) {
  PillarScene scene = pulse_on_film();
  scene.tolerance = tolerance;
  return simulate_pillar(scene);
}

}  // namespace

TEST_CASE("voltages of a film under a pulse agree with a finer answer, point by point",
          "[pillar][convergence]") {
  const SceneAnswer answer = answer_at(2e-2);
  const SceneAnswer finer = answer_at(6e-3);
  CHECK(answer.largest_relative_error <= 2e-2);
  CHECK(answer.discretisation.degree <= 6);  // no basis that differs from mesh to mesh
  for (const std::string name : {"electrode_voltage", "electrode_voltage_spectrum"}) {
    const SceneCurve& mine = curve_of(answer, name);
    const SceneCurve& exact = curve_of(finer, name);
    REQUIRE(mine.value.size() == exact.value.size());
    for (std::size_t i = 0; i < mine.value.size(); ++i) {
      CAPTURE(name, i, mine.x[i], mine.value[i], exact.value[i]);
      CHECK(std::abs(mine.value[i] - exact.value[i]) <= mine.error[i] + exact.error[i]);
    }
  }
  const SceneResult& peak = result_of(answer, "electrode_voltage_peak");
  CHECK(std::abs(peak.value - value_of(finer, "electrode_voltage_peak")) <= peak.error_estimate);
}
