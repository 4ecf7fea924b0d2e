#include "fit/fit_creep.h"
#include "fit/fit_indentation.h"
#include "fit/fit_relaxation.h"
#include "tests/fit/fit_checks.h"
#include "tests/fit/spectra.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

using namespace viscard;
using namespace viscard::test;

namespace {

const PronySeries kSolid{1.0, {{0.3, 0.8}, {0.2, 40.0}}};

// A relaxation of 1000 s with a drift of the instrument, by this share of 1 Pa.
RelaxationData drifting(double share, double relative_noise, std::uint64_t seed) {
  RelaxationData data = relaxation_of(kSolid, 4000, 1000.0, relative_noise, seed);
  for (std::size_t i = 0; i < data.value.size(); ++i) {
    data.value[i] += share * data.time_s[i] / 1000.0;
  }
  return data;
}

}  // namespace

TEST_CASE("a drift upwards is found, fitted and reported", "[fit]") {
  const double noise = GENERATE(0.001, 0.005);
  CAPTURE(noise);
  int n_held = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const FitResult fit = fit_relaxation(drifting(0.05, noise, seed));
    CHECK(fit.is_trustworthy);
    CHECK(has_flag(fit, "drift-fitted"));
    REQUIRE(fit.drift);
    CHECK(std::abs(fit.drift->per_s - 5e-5) < 4.0 * fit.drift->se_per_s);
    CHECK(fit.E_inf_Pa == Approx(1.0).epsilon(0.01));
    n_held += holds(fit.E_inf_interval_95, 1.0) ? 1 : 0;
  }
  CHECK(n_held >= 8);
}

TEST_CASE("without the drift that it needs, a fit is not trusted", "[fit]") {
  FitOptions options;
  options.drift = TableDrift::kNone;
  const FitResult fit = fit_relaxation(drifting(0.05, 0.002, 3), options);
  CHECK_FALSE(fit.drift);
  CHECK(has_flag(fit, "misfit"));
  CHECK_FALSE(fit.is_trustworthy);
  // Noise that hides most of the structure leaves a flag.
  const FitResult noisy = fit_relaxation(drifting(0.05, 0.01, 3), options);
  CHECK((has_flag(noisy, "lack-of-fit") || has_flag(noisy, "misfit")));
}

TEST_CASE("a drift downwards is not hidden: the interval of E_inf holds the truth", "[fit]") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const FitResult fit = fit_relaxation(drifting(-0.05, 0.002, seed));
    CAPTURE(seed, fit.E_inf_Pa, fit.E_inf_interval_95.low, fit.E_inf_interval_95.high);
    CHECK(holds(fit.E_inf_interval_95, 1.0));
    CHECK((has_flag(fit, "drift-fitted") || has_flag(fit, "tau-beyond-window")));
    // If the user knows that it is drift, the interval is narrow.
    FitOptions options;
    options.drift = TableDrift::kFitted;
    const FitResult known = fit_relaxation(drifting(-0.05, 0.002, seed), options);
    REQUIRE(known.drift);
    CHECK(known.drift->per_s == Approx(-5e-5).epsilon(0.1));
    CHECK(known.E_inf_Pa == Approx(1.0).epsilon(0.005));
    CHECK(known.E_inf_interval_95.high - known.E_inf_interval_95.low < 0.02);
  }
}

TEST_CASE("a drift in a table of stress and strain, and in one of force and depth", "[fit]") {
  const IndentationData clean =
      indentation_of(kSolid, even_times(400.0, 0.2), ramp_and_hold(2.0), 1e-3, 8);
  IndentationData table = clean;
  RelaxationData history{clean.time_s, {}, clean.depth_m};
  for (std::size_t i = 0; i < table.force_N.size(); ++i) {
    table.force_N[i] += 6e-6 * table.time_s[i] / 400.0;
    history.value.push_back(table.force_N[i]);
  }
  for (const FitResult& fit : {fit_indentation(table), fit_relaxation(history)}) {
    REQUIRE(fit.drift);
    CHECK(fit.drift->per_s == Approx(6e-6 / 400.0).epsilon(0.1));
    CHECK(fit.E_inf_Pa == Approx(1.0).epsilon(0.01));
    CHECK(fit.is_trustworthy);
  }
}

TEST_CASE("a modulus that rises with time is not a relaxation", "[fit]") {
  RelaxationData data;
  std::mt19937_64 random(4);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 400; ++i) {
    data.time_s.push_back(0.5 * i);
    data.value.push_back(1e6 + 38e6 * i / 399.0 + 1e5 * normal(random));
  }
  const FitResult fit = fit_relaxation(data);
  CHECK(has_flag(fit, "modulus-rises"));
  CHECK_FALSE(fit.is_trustworthy);
}

TEST_CASE("the loading at the start of a table of relaxation is noticed", "[fit]") {
  RelaxationData data = relaxation_of(kSolid, 4000, 400.0, 0.002, 9);
  for (std::size_t i = 0; i < data.value.size(); ++i) {
    data.value[i] *= std::min(1.0, data.time_s[i] / 2.0);
  }
  const FitResult fit = fit_relaxation(data);
  CHECK(has_flag(fit, "modulus-rises"));
  CHECK_FALSE(fit.is_trustworthy);
}

TEST_CASE("a residual of 4 % of the force is a misfit", "[fit]") {
  IndentationData data =
      indentation_of(kSolid, even_times(400.0, 0.1), ramp_and_hold(2.0), 2e-3, 5);
  for (std::size_t i = 0; i < data.force_N.size(); ++i) {
    data.force_N[i] *= 1.0 + 0.056 * std::sin(3.0 * std::log(1.0 + data.time_s[i]));
  }
  const FitResult fit = fit_indentation(data);
  CHECK(has_flag(fit, "misfit"));
  CHECK_FALSE(fit.is_trustworthy);
}

