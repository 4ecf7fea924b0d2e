#include "fit/curves/bin_arrays.h"
#include "fit/curves/step_model.h"
#include "fit/samples/decay.h"
#include "fit/samples/log_bins.h"
#include "fit/samples/sample_passes.h"
#include "fit/search/separable.h"
#include "models/maths/tall_products.h"
#include "tests/fit/spectra.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

using namespace viscard;
using namespace viscard::test;

namespace {

std::vector<double> random_values(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<double> values(count);
  for (double& value : values) value = normal(random);
  return values;
}

double residual_sum(const RelaxationData& data, const SpectralState& state) {
  double sum = 0.0, lost = 0.0;  // Kahan's compensated sum
  for (std::size_t i = 0; i < data.time_s.size(); ++i) {
    double value = state.coefficients[0];
    for (Eigen::Index k = 0; k < state.n_terms(); ++k) {
      value += state.coefficients[1 + k] * std::exp(-data.time_s[i] * std::exp(-state.ln_tau[k]));
    }
    const double part = std::pow(data.value[i] - value, 2) - lost;
    const double next = sum + part;
    lost = (next - sum) - part;
    sum = next;
  }
  return sum;
}

}  // namespace

TEST_CASE("exponentials of whole arrays equal those of the library", "[fit]") {
  std::vector<double> time_s, weight;
  for (double t = 1e-20; t < 79.9; t = 1.0007 * t + 1e-3) {
    time_s.push_back(t);
    weight.push_back(1.0);
  }
  DecayPlaces at;
  at.time_s = time_s.data();
  at.weight = weight.data();
  at.count = time_s.size();
  std::vector<double> value(time_s.size()), slope(time_s.size());
  decay_column(at, 1.0, value.data(), slope.data());
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    const double truth = std::exp(-time_s[i]);
    // A few units in the last place; rounding of the argument adds x of them.
    CHECK(std::abs(value[i] - truth) <= 4e-16 * (1.0 + time_s[i] * 0.1) * truth);
    CHECK(slope[i] == Approx(time_s[i] * truth).epsilon(1e-14).margin(1e-300));
  }
  decay_column(at, 100.0, value.data(), nullptr);
  CHECK(value.back() == 0.0);
  CHECK(value.front() == 1.0);
}

TEST_CASE("passes over records agree with sums of single samples", "[fit]") {
  const std::size_t count = GENERATE(1, 2, 3, 5, 17, 64, 1001);
  const std::vector<double> a = random_values(count, 3), b = random_values(count, 4);
  double sum = 0.0, dot = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    sum += a[i];
    dot += a[i] * b[i];
  }
  // A different order of summation: rounding of `count` terms of size 1.
  CHECK(sum_of(a) == Approx(sum).epsilon(0).margin(1e-12));
  CHECK(dot_of(a, b) == Approx(dot).epsilon(0).margin(1e-12));
  CHECK(all_finite(a));
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    std::vector<double> broken = a;
    broken[count / 2] = bad;
    CHECK_FALSE(all_finite(broken));
  }
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 1; i < count; ++i) {
    low = std::min(low, a[i] - a[i - 1]);
    high = std::max(high, a[i] - a[i - 1]);
  }
  const StepRange steps = step_range(a);
  CHECK(steps.shortest == (count > 1 ? low : 0.0));
  CHECK(steps.longest == (count > 1 ? high : 0.0));
  std::vector<std::size_t> far;
  for (std::size_t i = 1; i + 1 < count; ++i) {
    if (std::abs(a[i] - 0.5 * (a[i - 1] + a[i + 1])) > 2.0) far.push_back(i);
  }
  CHECK(far_from_neighbours(a, 2.0) == far);
}

TEST_CASE("moments of a bin equal those of its samples, also for merged bins", "[fit]") {
  std::vector<double> times = random_values(3000, 7);  // uneven
  for (double& t : times) t = 100.0 + 10.0 * std::abs(t);
  std::sort(times.begin(), times.end());
  const std::vector<double> values = random_values(3000, 8);
  const double per_decade = GENERATE(60.0, 30.0);
  const std::vector<LogBin> bins = per_decade > 50.0
                                       ? log_bins(times, values, per_decade)
                                       : merged_bins(log_bins(times, values, 60.0), per_decade);
  REQUIRE(bins.size() > 1);
  for (const LogBin& bin : bins) {
    double time = 0.0, value = 0.0;
    for (std::size_t i = bin.begin; i < bin.end; ++i) {
      time += times[i] / bin.count;
      value += values[i] / bin.count;
    }
    double powers[7] = {}, with_value[4] = {}, square = 0.0;
    for (std::size_t i = bin.begin; i < bin.end; ++i) {
      const double d = times[i] - time, y = values[i] - value;
      for (int k = 0; k < 7; ++k) powers[k] += std::pow(d, k) / bin.count;
      for (int k = 0; k < 4; ++k) with_value[k] += y * std::pow(d, k) / bin.count;
      square += y * y / bin.count;
    }
    // Rounding of t - mean is 1e-14; the widths are some seconds.
    const double width = std::sqrt(powers[2]) + 1e-6;
    CHECK(bin.time_s == Approx(time).epsilon(1e-14));
    CHECK(bin.m2 == Approx(powers[2]).epsilon(1e-9).margin(1e-12 * width * width));
    CHECK(bin.m3 == Approx(powers[3]).epsilon(1e-9).margin(1e-11 * std::pow(width, 3)));
    CHECK(bin.m4 == Approx(powers[4]).epsilon(1e-9).margin(1e-11 * std::pow(width, 4)));
    CHECK(bin.m5 == Approx(powers[5]).epsilon(1e-9).margin(1e-10 * std::pow(width, 5)));
    CHECK(bin.m6 == Approx(powers[6]).epsilon(1e-9).margin(1e-10 * std::pow(width, 6)));
    CHECK(bin.c1 == Approx(with_value[1]).epsilon(1e-9).margin(1e-11 * width));
    CHECK(bin.c2 == Approx(with_value[2]).epsilon(1e-9).margin(1e-11 * std::pow(width, 2)));
    CHECK(bin.c3 == Approx(with_value[3]).epsilon(1e-9).margin(1e-10 * std::pow(width, 3)));
    CHECK(bin.value_m2 == Approx(square).epsilon(1e-9).margin(1e-12));
  }
}

TEST_CASE("averages and the sums within them give the residual sum of all samples", "[fit]") {
  const bool is_even = GENERATE(true, false);
  RelaxationData data = relaxation_of(s2(), 75000, 1000.0, 0.01, 5);
  if (!is_even) {  // every third sample is missing
    RelaxationData part;
    for (std::size_t i = 0; i < data.time_s.size(); ++i) {
      if (i % 3 == 1) continue;
      part.time_s.push_back(data.time_s[i]);
      part.value.push_back(data.value[i]);
    }
    data = part;
  }
  const StepModel model(data.time_s, data.value, StepShape::kRelaxation, {});
  Eigen::VectorXd ln_tau(2);
  ln_tau << std::log(0.8), std::log(40.0);
  const SpectralState state = solve_coefficients(model, ln_tau, {});
  const double sum = state.rss + model.hidden_rss(state);
  CHECK(sum == Approx(residual_sum(data, state)).epsilon(3e-10));  // see bin_arrays.h
}
