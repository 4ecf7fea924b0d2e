#include "fit/fit_creep.h"
#include "fit/fit_indentation.h"
#include "fit/fit_relaxation.h"
#include "fit/samples/rounded_times.h"
#include "models/material/prony_series.h"
#include "tests/fit/fit_checks.h"
#include "tests/fit/spectra.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

using namespace viscard;
using namespace viscard::test;

TEST_CASE("times that an export rounded are spread evenly again", "[fit]") {
  std::vector<double> even, times;
  for (int i = 1; i <= 300; ++i) {
    even.push_back(0.23 * i);
    times.push_back(std::round(0.23 * i));
  }
  const auto rounded = time_rounding(times);
  REQUIRE(rounded);
  CHECK(rounded->step_s == 1.0);
  REQUIRE(rounded->time_s.size() == even.size());
  for (std::size_t i = 0; i < even.size(); ++i) {
    CHECK(std::abs(rounded->time_s[i] - even[i]) < 0.15);
  }
}

TEST_CASE("times that are not rounded stay as they are", "[fit]") {
  CHECK_FALSE(time_rounding(even_times(10.0, 0.1)));
  CHECK_FALSE(time_rounding(std::vector<double>{}));
  CHECK_FALSE(time_rounding(std::vector<double>(40, 1.0)));
  std::vector<double> uneven;  // repeats at unequal distances
  for (int i = 0; i < 40; ++i) {
    uneven.push_back(std::pow(1.3, i));
    uneven.push_back(std::pow(1.3, i));
  }
  CHECK_FALSE(time_rounding(uneven));
}

TEST_CASE("a relaxation with times rounded to seconds states E0 and its doubt", "[fit]") {
  const PronySeries truth = s2();  // its fast term, 0.8 s, is shorter than the rounding
  int n_held = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::mt19937_64 dice(seed);
    std::normal_distribution<double> normal;
    RelaxationData data;
    for (int i = 1; i <= 3000; ++i) {
      data.time_s.push_back(std::round(0.2 * i));
      data.value.push_back(relaxation_modulus_Pa(truth, 0.2 * i) + 1e-3 * normal(dice));
    }
    const FitResult fit = fit_relaxation(data);
    CHECK(has_flag(fit, "times-rounded"));
    n_held += holds(fit.E0_interval_95, 1.8) ? 1 : 0;
  }
  CHECK(n_held >= 18);
}

namespace {

std::string text_of_rounding(const FitResult& fit) {
  const auto found = std::find_if(fit.flags.begin(), fit.flags.end(), [](const MaterialFlag& flag) {
    return flag.name == "times-rounded";
  });
  return found == fit.flags.end() ? "" : found->text;
}

double to_tenths(double time_s) {
  return std::round(10.0 * time_s) / 10.0;
}

// Terms of 0.3 and 5 s; E0 2.0.
PronySeries quick_material() {
  return {1.2, {{0.5, 0.3}, {0.3, 5.0}}};
}

}  // namespace

TEST_CASE("the step of rounded times is found, and even or missing rows are not rounded", "[fit]") {
  std::vector<double> sevenths, logarithmic, lossy, two_rates;
  for (int i = 0; i < 300; ++i) {
    sevenths.push_back(to_tenths(i / 7.0));
    logarithmic.push_back(to_tenths(0.02 * std::pow(1500.0, i / 299.0)));
    if (i % 23 != 7) lossy.push_back(0.1 * i);
    two_rates.push_back(i < 200 ? 0.1 * i : 20.0 + 0.2 * (i - 200));
  }
  CHECK(rounding_step_s(sevenths).value_or(0.0) == Approx(0.1));
  CHECK(rounding_step_s(logarithmic).value_or(0.0) == Approx(0.1));
  CHECK_FALSE(rounding_step_s(lossy));
  CHECK_FALSE(rounding_step_s(two_rates));
  CHECK_FALSE(rounding_step_s(even_times(30.0, 0.1)));
  CHECK_FALSE(rounding_step_s(std::vector<double>{0.0, 0.1, 0.3}));
}

TEST_CASE("times rounded or cut off to 0.1 s widen E0 by half a step and say by how much",
          "[fit]") {
  const PronySeries truth = quick_material();
  const bool is_cut = GENERATE(false, true);
  const double rate_Hz = GENERATE(7.0, 13.0);
  int n_held = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::mt19937_64 dice(seed);
    std::normal_distribution<double> normal;
    RelaxationData data;
    for (int i = 0; i < static_cast<int>(30.0 * rate_Hz); ++i) {
      const double t = (i + 0.3) / rate_Hz;
      data.time_s.push_back(is_cut ? std::floor(10.0 * t) / 10.0 : to_tenths(t));
      data.value.push_back(relaxation_modulus_Pa(truth, t) + 1e-3 * normal(dice));
    }
    const FitResult fit = fit_relaxation(data);
    CHECK_THAT(text_of_rounding(fit),
               Catch::Contains("rounded to 0.1 s") && Catch::Contains("changes E0 by"));
    n_held += holds(fit.E0_interval_95, 2.0) ? 1 : 0;
  }
  CHECK(n_held >= 19);
}

