// Clocks and time stamps of captured runs.
#include "fit/fit_indentation.h"
#include "fit/indentation_from_capture.h"
#include "tests/fit/fit_checks.h"
#include "tests/support/in_memory_run.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

using namespace viscard;
using namespace viscard::test;

TEST_CASE("the clock line touches the receive times from below", "[fit]") {
  std::vector<double> x, y;
  for (int i = 0; i < 1000; ++i) {
    x.push_back(0.0125 * i);
    y.push_back(5.0 + 1.001 * x.back() + (i % 7 == 3 ? 0.0 : 0.001 * (i % 11)));
  }
  const ClockLine line = line_from_below(x, y);
  CHECK(line.slope == Approx(1.001).epsilon(1e-9));
  CHECK(line.at(2.0) == Approx(7.002).epsilon(1e-9));
}

TEST_CASE("one fast message in the middle does not tilt the clock line", "[fit][stability]") {
  std::vector<double> x, y;
  for (int i = 0; i < 8000; ++i) {
    x.push_back(0.0125 * i);
    // Delays of 50 to 60 ms, a stall of 1 s, and one message that took 10 ms.
    const double stall_s = std::max(0.0, 1.0 - 0.0125 * std::abs(i - 6000));
    y.push_back(x.back() + 0.05 + 0.001 * (i % 11) + stall_s - (i == 4100 ? 0.04 : 0.0));
  }
  const ClockLine line = line_from_below(x, y);
  CHECK(line.slope == Approx(1.0).margin(1e-5));  // 40 ms over a part of the run would be far more
  CHECK(line.at(0.0) == Approx(0.0).margin(0.02));
  CHECK(line.at(100.0) == Approx(100.0).margin(0.02));
}

TEST_CASE("time stamps that jitter by 20 ms do not change frame or specimen", "[fit]") {
  // Readings come every 12.5 ms. Half of their stamps are off by up to 20 ms, so some readings
  // change places. The kinks of the ramp, and the stiffness read from it, must not suffer.
  EmulatedTruth truth = demo_truth(GENERATE(10, 20), 4);
  CapturedRun run = in_memory_run(truth, {});
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> within(-0.02, 0.02);
  for (LoadSample& sample : run.load_samples) {
    REQUIRE(sample.device_time_s);
    if (random() % 2 == 0) *sample.device_time_s += within(random);
  }
  const FitResult fit = fit_indentation(indentation_from_capture(run));
  CHECK(fit.is_trustworthy);
  CHECK(fit.terms.size() == truth.material.terms.size());
  CHECK(fit.E0_Pa == Approx(truth.material.E0_Pa).epsilon(0.003));
  CHECK(fit.E0_interval_95.low <= truth.material.E0_Pa);
  CHECK(fit.E0_interval_95.high >= truth.material.E0_Pa);
}
