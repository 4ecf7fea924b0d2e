// Answers to first order that reuse one solution (eq. 26), against answers of their own.
#include "models/pillar/analyses/analysis.h"
#include "models/pillar/analyses/simulate_pillar.h"
#include "models/pillar/body/pillar_model.h"
#include "models/pillar/body/pillar_modes.h"
#include "models/pillar/body/stress_energy.h"
#include "models/pillar/system/stiffness_factor.h"
#include "tests/models/pillar/analyses/first_order_check.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace viscard;
using namespace viscard::test;

TEST_CASE("derivatives of a sensor from one solution agree with differences of its answers",
          "[pillar][gradient]") {
  PillarScene scene = sensor();
  SECTION("with an electrode on the bottom's face or the top's, smaller or wider than the pillar") {
    scene.electrodes->grounded = GENERATE(FilmFace::kBottom, FilmFace::kTop);
    scene.electrodes->electrode_radius_m = GENERATE(18e-6, 33e-6);
  }
  SECTION("with a charge-free face") {
    scene.electrodes->electrode_radius_m = 0.0;
    scene.electrodes->grounded = FilmFace::kTop;
  }
  SECTION("driven by a voltage") {
    std::get<StaticDrive>(scene.drive).drive_V = 10.0;
  }
  SECTION("whose top is moved") {
    std::get<StaticDrive>(scene.drive) = StaticDrive{.displacement_m = -1e-6};
  }
  SECTION("with quadrants, under a shear") {
    std::get<StaticDrive>(scene.drive) =
        StaticDrive{.direction = LoadDirection::kLateral, .pressure_Pa = 1e3};
    scene.electrodes->quadrants = true;
  }
  SECTION("of a nearly incompressible pillar") {
    scene.pillar.nu = GENERATE(0.47, 0.4899);
  }
  check_derivatives(scene);
}

TEST_CASE("derivatives of displacements and stresses from one solution agree with differences",
          "[pillar][gradient]") {
  PillarScene scene = without_film();
  SECTION("of a pillar on a rigid base") {}
  SECTION("of a nearly incompressible pillar with a fillet, whose elements are stretched") {
    scene.pillar.nu = 0.4899;
    scene.geometry.foot = {4e-6, 6e-6};
  }
  SECTION("of a strip") {
    scene.plane = GENERATE(PlaneState::kStrain, PlaneState::kStress);
  }
  SECTION("of a pillar on an elastic film") {
    scene = sensor();
    scene.electrodes.reset();
  }
  check_derivatives(scene);
}

TEST_CASE("derivatives of frequencies are those of the Rayleigh quotients of the modes",
          "[pillar][gradient]") {
  PillarScene scene = GENERATE(true, false) ? sensor() : without_film();
  scene.electrodes.reset();
  scene.pillar.nu = GENERATE(0.33, 0.48);
  scene.drive = ModalDrive{.modes = 2};
  scene.discretisation = kMesh;
  check_derivatives(scene);
}

TEST_CASE(
    "an incompressible pillar has derivatives by its moduli from one solution, not by lengths",
    "[pillar][gradient]") {
  PillarScene scene = sensor();
  scene.pillar.nu = 0.5;
  check_derivatives(scene, /*lengths_too=*/false);
  const FirstOrderAnswers first_order = first_order_answers(scene, kMesh);
  PillarScene other = scene;
  other.pillar.E0_Pa *= 1.001;
  CHECK(first_order(other));
  other.geometry.length_m *= 1.001;
  CHECK_FALSE(first_order(other));
}

TEST_CASE("a scene has no first-order answer where the elements change or the analysis has none",
          "[pillar][gradient]") {
  PillarScene scene = sensor();
  scene.electrodes->electrode_radius_m = 20e-6;  // the edge is the rim
  const FirstOrderAnswers first_order = first_order_answers(scene, kMesh);
  REQUIRE(first_order(scene));
  PillarScene wider = scene;
  wider.geometry.diameter_m *= 1.001;
  CHECK_FALSE(first_order(wider));
  PillarScene condensed = scene;
  condensed.pillar.nu = 0.46;  // pressures are condensed from 0.45 on
  CHECK_FALSE(first_order(condensed));
  PillarScene between = scene;
  between.pillar.nu = 0.4999995;  // answered from two other scenes
  CHECK_FALSE(first_order_answers(between, kMesh));
  PillarScene one_way = scene;
  one_way.one_way_potential = true;
  CHECK_FALSE(first_order_answers(one_way, kMesh));
  PillarScene sweep = without_film();
  sweep.drive = HarmonicDrive{.pressure_Pa = 1e3};
  for (int i = 1; i <= 20; ++i) {
    as<HarmonicDrive>(sweep).frequencies_Hz.push_back(1e3 * i);  // not solved one by one
  }
  CHECK_FALSE(first_order_answers(sweep, kMesh));
}

TEST_CASE("a form applied to a vector is its matrix times the vector", "[pillar]") {
  PillarScene scene = sensor();
  scene.pillar.nu = 0.48;
  scene.geometry.foot = {4e-6, 6e-6};
  const PillarModel model = electric_model_of(scene, Motion::kLongitudinal, kMesh);
  Eigen::VectorXd u(model.system().size());
  for (Eigen::Index i = 0; i < u.size(); ++i) u[i] = std::sin(1.0 + static_cast<double>(i));
  const Eigen::VectorXd expected = times(model.stiffness(), u);
  CHECK((model.stiffness_times(u, u) - expected).norm() <= 1e-13 * expected.norm());
  const Eigen::VectorXd mass = times(model.mass(), u);
  CHECK((model.mass_times(u) - mass).norm() <= 1e-13 * mass.norm());
}

TEST_CASE("the work of a stress on a motion is that of its matrix", "[pillar]") {
  PillarScene scene = without_film();
  scene.pillar.nu = GENERATE(0.33, 0.48);
  scene.geometry.foot = {4e-6, 6e-6};
  const PillarModel axial = model_of(scene, Motion::kLongitudinal, kMesh);
  const PillarModel lateral = model_of(scene, Motion::kLateral, kMesh);
  Eigen::VectorXd u(lateral.system().size());
  for (Eigen::Index i = 0; i < u.size(); ++i) u[i] = std::sin(1.0 + static_cast<double>(i));
  const double expected = u.dot(times(stress_stiffness_per_Pa(axial, lateral), u));
  CHECK(StressEnergy(axial).per_Pa(lateral, u) == Approx(expected).epsilon(1e-11));  // rounding
}
