#include "fit/curves/stage_model.h"
#include "fit/curves/stage_response.h"
#include "models/material/hereditary.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace viscard;

TEST_CASE("the response of a branch to a trapezoid equals that of fine steps", "[fit]") {
  const StageMove move{0.3, 0.0, 2e-4, 5e-4, 5e-3};
  const double tau_s = GENERATE(1e-3, 0.2, 30.0);
  const double from_s = GENERATE(0.0, 0.45);
  const StageResponse response(move, from_s);
  const auto branch = response.branch(tau_s);
  const double start_s = std::max(from_s, 0.3);
  for (const double t : {0.5, 0.78, 0.9, 3.0}) {
    // The recursion for linear pieces, with 200 000 of them.
    HereditaryStress fine({0.0, {{1.0, tau_s}}});
    constexpr int kSteps = 200000;
    for (int i = 1; i <= kSteps; ++i) {
      const double s = start_s + (t - start_s) * i / kSteps;
      fine.advance((t - start_s) / kSteps, position_m(move, s) - position_m(move, start_s));
    }
    // Linear pieces of 4e-6 s deviate from the parabola by 1e-9 of the displacement.
    CHECK(response.at(branch, t).value == Approx(fine.stress_Pa()).epsilon(1e-6).margin(1e-12));
  }
  CHECK(response.at(branch, 0.2).value == 0.0);
}

TEST_CASE("a slow branch follows the stage, and after the move decays as exp(-t/tau)",
          "[fit][reduction]") {
  const StageMove move{1.0, 1e-3, 1.2e-3, 1e-3, 0.2};
  const StageResponse response(move, 0.0);
  const auto slow = response.branch(1e12);
  CHECK(response.at(slow, 1.1).value == Approx(position_m(move, 1.1) - 1e-3).epsilon(1e-10));
  const auto fast = response.branch(0.1);
  const double end_s = response.end_s();
  const double q = response.at(fast, end_s).value;
  CHECK(response.at(fast, end_s + 0.25).value == Approx(q * std::exp(-2.5)).epsilon(1e-12));
  CHECK(response.at(fast, end_s + 0.25).rate_m_s ==
        Approx(-q * std::exp(-2.5) / 0.1).epsilon(1e-12));
}

TEST_CASE("the time at a position is the inverse of the position", "[fit]") {
  const StageMove move{2.0, 1e-3, 0.4e-3, 4e-3, 0.2};
  const double t = time_at_position_s(move, 0.7e-3);
  CHECK(position_m(move, t) == Approx(0.7e-3).epsilon(1e-12));
}

TEST_CASE("a correction is shorter than a twentieth of the way of the ramp in contact", "[fit]") {
  const StageMove ramp{0.0, 0.0, 1.2e-4, 1e-4, 1e-2};  // contact at 20 um, so 100 um in contact
  CHECK(is_correction({5.0, 1.2e-4, 1.245e-4, 1e-4, 1e-2}, ramp, 2e-5));
  CHECK(is_correction({5.0, 1.2e-4, 1.155e-4, 1e-4, 1e-2}, ramp, 2e-5));
  CHECK_FALSE(is_correction({5.0, 1.2e-4, 1.255e-4, 1e-4, 1e-2}, ramp, 2e-5));
}
