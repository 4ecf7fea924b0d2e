// The collapse of pillars that are not straight, against the elastica.
#include "models/pillar/analyses/bowed_pillar.h"
#include "models/scene/simulate.h"
#include "tests/models/pillar/drive_as.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace viscard;
using Catch::Matchers::Contains;
using viscard::test::as;

namespace {

constexpr double kPi = std::numbers::pi;

PillarScene slender_pillar() {
  PillarScene scene;
  scene.geometry.diameter_m = 20e-6;
  scene.geometry.length_m = 1000e-6;
  scene.pillar.E0_Pa = 1e6;
  scene.pillar.nu = 0.0;
  scene.drive = BucklingDrive{};
  scene.tolerance = 1e-3;
  return scene;
}

}  // namespace

TEST_CASE("a bent elastica has the loads and offsets of its elliptic integrals", "[pillar]") {
  // Top turned by alpha: p = sin(alpha/2), P/P_cr = (2 K(p)/pi)^2, offset 2 p/K. Source: Timoshenko & Gere, 2.7.
  const double alpha = GENERATE(1e-3, 20.0, 40.0, 80.0, 120.0) * kPi / 180.0;
  const double p = std::sin(0.5 * alpha), K = std::comp_ellint_1(p);
  const BentElastica bent = bent_elastica(2.0 * p * K, 1e-12);
  CHECK(bent.load_share == Approx(std::pow(2.0 * K / kPi, 2)).epsilon(2e-7));
  CHECK(bent.offset == Approx(2.0 * p / K).epsilon(2e-7));
}

TEST_CASE("a small bow grows as 1/(1 - P/P_cr)", "[pillar]") {
  const double bow = 1e-4;
  for (const double curvature : {1e-6, 1e-4, 1e-3}) {
    const BentElastica bent = bent_elastica(curvature, bow);
    CHECK(bent.offset == Approx(bow / (1.0 - bent.load_share)).epsilon(1e-5));
  }
}

TEST_CASE("at the collapse of a bowed pillar its foot has the strain asked for", "[pillar]") {
  const PillarScene scene = slender_pillar();
  const double bow_m = GENERATE(1e-6, 20e-6, 300e-6), strain = GENERATE(2e-4, 2e-3, 6e-3);
  const double euler_Pa = euler_pressure_Pa(scene, TopEnd::kFree);
  const Collapse found = collapse(scene, euler_Pa, bow_m, strain);
  CHECK(found.pressure_Pa / 1e6 * (1.0 + 4.0 * found.offset_m / 10e-6) == Approx(strain));
  CHECK(found.offset_m > bow_m);
  CHECK(found.left_out < 1e-3);
}

TEST_CASE(
    "a pillar with hardly a bow collapses where it buckles, and a stubby one where it is crushed",
    "[pillar][stability]") {
  PillarScene scene = slender_pillar();
  const double euler_Pa = euler_pressure_Pa(scene, TopEnd::kFree);
  CHECK(collapse(scene, euler_Pa, 1e-15, 1e-3).pressure_Pa == Approx(euler_Pa).epsilon(2e-3));
  CHECK(collapse(scene, 1e9, 1e-9, 0.1).pressure_Pa ==
        Approx(0.1 * 1e6 / (1.0 + 4.0 * 1e-9 / 10e-6)).epsilon(1e-3));
  for (double bow_m = 1e-18; bow_m < 4e-4; bow_m *= 10.0) {
    const Collapse one = collapse(scene, euler_Pa, bow_m, 1e-2);
    CAPTURE(bow_m);
    CHECK(std::isfinite(one.pressure_Pa));
    CHECK(one.offset_m >= bow_m);
  }
}

TEST_CASE("a larger bow collapses earlier, and its scene states so", "[pillar][plan]") {
  PillarScene scene = slender_pillar();
  scene.geometry.length_m = 120e-6;
  scene.pillar.nu = 0.33;
  const double straight_Pa = simulate(scene).results.front().value;
  double before_Pa = straight_Pa;
  as<BucklingDrive>(scene).collapse_strain = 0.01;
  for (const double bow_m : {0.1e-6, 1e-6, 3e-6}) {
    as<BucklingDrive>(scene).bow_m = bow_m;
    const SceneAnswer answer = simulate(scene);
    REQUIRE(answer.results.size() == 3);
    CHECK(answer.results[1].name == "collapse_pressure");
    CHECK(answer.results[1].value < before_Pa);
    CHECK(answer.results[1].error_estimate > 0.0);
    CHECK(answer.results[2].value > bow_m);
    before_Pa = answer.results[1].value;
  }
  as<BucklingDrive>(scene).bow_m = 70e-6;
  CHECK_THROWS_WITH(simulate(scene), Contains("half the pillar"));
}

TEST_CASE("a strain that a slender pillar never reaches is refused with the one it reaches",
          "[pillar]") {
  PillarScene scene = slender_pillar();
  scene.geometry.length_m = 1200e-6;
  as<BucklingDrive>(scene) = BucklingDrive{.bow_m = 1e-6};
  CHECK_THROWS_WITH(simulate(scene), Contains("when the top points downward"));
}
