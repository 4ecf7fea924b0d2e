// A half-space under a disc of pressure: a body so large that its far edge has no influence.
#include "tests/models/pillar/system/small_body.h"

#include <catch2/catch.hpp>

#include <numbers>
#include <vector>

using namespace viscard;
using namespace viscard::test;

namespace {

constexpr double kPi = std::numbers::pi;

// Elements that shrink toward `a` = 1 from both sides and grow by three toward `far` outside.
std::vector<double> radii(double far) {
  std::vector<double> x = graded_breaks(0.0, 1.0, 5, 0.15, true);
  x.insert(x.begin() + 1, 0.4);
  for (const double at : graded_breaks(1.0, 2.0, 5, 0.15, false)) {
    if (at > 1.0) x.push_back(at);
  }
  while (x.back() < far) x.push_back(3.0 * x.back());
  return x;
}

// Depths, ascending to the surface z = 0, with the finest elements there.
std::vector<double> heights(double far) {
  std::vector<double> depth = graded_breaks(0.0, 1.0, 5, 0.15, false);
  while (depth.back() < far) depth.push_back(3.0 * depth.back());
  std::vector<double> z;
  for (const double d : depth) z.insert(z.begin(), -d);
  return z;
}

}  // namespace

TEST_CASE("a half-space sinks by 2(1-nu^2)pa/E under a pressed disc, by 2/pi of that at the rim",
          "[pillar]") {
  // w(0) = 2 (1 - nu^2) p a/E, w(a) = 4 (1 - nu^2) p a/(pi E), mean over the disc
  // 16 (1 - nu^2) p a/(3 pi E). Johnson, Contact Mechanics (1985), 3.4. The edge of the body is
  // held 3^14 radii away, with an error of 1/3^14.
  const double nu = GENERATE(0.0, 0.33, 0.49);
  SmallBody body(kinematics_of(Motion::kLongitudinal), radii(4e6), heights(4e6), 7);
  const double far = body.section().x().breaks().back();
  const double deep = body.section().z().breaks().front();
  for (const int field : {0, 1}) {
    body.hold(field, x_is(far));
    body.hold(field, z_is(deep));
  }
  body.hold(0, x_is(0.0));
  body.done();
  SymmetricSparse stiffness = body.stiffness(isotropic_moduli_Pa(1.0, nu));
  const Eigen::VectorXd load = body.top_load(1, [](double r) { return r < 1.0 ? 1.0 : 0.0; });
  CHECK(load.sum() == Approx(kPi).epsilon(1e-12));  // rounding
  const Eigen::VectorXd u = solve(stiffness, load);
  const double w = 1.0 - nu * nu;
  CAPTURE(nu, body.system().size());
  CHECK(body.value_at(u, 1, 0.0, 0.0) == Approx(2.0 * w).epsilon(2e-6));
  CHECK(load.dot(u) / kPi == Approx(16.0 * w / (3.0 * kPi)).epsilon(2e-6));
  // The slope is infinite at the rim, which the layers there resolve to 1e-5.
  CHECK(body.value_at(u, 1, 1.0, 0.0) == Approx(4.0 * w / kPi).epsilon(2e-5));
}