TEST_CASE("too few terms are a misfit, in relaxation and in creep", "[fit]") {
  const FitResult relaxation =
      fit_relaxation(relaxation_of(s6(), 4000, 1e4, 0.002, 6), {.n_terms = 1});
  CHECK(has_flag(relaxation, "misfit"));
  CreepData data;
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 2000; ++i) {
    const double t = 0.1 * i;
    data.time_s.push_back(t);
    data.compliance_1_Pa.push_back(
        1e-6 * (1.0 + 0.5 * (1.0 - std::exp(-t)) + 0.02 * t + 0.005 * normal(random)));
  }
  CHECK(has_flag(fit_creep(data, {.n_terms = 0}), "misfit"));
}

TEST_CASE("noise is not taken for structure, nor for a drift", "[fit]") {
  const double rho = GENERATE(0.0, 0.9, 0.97);
  CAPTURE(rho);
  int n_flagged = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const FitResult fit = fit_relaxation(relaxation_of(s2(), 4000, 1000.0, 0.01, seed, rho));
    CHECK_FALSE(has_flag(fit, "misfit"));
    CHECK_FALSE(has_flag(fit, "modulus-rises"));
    n_flagged += has_flag(fit, "lack-of-fit") || has_flag(fit, "drift-fitted") ? 1 : 0;
  }
  CHECK(n_flagged <= 1);
}

TEST_CASE("data without noise have no structure", "[fit]") {
  for (const double step : {0.0, 1e-4}) {  // exact, and rounded to four decimals
    RelaxationData data = relaxation_of(s2(), 500, 100.0, 0.0, 1);
    if (step > 0.0) {
      for (double& value : data.value) value = step * std::round(value / step);
    }
    const FitResult fit = fit_relaxation(data);
    CHECK(fit.is_trustworthy);
    CHECK_FALSE(has_flag(fit, "lack-of-fit"));
    CHECK_FALSE(fit.drift);
  }
}

TEST_CASE("E0 is compared with the modulus at the first sample", "[fit]") {
  // A term of 0.05 s, of which a record from 0.1 s on shows the tail.
  const PronySeries truth{1.0, {{0.5, 0.05}, {0.3, 5.0}}};
  RelaxationData data;
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 2000; ++i) {
    data.time_s.push_back(0.1 + 0.01 * i);
    data.value.push_back(relaxation_modulus_Pa(truth, data.time_s.back()) + 1e-4 * normal(random));
  }
  const FitResult fit = fit_relaxation(data);
  REQUIRE(fit.first);
  CHECK(fit.first->time_s == 0.1);
  CHECK(holds(fit.first->interval_95, relaxation_modulus_Pa(truth, 0.1)));
  CHECK(fit.first->interval_95.high - fit.first->interval_95.low < 1e-3);
  CHECK(has_flag(fit, "E0-extrapolated"));
  // From zero on nothing is extrapolated.
  const FitResult whole = fit_relaxation(relaxation_of(truth, 2000, 20.0, 1e-3, 3));
  REQUIRE(whole.first);
  CHECK(whole.first->modulus_Pa == Approx(whole.E0_Pa));
  CHECK_FALSE(has_flag(whole, "E0-extrapolated"));
}

TEST_CASE("a series of few terms for a continuous spectrum is not slow noise", "[fit]") {
  RelaxationData data;  // a power law, sampled in log time and rounded to four decimals
  for (int i = 0; i < 200; ++i) {
    data.time_s.push_back(std::pow(10.0, -3.0 + 0.03 * i));
    data.value.push_back(1e-4 * std::round(1e4 / std::pow(1.0 + data.time_s.back(), 0.3)));
  }
  const FitResult fit = fit_relaxation(data);
  CHECK_FALSE(has_flag(fit, "slow-noise"));
  CHECK(fit.is_trustworthy);
}

TEST_CASE("a wave in log time of 4 % is a misfit, and noise with a long memory is none", "[fit]") {
  RelaxationData data;
  std::mt19937_64 dice(4);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 800; ++i) {
    const double t_s = 0.1 * std::pow(10.0, 4.0 * i / 799.0);
    data.time_s.push_back(t_s);
    data.value.push_back(relaxation_modulus_Pa(kSolid, t_s) *
                             (1.0 + 0.04 * std::sin(6.0 * std::log(t_s))) +
                         6e-4 * normal(dice));
  }
  const FitResult fit = fit_relaxation(data);
  CHECK(has_flag(fit, "misfit"));
  CHECK_FALSE(fit.is_trustworthy);
  int n_trusted = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    n_trusted +=
        fit_relaxation(relaxation_of(kSolid, 4000, 1000.0, 0.01, seed, 0.97)).is_trustworthy;
  }
  CHECK(n_trusted >= 19);
}

TEST_CASE("the words of a misfit have the unit of the data", "[fit]") {
  RelaxationData data;
  data.unit = "N";
  for (int i = 0; i < 400; ++i) {
    data.time_s.push_back(0.1 * i);
    data.value.push_back(std::min(0.1 * i / 10.0, 1.0));  // a ramp is no relaxation
  }
  const FitResult fit = fit_relaxation(data);
  const auto misfit = std::find_if(fit.flags.begin(), fit.flags.end(),
                                   [](const auto& flag) { return flag.name == "misfit"; });
  REQUIRE(misfit != fit.flags.end());
  CHECK(misfit->text.find(" N rms") != std::string::npos);
  CHECK(misfit->text.find(" Pa") == std::string::npos);
}
