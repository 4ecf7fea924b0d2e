#include "fit/fit_creep.h"
#include "fit/fit_relaxation.h"
#include "fit/samples/end_rows.h"
#include "tests/fit/fit_checks.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>
#include <string>
#include <vector>

using namespace viscard;
using namespace viscard::test;

namespace {

constexpr const char* kFirst = "first-row-left-out";
constexpr const char* kLast = "last-row-left-out";

std::vector<double> times_of(const std::string& kind) {
  std::vector<double> time_s;
  if (kind == "even") {
    for (int i = 0; i < 3000; ++i) time_s.push_back(0.1 * i);
  } else if (kind == "coarse") {
    for (int i = 0; i < 300; ++i) time_s.push_back(i);
  } else {
    for (int i = 0; i < 200; ++i) time_s.push_back(0.01 * std::pow(10.0, 4.5 * i / 199.0));
    if (kind == "log from zero") time_s.insert(time_s.begin(), 0.0);
  }
  return time_s;
}

double modulus_Pa(double t_s) {
  return 0.4e6 + 0.3e6 * std::exp(-t_s / 0.5) + 0.3e6 * std::exp(-t_s / 30.0);
}

double compliance_1_Pa(double t_s) {
  return 3e-6 - 1e-6 * std::exp(-t_s / 0.5) - 1e-6 * std::exp(-t_s / 30.0);
}

template <class Curve>
std::vector<double> noisy(const std::vector<double>& time_s, const Curve& curve, unsigned seed,
                          double relative_noise = 0.002) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> values;
  for (const double t_s : time_s) {
    values.push_back(curve(t_s) * (1.0 + relative_noise * normal(random)));
  }
  return values;
}

std::size_t n_spikes_left_out(const FitResult& fit) {
  for (const LeftOutRows& left : fit.left_out) {
    if (left.reason == "spike") return left.count;
  }
  return 0;
}

// The wrong row is dropped, and the fit is that of the table without it.
void check_same_as_without(const FitResult& fit, const FitResult& without, const char* flag) {
  CHECK(has_flag(fit, flag));
  CHECK(n_spikes_left_out(fit) == 1);
  CHECK(fit.n_spikes == 1);
  CHECK(fit.n_samples == without.n_samples);
  CHECK(fit.E0_Pa == Approx(without.E0_Pa).epsilon(1e-4));
  CHECK(fit.E_inf_Pa == Approx(without.E_inf_Pa).epsilon(1e-4));
}

}  // namespace

TEST_CASE("a wrong first row of a relaxation is left out and named", "[fit]") {
  const auto* kind = GENERATE("even", "coarse", "log", "log from zero");
  const double factor = GENERATE(0.0, 0.1, -0.2);
  const unsigned seed = GENERATE(1U, 2U, 3U);
  CAPTURE(kind, factor, seed);
  RelaxationData data{.time_s = times_of(kind)};
  data.value = noisy(data.time_s, modulus_Pa, seed);
  const RelaxationData rest{.time_s = {data.time_s.begin() + 1, data.time_s.end()},
                            .value = {data.value.begin() + 1, data.value.end()}};
  data.value[0] *= factor;
  const FitResult fit = fit_relaxation(data);
  check_same_as_without(fit, fit_relaxation(rest), kFirst);
  // Steps of 1 s do not show the term of 0.5 s. The interval of E0 is not tested here: with seed 2 and
  // logarithmic times it misses the truth, with a fit equal to that of the table without the row.
  if (std::string(kind) != "coarse") CHECK(fit.E0_Pa == Approx(1e6).epsilon(0.02));
  for (const MaterialFlag& flag : fit.flags) {
    if (flag.name != kFirst) continue;
    CHECK(flag.text.find("the first row (t = 0") == 0);
    CHECK(flag.text.find("correct it or delete it") != std::string::npos);
  }
}

TEST_CASE("a first row that is a tenth too low costs one row only", "[fit]") {
  const unsigned seed = GENERATE(1U, 2U, 3U);
  RelaxationData data{.time_s = times_of("even")};
  data.value = noisy(data.time_s, modulus_Pa, seed);
  data.value[0] *= 0.9;
  const FitResult fit = fit_relaxation(data);
  CHECK(has_flag(fit, kFirst));
  CHECK(n_spikes_left_out(fit) == 1);
  CHECK(holds(fit.E0_interval_95, 1e6));
}

TEST_CASE("a wrong first row of a creep record is left out and named", "[fit]") {
  const auto* kind = GENERATE("even", "coarse", "log", "log from zero");
  const double factor = GENERATE(0.0, -0.2, 5.0);
  const unsigned seed = GENERATE(1U, 2U, 3U);
  CAPTURE(kind, factor, seed);
  CreepData data{.time_s = times_of(kind)};
  data.compliance_1_Pa = noisy(data.time_s, compliance_1_Pa, seed);
  const CreepData rest{
      .time_s = {data.time_s.begin() + 1, data.time_s.end()},
      .compliance_1_Pa = {data.compliance_1_Pa.begin() + 1, data.compliance_1_Pa.end()}};
  data.compliance_1_Pa[0] *= factor;
  check_same_as_without(fit_creep(data), fit_creep(rest), kFirst);
}

TEST_CASE("a wrong last row is left out and named", "[fit]") {
  const auto* kind = GENERATE("even", "log");
  const double factor = GENERATE(0.0, 0.5, 2.0);
  const unsigned seed = GENERATE(1U, 2U);
  CAPTURE(kind, factor, seed);
  RelaxationData data{.time_s = times_of(kind)};
  data.value = noisy(data.time_s, modulus_Pa, seed);
  const RelaxationData rest{.time_s = {data.time_s.begin(), data.time_s.end() - 1},
                            .value = {data.value.begin(), data.value.end() - 1}};
  data.value.back() *= factor;
  check_same_as_without(fit_relaxation(data), fit_relaxation(rest), kLast);
}

TEST_CASE("clean ends, fast terms and slow steps keep all rows", "[fit]") {
  const auto* kind = GENERATE("even", "coarse", "log", "log from zero");
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const std::vector<double> time_s = times_of(kind);
    for (const double noise : {0.0, 0.002, 0.03}) {
      CAPTURE(kind, seed, noise);
      const auto keeps_all = [&](const std::vector<double>& value, StepRecord record) {
        return !first_row(time_s, value, record).is_wrong &&
               !last_row(time_s, value, record).is_wrong;
      };
      std::vector<double> value = noisy(time_s, modulus_Pa, seed, noise);
      CHECK(keeps_all(value, StepRecord::kRelaxation));
      CHECK(keeps_all(noisy(time_s, compliance_1_Pa, seed, noise), StepRecord::kCreep));
      const auto melt = [](double t_s) {
        return 1e5 * std::exp(-t_s / 0.5) + 1e3 * std::exp(-t_s / 80.0);
      };
      CHECK(keeps_all(noisy(time_s, melt, seed, noise), StepRecord::kRelaxation));
      // From zero without a jump: a Voigt solid with a time of a few rows.
      const auto voigt = [](double t_s) { return 1e-6 * (1.0 - std::exp(-t_s / 4.0)); };
      CHECK(keeps_all(noisy(time_s, voigt, seed, noise), StepRecord::kCreep));
      value[0] *= 3.0;  // relaxes within one row
      CHECK(keeps_all(value, StepRecord::kRelaxation));
      value[0] = 0.0;  // the step takes two rows
      value[1] *= 0.5;
      CHECK(keeps_all(value, StepRecord::kRelaxation));
    }
  }
}
