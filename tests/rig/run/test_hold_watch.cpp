// What a force may do in a hold, and what no specimen does.
#include "rig/run/hold_watch.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <random>

namespace viscard {
namespace {

constexpr double kHoldNoise_N = 0.5e-3;
const HoldWatch::Limits kHoldLimits{0.0, 24.5e-3, 30e-3};

// The first change in a hold of 20 s with that course of the force.
std::optional<HoldWatch::Change> change_in(const std::function<double(double)>& force_N,
                                           double rate_Hz = 80.0,
                                           HoldWatch::Limits limits = kHoldLimits) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0.0, kHoldNoise_N);
  HoldWatch watch;
  watch.begin(limits);
  for (double t_s = 0.0; t_s < 20.0; t_s += 1.0 / rate_Hz) {
    if (const auto change = watch.take(force_N(t_s) + noise(random), t_s)) return change;
  }
  return std::nullopt;
}

}  // namespace

TEST_CASE("a force that relaxes, recovers or hums in a hold is no change", "[rig]") {
  const double rate_Hz = GENERATE(2.0, 10.0, 80.0, 320.0);
  const double tau_s = GENERATE(0.02, 0.1, 0.3, 1.0, 5.0, 50.0);
  CAPTURE(rate_Hz, tau_s);
  CHECK_FALSE(change_in([&](double t_s) { return 0.2 + 1.6 * std::exp(-t_s / tau_s); }, rate_Hz));
  HoldWatch::Limits unloaded = kHoldLimits;
  unloaded.rise_N.reset();
  CHECK_FALSE(change_in(
      [&](double t_s) {
        return 0.6 - 0.3 * std::exp(-t_s / tau_s) + 0.3 * std::exp(-t_s / (4.0 * tau_s));
      },
      rate_Hz, unloaded));
  CHECK_FALSE(change_in([](double t_s) { return 0.9 + 4e-3 * std::sin(314.159 * t_s); }, rate_Hz));
  // One garbled digit.
  CHECK_FALSE(
      change_in([](double t_s) { return std::abs(t_s - 9.0) < 1e-6 ? 1.7 : 0.9; }, rate_Hz));
}

TEST_CASE("a force that goes, jumps, bursts or rises in a hold is found", "[rig]") {
  const double rate_Hz = GENERATE(10.0, 80.0);
  const auto relaxed_N = [](double t_s) { return 0.8 + 0.1 * std::exp(-t_s); };
  const auto is_on = [](double t_s) { return t_s > 6.0; };
  for (const double by_N : {-0.88, -0.2, 0.2}) {
    CAPTURE(rate_Hz, by_N);
    const auto change =
        change_in([&](double t_s) { return relaxed_N(t_s) + (is_on(t_s) ? by_N : 0.0); }, rate_Hz);
    REQUIRE(change);
    CHECK(change->after_s == Approx(6.0).margin(10.0 / rate_Hz));
    CHECK(change->by_N * by_N > 0.0);
  }
  CHECK(change_in(
      [&](double t_s) {
        return relaxed_N(t_s) + (is_on(t_s) && t_s < 6.0 + 5.9 / rate_Hz ? 0.3 : 0.0);
      },
      rate_Hz));
  const auto rise = change_in([&](double t_s) { return relaxed_N(t_s) * (1.0 + 0.02 * t_s); });
  REQUIRE(rise);
  CHECK_FALSE(rise->is_jump);
}

}  // namespace viscard
