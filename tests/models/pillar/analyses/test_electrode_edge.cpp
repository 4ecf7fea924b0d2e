// The potential varies as the root of the distance from an electrode's edge; elements shrink there.
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/simulate_pillar.h"
#include "models/pillar/mesh/pillar_mesh.h"
#include "tests/models/pillar/analyses/answer_of.h"
#include "tests/models/pillar/drive_as.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace viscard;

namespace {

PillarScene sensor(FilmFace grounded, double electrode_radius_m) {
  PillarScene scene;
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = 0.33;
  test::as<StaticDrive>(scene).pressure_Pa = 1e4;
  scene.geometry.film = FilmGeometry{25e-6, 60e-6};
  PiezoMatrix d = PiezoMatrix::Zero();
  d(2, 0) = d(2, 1) = 23e-12;
  d(2, 2) = -33e-12;
  scene.film = piezo_medium(isotropic_moduli_Pa(2e9, 0.29), d,
                            12.0 * kVacuumPermittivity_F_m * Eigen::Matrix3d::Identity(), 1780.0);
  scene.electrodes = ElectrodeOptions{grounded, electrode_radius_m};
  return scene;
}

double voltage_V(const PillarScene& scene, int degree, int layers) {
  SceneAnswer answer;
  answer.discretisation = mesh_sequence(scene.geometry).back();
  answer.discretisation.degree = degree;
  answer.discretisation.layers = layers;
  analysis_of(scene).run(scene, answer);
  for (const SceneResult& r : answer.results) {
    if (r.name == "electrode_voltage") return r.value;
  }
  throw std::runtime_error("no voltage");
}

}  // namespace

TEST_CASE("voltages of electrodes off the rim converge as those at the rim do",
          "[pillar][convergence]") {
  const FilmFace grounded = GENERATE(FilmFace::kTop, FilmFace::kBottom);
  const PillarScene scene = sensor(grounded, 16e-6);
  CAPTURE(grounded == FilmFace::kTop);
  const double fine_V = voltage_V(scene, 8, 4);
  // 1.2e-4 and less; on meshes without layers at the edge it was 4.3e-4 and more.
  CHECK(voltage_V(scene, 6, 3) == Approx(fine_V).epsilon(2e-4));
  // The converged size, from meshes of degree 9 and 10 with up to seven layers at the edge.
  const double known_V = grounded == FilmFace::kTop ? 18.7109e-3 : 21.7880e-3;
  CHECK(std::abs(fine_V) == Approx(known_V).epsilon(4e-5));
}

TEST_CASE("a voltage's error contains the edge of its electrode on meshes of two layers",
          "[pillar][convergence]") {
  // An electrode between the rims of a pillar and of a thick film; the layers that meshes of degree 5
  // lack at its edge are four fifths of the error.
  PillarScene scene = sensor(FilmFace::kBottom, 90.9e-6);
  scene.tolerance = 1.28e-3;
  scene.geometry.diameter_m = 75.1e-6;
  scene.geometry.length_m = 144.4e-6;
  scene.geometry.film = FilmGeometry{69.4e-6, 111.6e-6};
  scene.pillar.E0_Pa = 1.904e6;
  scene.pillar.nu = 0.223;
  PiezoMatrix d = PiezoMatrix::Zero();
  d(2, 0) = d(2, 1) = -3.75e-12;
  d(2, 2) = 7.21e-12;
  scene.film = piezo_medium(isotropic_moduli_Pa(1.06e11, 0.385), d,
                            982.0 * kVacuumPermittivity_F_m * Eigen::Matrix3d::Identity(), 1780.0);
  scene.wanted = {"electrode_voltage"};
  const SceneResult result = test::result_of(simulate_pillar(scene), "electrode_voltage");
  const double fine_V = voltage_V(scene, 7, 4);  // to 1e-5, 1/40 of the error at degree 5
  CHECK(std::abs(result.value - fine_V) < result.error_estimate);
  CHECK(result.error_estimate < scene.tolerance * std::abs(fine_V));
}
