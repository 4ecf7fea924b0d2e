#include "models/array/space/foot_forces.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

namespace viscard {
namespace {

constexpr double kRadius_m = 20e-6;
constexpr double kLength_m = 120e-6;
const double kArea_m2 = std::numbers::pi * kRadius_m * kRadius_m;

FootForces foot_of(double nu, int degree, int layers) {
  return foot_forces(PillarGeometry{}, isotropic_medium(1.8e6, nu, 965.0),
                     {.degree = degree, .layers = layers});
}

double moment(const Eigen::VectorXd& forces, const std::vector<double>& radius_m) {
  return forces.dot(Eigen::Map<const Eigen::VectorXd>(radius_m.data(), forces.size()));
}

TEST_CASE("the foot of a pillar carries force and moment of the load", "[models]") {
  for (const double nu : {0.0, 0.33, 0.49, 0.5}) {
    const FootForces foot = foot_of(nu, 5, 2);
    INFO("nu " << nu);
    CHECK(foot.pressure.z.sum() == Approx(-kArea_m2).epsilon(1e-9));
    // A motion u_x = 1 is a = 0, b = 2; a tilt u_z = x is w = r.
    CHECK(2.0 * foot.shear.b.sum() == Approx(kArea_m2).epsilon(1e-9));
    CHECK(moment(foot.shear.w, foot.radius_m) == Approx(-kArea_m2 * kLength_m).epsilon(1e-9));
    // Within 1e-9 of zero, beside the same moment with a shear.
    CHECK(2.0 * foot.tilt.b.sum() == Approx(0.0).margin(1e-9 * kArea_m2));
    CHECK(moment(foot.tilt.w, foot.radius_m) == Approx(0.25 * kArea_m2 * kRadius_m).epsilon(1e-9));
  }
}

TEST_CASE("the transforms of the foot begin with its force and moment", "[models]") {
  const FootForces foot = foot_of(0.33, 5, 2);
  const double k_1_m = 1e-3 / kRadius_m;
  const AxialTransform pressure = transform(foot.pressure, foot.radius_m, k_1_m);
  CHECK(pressure.t_z == Approx(-kArea_m2).epsilon(1e-5));
  const SidewaysTransform shear = transform(foot.shear, foot.radius_m, k_1_m);
  CHECK(2.0 * shear.along == Approx(kArea_m2).epsilon(1e-5));
  CHECK(2.0 * shear.across == Approx(kArea_m2).epsilon(1e-5));
  // t_z = -i k_x M for small k.
  CHECK(2.0 * shear.normal == Approx(-kArea_m2 * kLength_m * k_1_m).epsilon(1e-5));
}

TEST_CASE("the top of a pillar on a rigid base moves as converged elements move", "[models]") {
  const FootForces foot = foot_of(0.33, 8, 4);
  // Fourier p-elements of another program, degree 8 with four layers, on a film of 2 GPa, which makes
  // them up to 3e-4 softer.
  CHECK(foot.sinking_m_Pa == Approx(6.59692e-11).epsilon(1e-5));
  CHECK(foot.sideways_by_shear_m_Pa == Approx(3.32720e-9).epsilon(4e-4));
  CHECK(std::abs(foot.sideways_by_tilt_m_Pa) == Approx(1.97046e-10).epsilon(3e-4));
  CHECK(std::abs(foot.tilt_by_shear_1_Pa) == Approx(3.94093e-5).epsilon(3e-4));
  CHECK(foot.tilt_by_tilt_1_Pa == Approx(3.30634e-6).epsilon(1e-4));
  // Reciprocity: a moment pi R^3/4 per Pa against a force pi R^2.
  CHECK(foot.sideways_by_tilt_m_Pa ==
        Approx(0.25 * kRadius_m * foot.tilt_by_shear_1_Pa).epsilon(1e-9));
}

TEST_CASE("transforms of the foot converge twice as fast as its stress", "[models][convergence]") {
  const double k_1_m = 4.0 / 25e-6;
  const auto at = [&](int degree, int layers) {
    const FootForces foot = foot_of(0.33, degree, layers);
    return transform(foot.pressure, foot.radius_m, k_1_m);
  };
  const AxialTransform exact = at(10, 5);
  const double size = std::hypot(exact.t_z, exact.tau_x);
  double last = 1.0;
  for (const auto& [degree, layers] : {std::pair{3, 1}, {4, 2}, {6, 3}, {8, 4}}) {
    const AxialTransform now = at(degree, layers);
    const double error = std::hypot(now.t_z - exact.t_z, now.tau_x - exact.tau_x) / size;
    // One more layer of ratio 0.15 leaves 0.15^(2 lambda) = 0.07 of what a corner of lambda = 0.692
    // leaves; a quarter is asked.
    CHECK(error < 0.25 * last);
    last = error;
  }
  CHECK(last < 1e-4);
}

TEST_CASE("a pillar with a film is refused where a rigid base is meant", "[models]") {
  PillarGeometry on_film;
  on_film.film = FilmGeometry{25e-6, 60e-6};
  CHECK_THROWS_WITH(foot_forces(on_film, isotropic_medium(1.8e6, 0.33, 965.0), {}),
                    Catch::Contains("without a film"));
}

}  // namespace
}  // namespace viscard