TEST_CASE("a ramp shorter than the rounding of its times does not make E0 sure", "[fit]") {
  const PronySeries truth = quick_material();
  const auto [ramp_s, rate_Hz] =
      GENERATE(table<double, double>({{0.05, 20.0}, {0.3, 7.0}, {0.3, 20.0}}));
  std::vector<double> time_s;
  for (int i = 0; i < static_cast<int>(31.0 * rate_Hz); ++i) time_s.push_back(i / rate_Hz - 0.99);
  const double rise_s = ramp_s;
  const auto strain = [rise_s](double t) { return 0.01 * std::clamp(t / rise_s, 0.0, 1.0); };
  int n_held = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const IndentationData made = indentation_of(truth, time_s, strain, 1e-3, seed);
    RelaxationData data{time_s, made.force_N, made.depth_m};
    std::transform(time_s.begin(), time_s.end(), data.time_s.begin(), to_tenths);
    const FitResult fit = fit_relaxation(data);
    CHECK_THAT(text_of_rounding(fit), Catch::Contains("rounded to 0.1 s"));
    n_held += holds(fit.E0_interval_95, 2.0) ? 1 : 0;
  }
  CHECK(n_held >= 9);
}

TEST_CASE("rounded times of an indentation and of a creep are named too", "[fit]") {
  const PronySeries truth = quick_material();
  std::vector<double> time_s;
  for (int i = 0; i < 620; ++i) time_s.push_back(i / 20.0 - 0.99);
  IndentationData data = indentation_of(truth, time_s, ramp_and_hold(0.5), 1e-3, 3);
  std::transform(time_s.begin(), time_s.end(), data.time_s.begin(), to_tenths);
  const FitResult fit = fit_indentation(data, {});
  CHECK_THAT(text_of_rounding(fit), Catch::Contains("spread evenly"));
  CHECK_FALSE(has_flag(fit, "gap-in-ramp"));
  // Times that share a step unevenly (1, 2 or 3 rows) are no gap either.
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    data.time_s[i] = to_tenths(time_s[i] + 0.02 * std::sin(static_cast<double>(i * i)));
  }
  std::sort(data.time_s.begin(), data.time_s.end());
  CHECK_FALSE(has_flag(fit_indentation(data, {}), "gap-in-ramp"));
  CHECK(holds(fit.E0_interval_95, 2.0));

  CreepData creep;
  for (int i = 0; i < 210; ++i) {
    const double t = (i + 0.3) / 7.0;
    creep.time_s.push_back(to_tenths(t));
    creep.compliance_1_Pa.push_back(1.0 - 0.3 * std::exp(-t / 0.4) - 0.2 * std::exp(-t / 6.0));
  }
  const FitResult crept = fit_creep(creep, {});
  CHECK_THAT(text_of_rounding(crept), Catch::Contains("changes E0"));
  CHECK(holds(crept.E0_interval_95, 2.0));
}

TEST_CASE("intervals hold a material whose times were cut off, also if the noise is small",
          "[fit]") {
  // Rows that share a time, one or two of them, one or two steps apart, and steps a little above the sampling.
  const double rate_Hz = GENERATE(33.0, 12.7, 7.0, 9.7);
  const PronySeries truth = quick_material();
  int n_held = 0, n_terms_held = 0;
  constexpr int kRuns = 20;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    std::mt19937_64 dice(seed);
    std::normal_distribution<double> normal;
    const double phase = std::uniform_real_distribution<double>()(dice);
    RelaxationData data;
    for (int i = 0; i < static_cast<int>(40.0 * rate_Hz); ++i) {
      const double t = (i + phase) / rate_Hz;
      data.time_s.push_back(std::floor(10.0 * t) / 10.0);
      data.value.push_back(relaxation_modulus_Pa(truth, t) + 2e-4 * normal(dice));
    }
    const FitResult fit = fit_relaxation(data);
    CHECK(has_flag(fit, "times-rounded"));
    n_held += holds(fit.E0_interval_95, 2.0) ? 1 : 0;
    n_terms_held += fit.terms.size() != 2 || holds(fit.terms[1].modulus_Pa_95, 0.3) ? 1 : 0;
  }
  CHECK(n_held >= kRuns - 1);
  CHECK(n_terms_held >= kRuns - 2);
}

