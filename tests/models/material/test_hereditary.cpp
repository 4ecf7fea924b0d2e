#include "models/material/hereditary.h"
#include "models/maths/branch_step.h"
#include "tests/support/printed_digits.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <stdexcept>

using namespace viscard;

namespace {
PronySeries pdms_1to10() {
  const double E0 = 1.88;
  return {E0 * (1.0 - 0.008206 - 0.01386), {{E0 * 0.008206, 0.1945}, {E0 * 0.01386, 2.403}}};
}
}  // namespace

TEST_CASE("phi functions keep every digit from zero to infinity", "[models][stability]") {
  CHECK(phi1(0.0) == 1.0);
  CHECK(phi2(0.0) == 0.5);
  CHECK(phi1(1e-12) == Approx(1.0 - 0.5e-12).epsilon(1e-15));
  CHECK(phi2(1e-12) == Approx(0.5).epsilon(1e-12));
  CHECK(phi1(1e12) == Approx(1e-12).epsilon(1e-15));
  CHECK(phi2(1e12) == Approx(1e-12).epsilon(1e-11));
  // Both forms of phi_2 meet at x = 1.
  CHECK(phi2(1.0) == Approx(phi2(std::nextafter(1.0, 2.0))).epsilon(1e-14));
  CHECK(phi2(1.0) == Approx(std::exp(-1.0)).epsilon(1e-14));  // (1 - (1 - 1/e))/1
}

TEST_CASE("ramp and hold gives the effective moduli of the closed form", "[models]") {
  // E_inf + sum E_i (tau_i/t_R)(1 - exp(-t_R/tau_i)) exp(-(t - t_R)/tau_i): 1.847789124 MPa for a 1
  // s ramp at t = 3 s, 1.843283901 for 5 s at 7 s (1:10 material).
  const auto effective = [](double ramp_s, double time_s, int steps) {
    HereditaryStress stress(pdms_1to10());
    for (int i = 1; i <= steps; ++i) stress.advance(ramp_s / steps, static_cast<double>(i) / steps);
    return stress.advance(time_s - ramp_s, 1.0);
  };
  const int steps = GENERATE(1, 7, 1000);
  CHECK(effective(1.0, 3.0, steps) == test::printed("1.847789124"));
  CHECK(effective(5.0, 7.0, steps) == test::printed("1.843283901"));
}

TEST_CASE("the recursion is exact for linear strain and any step", "[models][stability]") {
  const double dt_over_tau = GENERATE(1e-12, 1e-7, 1e-3, 1.0, 50.0, 1e6, 1e12);
  const PronySeries series{1.0, {{2.0, 1.0}}};
  HereditaryStress stress(series);
  for (int i = 1; i <= 200; ++i) stress.advance(dt_over_tau, i * dt_over_tau);
  const double time = 200 * dt_over_tau;
  CHECK(stress.stress_Pa() == Approx(time + 2.0 * -std::expm1(-time)).epsilon(2e-14));
}

TEST_CASE("a branch and its derivative by ln tau follow a polygon", "[models][gradient]") {
  const auto after = [](double tau_s) {
    BranchState state;
    for (const double dt_s : {0.0, 1e-9, 0.3, 2.0, 40.0}) {
      state.advance(BranchStep(dt_s, tau_s, /*with_slope=*/true), 1.0 + dt_s);
    }
    return state;
  };
  for (const double tau_s : {1e-3, 0.4, 30.0, 1e9}) {
    CAPTURE(tau_s);
    const double h = 1e-5;
    const double difference =
        (after(tau_s * std::exp(h)).value - after(tau_s * std::exp(-h)).value) / (2.0 * h);
    CHECK(after(tau_s).slope == Approx(difference).epsilon(1e-6).margin(1e-9));
  }
  StepsOfBranch steps(2.0);
  const double gain = steps.of(0.1).gain;
  CHECK(gain == phi1(0.05));
  CHECK(steps.of(0.1 * (1.0 + 1e-12)).gain == gain);  // read from text
  CHECK(steps.of(0.0).decay == 1.0);
}

TEST_CASE("a jump costs the instantaneous modulus", "[models]") {
  HereditaryStress stress(pdms_1to10());
  CHECK(stress.advance(0.0, 0.5) == Approx(0.5 * 1.88).epsilon(1e-15));
  CHECK_THROWS_AS(stress.advance(-1.0, 0.5), std::invalid_argument);
}

TEST_CASE("the implicit split reproduces the step it predicts", "[models]") {
  HereditaryStress stress(pdms_1to10());
  stress.advance(0.3, 0.2);
  const double dt_s = 0.05;
  const double predicted = stress.algorithmic_modulus_Pa(dt_s) * 0.7 + stress.carried_Pa(dt_s);
  CHECK(stress.advance(dt_s, 0.7) == Approx(predicted).epsilon(1e-14));
}
