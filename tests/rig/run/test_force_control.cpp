#include "rig/run/force_control.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace viscard {
namespace {

// A relaxing spring: force falls by a share each step, the stage pushes it back.
std::vector<double> forces_of(ForceControl& control, double true_N_m, double start_N,
                              double lost_share, int n) {
  std::vector<double> forces{start_N};
  for (int i = 0; i < n; ++i) {
    const double step_m = control.step_m(forces.back());
    forces.push_back(forces.back() * (1.0 - lost_share) + true_N_m * step_m);
  }
  return forces;
}

}  // namespace

TEST_CASE("force control reaches its target for any true stiffness, with bounded overshoot",
          "[rig]") {
  const double ratio = GENERATE(0.3, 1.0, 1.4, 2.5, 5.0);  // true stiffness over the assumed one
  const double start_N = GENERATE(0.0, 0.8, 1.3);
  ForceControl control({.target_N = 1.0,
                        .stiffness_N_m = 6e3,
                        .tolerance_N = 1e-3,
                        .largest_step_m = 25e-6,
                        .noise_N = 1e-5});
  const std::vector<double> forces = forces_of(control, ratio * 6e3, start_N, 0.0, 60);
  INFO("ratio " << ratio << " start " << start_N);
  CHECK(forces.back() == Approx(1.0).margin(1e-3));
  // The first step may be 0.7 ratio of the gap; later steps use the stiffness seen.
  const double most_N = std::max(start_N, 1.0 + std::max(0.0, 0.7 * ratio - 1.0) * (1.0 - start_N));
  CHECK(*std::max_element(forces.begin(), forces.end()) <= most_N + 1e-9);
}

TEST_CASE("force control follows relaxation and leaves a small error", "[rig]") {
  ForceControl control({.target_N = 1.0,
                        .stiffness_N_m = 6e3,
                        .tolerance_N = 1e-4,
                        .largest_step_m = 25e-6,
                        .noise_N = 1e-5});
  // 0.2 % is lost in each step: the gap settles where 0.7 of it equals the loss, at 0.0029 N.
  const std::vector<double> forces = forces_of(control, 6e3, 1.0, 0.002, 200);
  CHECK(forces.back() == Approx(1.0 - 0.002 / 0.7).margin(2e-4));
}

TEST_CASE("force control never steps further than allowed, and not at all within its tolerance",
          "[rig]") {
  ForceControl control(
      {.target_N = 1.0, .stiffness_N_m = 1e3, .tolerance_N = 0.01, .largest_step_m = 25e-6});
  CHECK(control.step_m(0.0) == 25e-6);
  CHECK(control.step_m(0.995) == 0.0);
  CHECK(control.step_m(5.0) == -25e-6);
  CHECK_THROWS_AS(ForceControl({.target_N = 1.0, .stiffness_N_m = 0.0, .largest_step_m = 1e-6}),
                  std::invalid_argument);
}

}  // namespace viscard
