// Orders of convergence of the discretisations, not only small errors.
#include "models/pillar/body/pillar_modes.h"
#include "tests/support/convergence.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace viscard;

namespace {

const PillarMedia kSoft{isotropic_medium(1.8e6, .33, 965.0), std::nullopt};

double top_m(const Discretisation& mesh) {
  const PillarModel model({}, mesh, kSoft, {});
  const Eigen::VectorXd traction = model.top_traction();
  return -traction.dot(model.solve(-1e4 * traction).unknowns) / traction.sum();
}

constexpr double kTop_m = 659.692e-9;  // converged with two orders of an independent program

}  // namespace

TEST_CASE("frequencies of smooth modes converge with twice the degree in h",
          "[pillar][convergence]") {
  // Strang & Fix, An Analysis of the Finite Element Method (1973), ch. 6: h^(2p).
  const int degree = GENERATE(1, 2, 3);
  const double exact_Hz = std::sqrt(1.8e6 / 2.66 / 965.0) / (4.0 * 120e-6);  // torsion
  const auto error = [&](double size_m) {
    const PillarModel model({}, {.degree = degree, .uniform_m = size_m}, kSoft,
                            {.motion = Motion::kTorsion});
    return lowest_modes(model, 1).front().frequency_Hz / exact_Hz - 1.0;
  };
  const std::vector<double> orders = test::observed_orders(error, degree == 3 ? 60e-6 : 20e-6, 3);
  CAPTURE(orders);
  CHECK(orders.back() == Approx(2.0 * degree).margin(0.1));
}

TEST_CASE("the rim of the bond limits uniform meshes of any degree to h^1.4",
          "[pillar][convergence]") {
  // Energy error h^(2 lambda) with the corner's exponent lambda = 0.692 at nu = 0.33 (clamped-free
  // 90 degrees; Williams, J. Appl. Mech. 19 (1952) 526).
  const int degree = GENERATE(1, 2, 4);
  const auto error = [&](double size_m) {
    return std::abs(top_m({.degree = degree, .uniform_m = size_m}) / kTop_m - 1.0);
  };
  const std::vector<double> orders = test::observed_orders(error, degree == 1 ? 2.5e-6 : 10e-6, 3);
  CAPTURE(orders);
  CHECK(orders.back() == Approx(2.0 * .692).margin(degree == 1 ? 0.25 : 0.12));
}

TEST_CASE("grading and degree together converge exponentially", "[pillar][convergence]") {
  // Geometric layers with rising degree: error falls by a factor per degree (Szabo & Babuska, ch.
  // 6).
  std::vector<double> errors;
  for (const int degree : {2, 3, 4, 5, 6}) {
    errors.push_back(std::abs(top_m({.degree = degree, .layers = degree - 1}) / kTop_m - 1.0));
  }
  CAPTURE(errors);
  for (std::size_t i = 1; i < errors.size(); ++i) CHECK(errors[i] < 0.45 * errors[i - 1]);
  CHECK(errors.back() < 2e-6);  // the reference's own digits
}
