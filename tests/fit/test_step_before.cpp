// Records that begin under load: the step was before the first sample.
#include "fit/fit_indentation.h"
#include "fit/fit_relaxation.h"
#include "tests/fit/fit_checks.h"
#include "tests/fit/spectra.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace viscard;
using namespace viscard::test;

namespace {

// Relaxation after a step at zero_s, from first_s on.
std::vector<double> relaxed(const PronySeries& series, const std::vector<double>& time_s,
                            double zero_s, double scale, unsigned seed = 9) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> values;
  for (const double t : time_s) {
    values.push_back(scale * (relaxation_modulus_Pa(series, t - zero_s) + 2e-4 * normal(random)));
  }
  return values;
}

std::vector<double> times(double first_s) {
  std::vector<double> time_s;
  for (int i = 0; i < 3000; ++i) time_s.push_back(first_s + 0.1 * i);
  return time_s;
}

const PronySeries kTruth{0.4, {{0.3, 0.5}, {0.3, 30.0}}};

}  // namespace

TEST_CASE("a stress record that begins under a constant strain counts time from the step",
          "[fit]") {
  RelaxationData data;
  data.time_s = times(0.5);
  data.strain.assign(data.time_s.size(), 0.01);
  int n_held = 0;
  constexpr unsigned kRuns = 20;
  for (unsigned seed = 1; seed <= kRuns; ++seed) {
    data.value = relaxed(kTruth, data.time_s, 0.0, 0.01, seed);
    const FitResult fit = fit_relaxation(data);
    CHECK(has_flag(fit, "step-before-record"));
    CHECK(fit.E0_Pa == Approx(1.0).epsilon(0.01));
    REQUIRE(fit.terms.size() == 2);
    CHECK(fit.terms[0].tau_s == Approx(0.5).epsilon(0.05));
    n_held += holds(fit.E0_interval_95, 1.0) ? 1 : 0;
  }
  CHECK(n_held >= 17);
  for (double& t : data.time_s) t -= 0.4;  // another time zero is another step
  CHECK(fit_relaxation(data).E0_Pa < 0.95);
}

TEST_CASE("a force record that begins at a constant depth counts time from the step", "[fit]") {
  IndentationData data;
  data.time_s = times(0.5);
  data.force_N = relaxed(kTruth, data.time_s, 0.0, 1e-4);
  data.depth_m.assign(data.time_s.size(), 1e-4);
  const FitResult fit = fit_indentation(data);
  CHECK(has_flag(fit, "step-before-record"));
  CHECK(fit.E0_Pa == Approx(1.0).epsilon(0.02));
}

TEST_CASE("a record on a machine's clock counts from its first row, one from t = 0 on as it stands",
          "[fit]") {
  RelaxationData data;
  data.time_s = times(5000.0);  // the clock of the machine
  data.value = relaxed(kTruth, data.time_s, 5000.0, 0.01);
  data.strain.assign(data.time_s.size(), 0.01);
  const FitResult late = fit_relaxation(data);
  CHECK(has_flag(late, "time-zero-doubtful"));
  CHECK(late.E0_interval_95.low < 1.0);  // half a step before the first row, or at it
  CHECK(late.E0_interval_95.high > 1.0);
  data.time_s = times(0.0);
  CHECK_FALSE(has_flag(fit_relaxation(data), "step-before-record"));
}

TEST_CASE("holds between ramps do not count as loading", "[fit]") {
  RelaxationData data;
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 8000; ++i) {  // ramps of 1 s to 1 % at 1 s, to 2 % at 41 s
    const double t = 0.01 * i;
    const auto ramp = [&](double from_s) {
      return 0.01 * std::min(1.0, std::max(0.0, t - from_s));
    };
    const auto response = [&](double from_s) {
      double value = 0.4 * ramp(from_s);
      for (const MaxwellTerm& term : kTruth.terms) {
        const double tau = term.relaxation_time_s, s = t - from_s;
        if (s <= 0.0) continue;
        const double end = std::min(1.0, s);
        value += 0.01 * term.modulus_Pa * tau * (std::exp(-(s - end) / tau) - std::exp(-s / tau));
      }
      return value;
    };
    data.time_s.push_back(t);
    data.strain.push_back(ramp(1.0) + ramp(41.0));
    data.value.push_back(response(1.0) + response(41.0) + 1e-5 * normal(random));
  }
  const FitResult fit = fit_relaxation(data);
  CHECK(fit.E0_Pa == Approx(1.0).epsilon(0.02));
  CHECK_FALSE(has_flag(fit, "tau-below-ramp"));
}
