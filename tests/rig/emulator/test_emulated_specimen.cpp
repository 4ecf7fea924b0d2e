#include "models/contact/punch_contact.h"
#include "rig/emulator/demo_rig.h"
#include "rig/emulator/emulated_motion.h"
#include "rig/emulator/emulated_specimen.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

namespace viscard {
namespace {

// Force on a Maxwell-type solid in series with a spring, by brute force: explicit midpoint steps of
// the branch equations, dq/dt = E_i d(depth)/dt - q/tau, with depth = z - F/k differentiated by
// hand. Shares nothing with the recurrence under test.
double force_by_fine_integration(const EmulatedTruth& truth, double ramp_m, double ramp_s,
                                 double end_s, int n_steps) {
  const double c_m = force_per_modulus_and_depth_m(truth.contact);
  const double k_N_m = truth.frame_stiffness_N_m;
  const double E0_Pa = truth.material.E0_Pa;
  std::vector<double> q(truth.material.terms.size(), 0.0);
  // dF/dt = c (E0 d' - sum q/tau), d' = z' - F'/k  =>  F' = (c E0 z' - c sum q/tau)/(1 + c E0/k)
  double force_N = 0.0;
  const double dt_s = end_s / n_steps;
  for (int n = 0; n < n_steps; ++n) {
    const double speed_m_s = (n + 0.5) * dt_s < ramp_s ? ramp_m / ramp_s : 0.0;
    const auto rates = [&](const std::vector<double>& branch) {
      double decay_Pa_s = 0.0;
      for (std::size_t i = 0; i < branch.size(); ++i) {
        decay_Pa_s += branch[i] / truth.material.terms[i].tau_s;
      }
      const double dF = c_m * (E0_Pa * speed_m_s - decay_Pa_s) / (1.0 + c_m * E0_Pa / k_N_m);
      const double d_depth = speed_m_s - dF / k_N_m;
      std::vector<double> result{dF};
      for (std::size_t i = 0; i < branch.size(); ++i) {
        result.push_back(E0_Pa * truth.material.terms[i].g * d_depth -
                         branch[i] / truth.material.terms[i].tau_s);
      }
      return result;
    };
    const std::vector<double> first = rates(q);
    std::vector<double> middle = q;
    for (std::size_t i = 0; i < q.size(); ++i) middle[i] += 0.5 * dt_s * first[i + 1];
    const std::vector<double> second = rates(middle);
    force_N += dt_s * second[0];
    for (std::size_t i = 0; i < q.size(); ++i) q[i] += dt_s * second[i + 1];
  }
  return force_N;
}

EmulatedTruth touching_truth() {
  EmulatedTruth truth = demo_truth(13.0, 1);
  truth.surface_position_m = 0.0;
  return truth;
}

}  // namespace

TEST_CASE("without relaxation the force is that of two springs in series", "[rig]") {
  EmulatedTruth truth = touching_truth();
  truth.material.terms.clear();
  EmulatedSpecimen specimen(truth);
  const double c_E_N_m = force_per_modulus_and_depth_m(truth.contact) * truth.material.E0_Pa;
  const double z_m = 0.2e-3;
  const double expected_N = z_m / (1.0 / c_E_N_m + 1.0 / truth.frame_stiffness_N_m);
  CHECK(specimen.advance(1e-3, z_m) == Approx(expected_N).epsilon(1e-12));  // rounding only
  CHECK(specimen.depth_m() == Approx(z_m - expected_N / truth.frame_stiffness_N_m).epsilon(1e-12));
}

TEST_CASE("ramp and hold through a frame spring agree with a fine integration", "[rig]") {
  const EmulatedTruth truth = touching_truth();
  const double ramp_m = 0.3e-3;
  EmulatedSpecimen specimen(truth);
  for (int n = 1; n <= 3000; ++n) {
    specimen.advance(1e-3, ramp_m * std::min(n * 1e-3, 1.0));
  }
  const double independent_N = force_by_fine_integration(truth, ramp_m, 1.0, 3.0, 60000);
  // 50 us midpoint steps against 1 ms exact ones: both below 1e-6.
  CHECK(specimen.force_N() == Approx(independent_N).epsilon(1e-6));
}

TEST_CASE("halving the step reduces the change of the force to a quarter", "[rig][convergence]") {
  const EmulatedTruth truth = touching_truth();
  const auto force_with = [&](int per_second) {
    EmulatedSpecimen specimen(truth);
    for (int n = 1; n <= 2 * per_second; ++n) {
      const double t_s = static_cast<double>(n) / per_second;
      specimen.advance(1.0 / per_second, 0.3e-3 * std::min(t_s, 1.0));
    }
    return specimen.force_N();
  };
  const double exact_N = force_with(4000);
  const double coarse_N = std::abs(force_with(20) - exact_N);
  const double fine_N = std::abs(force_with(40) - exact_N);
  CHECK(coarse_N / fine_N > 3.5);
  CHECK(coarse_N / fine_N < 4.5);
}

TEST_CASE("the punch never pulls and touches a recovering surface where it is", "[rig]") {
  EmulatedTruth truth = touching_truth();
  EmulatedSpecimen specimen(truth);
  specimen.advance(0.01, 0.3e-3);
  for (int n = 0; n < 5000; ++n) specimen.advance(1e-3, 0.3e-3);
  REQUIRE(specimen.force_N() > 1.0);
  CHECK(specimen.advance(1e-3, 0.0) == 0.0);  // at once: the surface is still pressed in
  const double pressed_m = specimen.depth_m();
  CHECK(pressed_m > 0.0);
  for (int n = 0; n < 30000; ++n) REQUIRE(specimen.advance(1e-3, -1e-3) == 0.0);
  CHECK(specimen.depth_m() < 1e-3 * pressed_m);  // ten relaxation times later
}

TEST_CASE("moves end on whole steps: 0.25 mm at 250 steps/mm becomes 0.252 mm", "[rig]") {
  EmulatedMotion motion(250e3, 0.0);
  motion.start(0.0, 0.25e-3 + 1e-9, 1e-3, 0.2);
  CHECK(motion.end_position_m() == Approx(0.252e-3).epsilon(1e-12));
  CHECK(motion.position_m(10.0) == motion.end_position_m());
}

TEST_CASE("a stage that stands still in a move goes on with the rest of it", "[rig]") {
  EmulatedMotion motion(3200e3, 0.0);
  motion.start(0.0, 0.5e-3, 0.5e-3, 0.2);
  EmulatedMotion stalled = motion;
  stalled.stand_still(0.4, 0.5);
  CHECK(stalled.position_m(0.3) == motion.position_m(0.3));
  CHECK(stalled.position_m(0.8) == Approx(motion.position_m(0.4)).margin(1e-12));
  CHECK(stalled.velocity_m_s(0.8) == 0.0);
  CHECK(stalled.position_m(1.2) == Approx(motion.position_m(0.7)).margin(1e-12));
  CHECK(stalled.end_time_s() == Approx(motion.end_time_s() + 0.5).epsilon(1e-12));
  stalled.extend(0.6e-3);
  CHECK(stalled.position_m(1.2) == Approx(motion.position_m(0.7)).margin(1e-12));
}

TEST_CASE("a gentle stop carries out GRBL's queue, a reset stops at once", "[rig]") {
  const double speed_m_s = GENERATE(0.1e-3, 0.5e-3, 2e-3);
  EmulatedMotion motion(3200e3, 0.0);
  motion.start(0.0, 5e-3, speed_m_s, 0.2);
  EmulatedMotion reset = motion;
  const double stop_s = 1.0;
  const double here_m = motion.position_m(stop_s);
  motion.stop_gently(stop_s, 0.2);
  const double way_m = motion.end_position_m() - here_m;
  const double expected_m =
      std::max(7.5 / 3200e3, 0.06 * speed_m_s) + 0.5 * speed_m_s * speed_m_s / 0.2;
  CHECK(way_m == Approx(expected_m).margin(1.01 / 3200e3));  // ends on the next whole step
  CHECK(motion.velocity_m_s(motion.end_time_s() - 1e-9) == Approx(0.0).margin(1e-8));
  reset.stop_at_once(stop_s);
  CHECK(reset.end_position_m() == Approx(here_m).margin(0.51 / 3200e3));
}

}  // namespace viscard
