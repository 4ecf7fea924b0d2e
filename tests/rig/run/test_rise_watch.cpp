// A force that stops rising while the stage presses on.
#include "rig/run/rise_watch.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace viscard {
namespace {

constexpr double kPress_m = 0.2e-3, kPressStep_m = 4e-6, kPressNoise_N = 0.5e-3,
                 kLeastRise_N = 0.025;

// Presses in n_reports reports, a little uneven in time, until the motor dies at that share of the
// way; returns the share at which that is noticed, or 2. force_N: after a share t of the ramp, and a
// share s since its motor died.
double noticed_at(const std::function<double(double, double)>& force_N, double dead_from,
                  int n_reports, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, kPressNoise_N);
  std::uniform_real_distribution<double> late(-0.15, 0.15);
  RiseWatch watch;
  watch.begin(1e-3, kPress_m, kPressStep_m, kLeastRise_N);
  for (int i = -2; i < n_reports; ++i) {
    const double share = (i + late(random)) / n_reports;
    const double read = share + 0.1 * std::abs(late(random)) / n_reports;
    const double pressed = std::clamp(read, 0.0, dead_from);
    const double N = force_N(pressed, std::max(0.0, read - dead_from)) + noise(random);
    if (watch.take(1e-3 + kPress_m * share, N)) return share;
  }
  return 2.0;
}

// A ramp to 1.2 N in a time of 1; relaxing by g with tau, also after the motor has died.
std::function<double(double, double)> ramp_force(double g, double tau) {
  return [g, tau](double t, double s) {
    const double grown = tau * (1.0 - std::exp(-t / tau));
    return 1.2 * ((1.0 - g) * t + g * grown * std::exp(-s / tau));
  };
}

}  // namespace

TEST_CASE("a motor that dies after a third or half of the ramp is noticed within it", "[rig]") {
  const double g = GENERATE(0.0, 0.25, 0.6);
  const double tau = GENERATE(0.1, 0.3, 5.0);
  const double dead_from = GENERATE(0.33, 0.5);
  const int n_reports = GENERATE(10, 25, 100);  // 10/s, and ramps of 1 s or more
  for (unsigned seed = 1; seed <= 20; ++seed) {
    CAPTURE(g, tau, dead_from, n_reports, seed);
    const double at = noticed_at(ramp_force(g, tau), dead_from, n_reports, seed);
    CHECK(at > dead_from);
    CHECK(at < (n_reports > 10 ? dead_from + 0.4 : 1.0));
  }
}

TEST_CASE("specimens that relax much, flow or stiffen raise no alarm in slow and quick ramps",
          "[rig]") {
  const int n_reports = GENERATE(10, 25, 100);
  const auto force_N =
      GENERATE_COPY(ramp_force(0.0, 1.0), ramp_force(0.25, 0.3), ramp_force(0.9, 0.02),
                    ramp_force(0.9, 0.2), ramp_force(1.0, 0.5), ramp_force(1.0, 0.2),
                    std::function<double(double, double)>(
                        [](double t, double) { return 1.2 * std::pow(std::max(0.0, t), 1.5); }),
                    std::function<double(double, double)>(
                        [](double t, double) { return t < 0.02 ? -0.02 : 1.2 * t; }),
                    std::function<double(double, double)>([](double, double) { return 0.0; }));
  int n_alarms = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    n_alarms += noticed_at(force_N, 1.0, n_reports, seed) < 2.0 ? 1 : 0;
  }
  INFO(n_reports);
  CHECK(n_alarms == 0);
}

TEST_CASE("the staircase of a coarse stage is no stop of the force", "[rig]") {
  constexpr double kCoarse_m = 10e-6;
  RiseWatch watch;
  watch.begin(0.0, kPress_m, kCoarse_m, kLeastRise_N);
  for (int i = 1; i < 100; ++i) {
    const double at_m = kCoarse_m * std::floor(kPress_m * i / 100.0 / kCoarse_m);
    CHECK_FALSE(watch.take(at_m, 6e3 * at_m));
  }
}

}  // namespace viscard
