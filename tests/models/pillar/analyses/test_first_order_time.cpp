// Answers to first order that reuse one solution (eq. 26), for eigenvalues under a stress and for motions in
// time and over frequency.
#include "models/pillar/analyses/simulate_pillar.h"
#include "tests/models/pillar/analyses/first_order_check.h"

#include <catch2/catch.hpp>

using namespace viscard;
using namespace viscard::test;

namespace {

// Derivatives on one mesh agree on any.
const Discretisation kSmall{.degree = 4, .layers = 1};

// One result by diameter, length, modulus and density: a test that compares fewer checks nothing.
constexpr int kFewest = 4;

// The pillar creeps more in shear than in volume, so that the shape of its solutions relaxes.
PillarScene relaxing(PillarScene scene) {
  scene.pillar.terms = {{0.3, 0.1, 0.2}, {0.2, 0.2, 2.4}};
  scene.tolerance = 1e-6;  // differences of whole answers are judged to 1e-5
  return scene;
}

Course ramp(double value) {
  return {{0.0, 0.0}, {2.0, value}};
}

}  // namespace

TEST_CASE("derivatives of a buckling pressure are those of its Rayleigh quotient and its stress",
          "[pillar][gradient]") {
  PillarScene scene = GENERATE(true, false) ? sensor() : without_film();
  scene.electrodes.reset();
  scene.pillar.nu = GENERATE(0.33, 0.48);
  scene.drive = BucklingDrive{};
  CHECK(check_derivatives(scene, /*lengths_too=*/true, kSmall) >= kFewest);
}

TEST_CASE("an incompressible pillar has derivatives of its buckling pressure by its modulus alone",
          "[pillar][gradient]") {
  PillarScene scene = without_film();
  scene.pillar.nu = 0.5;
  scene.drive = BucklingDrive{};
  CHECK(check_derivatives(scene, /*lengths_too=*/false, kSmall) >= kFewest);
}

TEST_CASE("derivatives of frequencies under a pressure follow the stress too",
          "[pillar][gradient]") {
  PillarScene scene = GENERATE(true, false) ? sensor() : without_film();
  scene.electrodes.reset();
  scene.drive = ModalDrive{.modes = 1, .pressure_Pa = 1e4};
  scene.discretisation = kSmall;
  CHECK(check_derivatives(scene, /*lengths_too=*/true, kSmall) >= kFewest);
}

TEST_CASE("derivatives of damped modes are those of their complex Rayleigh quotients",
          "[pillar][gradient]") {
  PillarScene scene = relaxing(GENERATE(true, false) ? sensor() : without_film());
  for (MaterialTerm& term : scene.pillar.terms) term.tau_s *= 1e-4;  // near the periods
  scene.electrodes.reset();
  scene.drive = ModalDrive{.modes = 1, .pressure_Pa = GENERATE(0.0, 5e3)};
  scene.discretisation = kSmall;
  CHECK(check_derivatives(scene, /*lengths_too=*/true, kSmall) >= kFewest);
}

TEST_CASE("derivatives in creep and relaxation come from one reduced basis", "[pillar][gradient]") {
  PillarScene scene = relaxing(sensor());
  SECTION("of a sensor with an electrode in creep") {
    scene.drive = CreepDrive{.history = ramp(1e3)};
  }
  SECTION("of a sensor with a readout in creep") {
    scene.drive = CreepDrive{.history = ramp(1e3)};
    scene.tolerance = 1e-4;
    scene.readout = Readout{.resistance_Ohm = 1e13, .capacitance_F = 15e-15};
  }
  SECTION("of a sensor with a charge-free face in relaxation") {
    scene.drive = RelaxationDrive{.history = ramp(1e-6)};
    scene.electrodes->electrode_radius_m = 0.0;
    scene.electrodes->grounded = FilmFace::kTop;
  }
  SECTION("of a pillar without a film in relaxation") {
    scene = relaxing(without_film());
    scene.pillar.nu = 0.48;
    scene.drive = RelaxationDrive{.history = ramp(1e-6)};
  }
  CHECK(check_derivatives(scene, /*lengths_too=*/true, kSmall) >= kFewest);
}

TEST_CASE("an incompressible pillar in creep has derivatives by its moduli, not by lengths",
          "[pillar][gradient]") {
  PillarScene scene = relaxing(sensor());
  scene.pillar.nu = 0.5;
  scene.drive = CreepDrive{.history = ramp(1e3)};
  CHECK(check_derivatives(scene, /*lengths_too=*/false, kSmall) >= kFewest);
}

TEST_CASE("derivatives at a few frequencies come from their solutions and dual solutions",
          "[pillar][gradient]") {
  PillarScene scene = relaxing(sensor());
  for (MaterialTerm& term : scene.pillar.terms) term.tau_s *= 1e-4;
  scene.discretisation = kSmall;
  SECTION("of a sensor pressed on its top") {
    scene.drive = HarmonicDrive{.pressure_Pa = 1e3, .frequencies_Hz = {5e4}};
  }
  SECTION("of quadrants under a shear") {
    scene.drive = HarmonicDrive{
        .direction = LoadDirection::kLateral, .pressure_Pa = 1e3, .frequencies_Hz = {3e4}};
    scene.electrodes->quadrants = true;
  }
  CHECK(check_derivatives(scene, /*lengths_too=*/true, kSmall) >= kFewest);
}
