// Creep and relaxation of a pillar on a piezoelectric film: what the reduced basis leaves out.
#include "models/pillar/analyses/simulate_pillar.h"
#include "models/pillar/body/piezo_static.h"
#include "models/pillar/time/model_reduction.h"
#include "models/pillar/time/viscoelastic_pillar.h"
#include "tests/models/pillar/analyses/answer_of.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>

using namespace viscard;
using namespace viscard::test;

namespace {

const Discretisation kMesh{.degree = 5, .layers = 2};
const Course kHeld = {{0.0, 0.0}, {0.0, 1.0}, {10.0, 1.0}, {10.0, 0.0}, {30.0, 0.0}};

// A pillar of PDMS on a film of PVDF that carries an electrode.
PillarScene sensor(bool shear_only) {
  PillarScene scene;
  scene.pillar.E0_Pa = 1.8e6;
  scene.pillar.nu = 0.33;
  scene.pillar.terms = {{0.5, shear_only ? 0.0 : 0.5, 0.2}, {0.3, shear_only ? 0.0 : 0.3, 2.4}};
  scene.geometry.film = FilmGeometry{25e-6, 60e-6};
  PiezoMatrix d = PiezoMatrix::Zero();
  d.row(2) << 23e-12, 23e-12, -33e-12, 0, 0, 0;
  scene.film_charge_C_N = d;
  scene.film = piezo_medium(isotropic_moduli_Pa(2e9, 0.29), d,
                            12.0 * kVacuumPermittivity_F_m * Eigen::Matrix3d::Identity(), 1780.0);
  scene.electrodes = ElectrodeOptions{FilmFace::kTop, 20e-6};
  return scene;
}

// Largest difference of a curve to a finer one, over its largest value, to which its errors are relative.
double difference(const SceneCurve& one, const SceneCurve& fine) {
  REQUIRE(one.x == fine.x);
  double largest = 0.0, size = 0.0;
  for (std::size_t i = 0; i < one.x.size(); ++i) {
    largest = std::max(largest, std::abs(one.value[i] - fine.value[i]));
    size = std::max(size, std::abs(fine.value[i]));
  }
  return largest / size;
}

}  // namespace

TEST_CASE(
    "voltages and displacements in creep and relaxation err by no more than their steps state",
    "[pillar]") {
  PillarScene scene = sensor(GENERATE(true, false));
  scene.electrodes->electrode_radius_m = GENERATE(20e-6, 0.0);
  const bool is_creep = GENERATE(true, false);
  Course history = kHeld;
  for (CoursePoint& point : history) point.value *= is_creep ? 1e4 : 1e-6;
  if (is_creep) {
    scene.drive = CreepDrive{.history = history};
  } else {
    scene.drive = RelaxationDrive{.history = history};
  }
  scene.tolerance = 1e-2;
  const SceneAnswer coarse = pillar_answer_on(scene, kMesh);
  scene.tolerance = 1e-6;
  const SceneAnswer fine = pillar_answer_on(scene, kMesh);
  REQUIRE(coarse.curves.size() == 2);
  CHECK(coarse.step_error < 1e-3);
  CHECK(fine.step_error < 1e-7);
  for (std::size_t c = 0; c < coarse.curves.size(); ++c) {
    const double found = difference(coarse.curves[c], fine.curves[c]);
    CAPTURE(coarse.curves[c].name, found, coarse.step_error);
    CHECK(found <= coarse.step_error);
  }
}

TEST_CASE(
    "a sweep's voltages agree with frequencies solved one by one within what the basis states",
    "[pillar]") {
  PillarScene scene = sensor(GENERATE(true, false));
  scene.pillar.rho_kg_m3 = 965.0;
  for (MaterialTerm& term : scene.pillar.terms) term.tau_s *= 1e-4;
  scene.discretisation = kMesh;
  scene.tolerance = 1e-2;
  HarmonicDrive drive{.pressure_Pa = 1e3};
  for (int i = 0; i < 20; ++i) drive.frequencies_Hz.push_back(1e2 * std::pow(10.0, 3.4 * i / 19.0));
  scene.drive = drive;
  const SceneAnswer sweep = pillar_answer_on(scene, kMesh);
  drive.frequencies_Hz.clear();
  for (std::size_t i = 0; i < 20; i += 2)
    drive.frequencies_Hz.push_back(sweep.curves.at(0).x.at(i));
  scene.drive = drive;
  const SceneAnswer direct = pillar_answer_on(scene, kMesh);
  for (const char* const name : {"electrode_voltage", "top_displacement"}) {
    for (std::size_t i = 0; i < drive.frequencies_Hz.size(); ++i) {
      const auto at = [&](const SceneAnswer& answer, std::size_t k) {
        return std::complex<double>(curve_of(answer, std::string(name) + "_real").value[k],
                                    curve_of(answer, std::string(name) + "_imaginary").value[k]);
      };
      const std::complex<double> expected = at(direct, i);
      // The tolerance is relative to this, which near a pole counts the change with frequency.
      const double size = curve_of(sweep, std::string(name) + "_real").allowed.at(2 * i);
      const double found = std::abs(at(sweep, 2 * i) - expected) / size;
      CAPTURE(name, drive.frequencies_Hz[i], found, sweep.step_error);
      CHECK(found <= sweep.step_error);
    }
  }
}

TEST_CASE("an output of a film's potential has the same value as a function of the motion alone",
          "[pillar]") {
  const PillarScene scene = sensor(true);
  const PillarModel model(
      with_electrode_edge(scene.geometry, scene.electrodes), kMesh,
      {isotropic_medium(scene.pillar.E0_Pa, scene.pillar.nu, 965.0), scene.film},
      {.electrodes = scene.electrodes});
  ViscoelasticSystem body = viscoelastic_system(model, scene.pillar, false);
  const Eigen::VectorXd voltage =
      Eigen::VectorXd::Unit(model.system().size(), model.electrode_dof());
  const Eigen::VectorXd of_motion = output_of_motion(body, voltage);
  CHECK(of_motion[model.electrode_dof()] == 0.0);
  const Eigen::VectorXd u = model.solve(unit_top_force(model)).unknowns;
  CHECK(of_motion.dot(u) == Approx(voltage.dot(u)).epsilon(1e-9));  // rounding of small voltages
  CHECK(output_of_motion(body, unit_top_force(model)) == unit_top_force(model));
}