TEST_CASE(
    "a strain or depth that jumps between two rows leaves E0 unsure by half of their distance",
    "[fit]") {
  const bool is_depth = GENERATE(false, true);
  const PronySeries truth = quick_material();
  int n_held = 0, n_named = 0;
  constexpr int kRuns = 20;
  constexpr double kStep_s = 0.1;
  for (std::uint64_t seed = 1; seed <= kRuns; ++seed) {
    std::mt19937_64 dice(seed);
    std::normal_distribution<double> normal;
    const double loaded_s = 2.0 + kStep_s * std::uniform_real_distribution<double>()(dice);
    std::vector<double> time_s, load, answer;
    for (int i = 0; i < 400; ++i) {
      const double t = kStep_s * i, strain = t > loaded_s ? 0.02 : 0.0;
      time_s.push_back(t);
      load.push_back(strain);
      answer.push_back(strain * relaxation_modulus_Pa(truth, std::max(0.0, t - loaded_s)) +
                       1e-6 * normal(dice));
    }
    const FitResult fit =
        is_depth ? fit_indentation({.time_s = time_s, .force_N = answer, .depth_m = load})
                 : fit_relaxation({.time_s = time_s, .value = answer, .strain = load});
    n_held += holds(fit.E0_interval_95, 2.0) ? 1 : 0;
    n_named += has_flag(fit, "time-zero-chosen") ? 1 : 0;
  }
  CHECK(n_held >= kRuns - 1);
  CHECK(n_named == kRuns);
}

TEST_CASE("an unloading between rows far apart does not decide how sure E0 is", "[fit]") {
  const PronySeries truth = quick_material();
  std::mt19937_64 dice(3);
  std::normal_distribution<double> normal;
  RelaxationData data;
  const auto add = [&](double t, double strain, double stress) {
    data.time_s.push_back(t);
    data.strain.push_back(strain);
    data.value.push_back(stress + 1e-5 * normal(dice));
  };
  add(0.0, 0.0, 0.0);
  add(1.0, 0.0, 0.0);
  for (int i = 0; i <= 150; ++i) {  // loaded at 1 s, in logarithmic time
    const double t = 0.001 * std::pow(10.0, i / 30.0);
    add(1.0 + t, 0.02, 0.02 * relaxation_modulus_Pa(truth, t));
  }
  for (int i = 1; i <= 20; ++i) {  // unloaded in the middle between the first two of these rows
    const double t = 100.0 + 5.0 * i;
    add(1.0 + t, 0.0,
        0.02 * (relaxation_modulus_Pa(truth, t) - relaxation_modulus_Pa(truth, t - 102.5)));
  }
  const FitResult fit = fit_relaxation(data);
  CHECK(holds(fit.E0_interval_95, 2.0));
  CHECK(fit.E0_interval_95.high - fit.E0_interval_95.low < 0.1);
}

TEST_CASE("rows missing at equal distances and cut times look alike, and both are inside",
          "[fit]") {
  const PronySeries truth = quick_material();
  RelaxationData data;
  for (int i = 1; i < 420; ++i) {
    if (i % 23 == 7) continue;  // rows are missing, and the times are right
    data.time_s.push_back(0.1 * i);
    data.value.push_back(relaxation_modulus_Pa(truth, 0.1 * i));
  }
  const auto found = time_rounding(data.time_s);
  REQUIRE(found);
  CHECK(found->time_s.empty());
  CHECK(found->unsure_s == Approx(0.1));
  const FitResult fit = fit_relaxation(data);
  CHECK_THAT(text_of_rounding(fit), Catch::Contains("rows are missing, or the times were cut off"));
  CHECK(holds(fit.E0_interval_95, 2.0));
}

TEST_CASE("a zero of time that was assumed widens E0 of relaxation and of creep", "[fit]") {
  const PronySeries truth = quick_material();
  RelaxationData data;
  CreepData creep;
  for (int i = 0; i < 400; ++i) {
    const double t = 0.1 * (i + 1);
    data.time_s.push_back(t - 0.05);  // the load came half a step earlier than assumed
    data.value.push_back(relaxation_modulus_Pa(truth, t));
    creep.time_s.push_back(t - 0.05);
    creep.compliance_1_Pa.push_back(1.0 - 0.3 * std::exp(-t / 0.4) - 0.2 * std::exp(-t / 6.0));
  }
  CHECK_FALSE(holds(fit_relaxation(data).E0_interval_95, 2.0));
  CHECK_FALSE(holds(fit_creep(creep, {}).E0_interval_95, 2.0));
  data.zero_unsure_s = 0.051;
  creep.zero_unsure_s = 0.06;  // to first order in the shift
  CHECK(holds(fit_relaxation(data).E0_interval_95, 2.0));
  CHECK(holds(fit_creep(creep, {}).E0_interval_95, 2.0));
}

TEST_CASE("rows that are known to be missing are no rounding of the others", "[fit]") {
  std::vector<double> time_s;
  std::size_t n_missing = 0;
  for (int i = 1; i <= 2000; ++i) {
    if (i % 97 == 6) {
      ++n_missing;
    } else {
      time_s.push_back(0.1 * i);
    }
  }
  CHECK(time_rounding(time_s));
  CHECK_FALSE(time_rounding(time_s, n_missing));
  // Times cut off to 0.1 s at 7 Hz are rounded, also if rows are missing.
  std::vector<double> cut_s;
  for (int i = 0; i < 600; ++i) {
    if (i % 97 != 6) cut_s.push_back(0.1 * std::floor(i / 0.7 + 1e-9));
  }
  CHECK(time_rounding(cut_s, 7));
}
