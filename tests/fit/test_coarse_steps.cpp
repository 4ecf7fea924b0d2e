#include "fit/fit_indentation.h"
#include "fit/indentation_from_capture.h"
#include "tests/fit/fit_checks.h"
#include "tests/support/in_memory_run.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdint>

using namespace viscard;
using namespace viscard::test;

namespace {

struct Coverage {
  int intervals = 0, holding = 0;  // of E0, g_1 and tau_1
  double mean_error = 0.0;         // of E0, relative
};

// A term of a quarter and 1.5 s, which relaxes during the ramp of 1 s and shows late how deep it pressed.
// At 250 steps/mm the ramp has 33 steps, and one reading in three lies between two of them.
Coverage of_runs(double steps_per_m, double unload_to_fraction, int seeds) {
  Coverage coverage;
  for (int seed = 1; seed <= seeds; ++seed) {
    EmulatedTruth truth = demo_truth(10, static_cast<std::uint64_t>(500 + seed));
    truth.steps_per_m = steps_per_m;
    truth.acceleration_m_s2 = 0.01;
    truth.material.terms = {{0.25, 0.25, 1.5}};
    TestPlan plan;
    plan.unload_to_fraction = unload_to_fraction;
    FitOptions options;
    options.with_curves = false;
    const FitResult fit =
        fit_indentation(indentation_from_capture(in_memory_run(truth, plan)), options);
    CAPTURE(steps_per_m, unload_to_fraction, seed);
    CHECK(fit.is_trustworthy);
    REQUIRE(fit.terms.size() == 1);
    coverage.intervals += 3;
    coverage.holding += holds(fit.E0_interval_95, truth.material.E0_Pa) ? 1 : 0;
    coverage.holding += holds(fit.terms[0].g_95, 0.25) ? 1 : 0;
    coverage.holding += holds(fit.terms[0].tau_s_95, 1.5) ? 1 : 0;
    coverage.mean_error += (fit.E0_Pa / truth.material.E0_Pa - 1.0) / seeds;
  }
  return coverage;
}

// The punch keeps contact in the unloading, or loses it and the unloading is not fitted.
constexpr double kKeepsContact = 0.6, kLiftsOff = 0.25;

}  // namespace

TEST_CASE("whole steps of the motor do not spoil the fit of what relaxes during the ramp",
          "[fit]") {
  const double unload_to = GENERATE(kKeepsContact, kLiftsOff);
  Coverage all;
  for (const double steps_per_m : {100e3, 250e3, 1600e3}) {
    const Coverage coverage = of_runs(steps_per_m, unload_to, 4);
    all.intervals += coverage.intervals;
    all.holding += coverage.holding;
    // Half a step of 10 um is 7 % of the depth. Without an unloading that keeps contact the zero of time is
    // as wrong as half a step takes, and the interval is that wide.
    CHECK(std::abs(coverage.mean_error) < (unload_to == kKeepsContact ? 1e-3 : 8e-3));
  }
  // At 95 % fewer than 29 of 36 hold with a probability below one in ten thousand.
  CHECK(all.intervals == 36);
  CHECK(all.holding >= 29);
}

TEST_CASE("180 runs with coarse steps: 90 to 99 % of 540 intervals hold", "[fit][slow]") {
  Coverage all;
  for (const double unload_to : {kKeepsContact, kLiftsOff}) {
    for (const double steps_per_m : {100e3, 250e3, 1600e3}) {
      const Coverage coverage = of_runs(steps_per_m, unload_to, 30);
      all.intervals += coverage.intervals;
      all.holding += coverage.holding;
      CHECK(coverage.holding >= 79);  // of 90; fewer with a probability below one in five hundred
    }
  }
  const double share = static_cast<double>(all.holding) / all.intervals;
  WARN(all.holding << " of " << all.intervals << " intervals hold");
  CHECK(share >= 0.90);
  CHECK(share <= 0.99);
}
