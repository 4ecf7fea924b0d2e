#include "fit/laws/fit_mixing_ratio.h"
#include "fit/laws/nested_likelihood.h"
#include "fit/laws/scatter_levels.h"
#include "tests/fit/laws/campaigns.h"
#include "tests/support/error_text.h"

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <iostream>
#include <random>

using namespace viscard;
using namespace viscard::test;
using Catch::Contains;

namespace {

// Ratios, specimens and touches with known deviations between them.
struct NestedDesign {
  std::vector<std::vector<int>> touches;  // of each specimen of each ratio
  double touch = 0.02, specimen = 0.05, ratio = 0.05, own_error = 0.002;
};

NestedDesign balanced(int ratios, int specimens, int touches) {
  const std::vector<int> one(static_cast<std::size_t>(specimens), touches);
  return {std::vector<std::vector<int>>(static_cast<std::size_t>(ratios), one)};
}

RatioModel straight_law(std::size_t n_ratios) {
  RatioModel law;
  law.form.E0_degree = 1;
  for (std::size_t r = 0; r < n_ratios; ++r)
    law.ratios.push_back(8.0 + 3.0 * static_cast<double>(r));
  return law;
}

std::vector<NestedRecord> drawn(const NestedDesign& design, std::mt19937_64& dice) {
  std::normal_distribution<double> normal;
  const RatioModel law = straight_law(design.touches.size());
  std::vector<NestedRecord> records;
  int number = 0;
  for (std::size_t r = 0; r < design.touches.size(); ++r) {
    const double at_ratio = 14.0 - std::log(law.ratios[r]) + design.ratio * normal(dice);
    for (const int n_touches : design.touches[r]) {
      const double of_specimen = at_ratio + design.specimen * normal(dice);
      for (int k = 0; k < n_touches; ++k) {
        const double error = design.own_error * (0.7 + 0.2 * (k % 4));
        const double value = of_specimen + design.touch * normal(dice) + error * normal(dice);
        records.push_back({value, error * error, number, law.ratios[r]});
      }
      ++number;
    }
  }
  return records;
}

// -2 ln L of the restricted likelihood from the full covariance matrix, without any pooling
// (Searle, Casella & McCulloch, Variance Components (1992), eq. 6.67).
double dense_minus_twice(const std::vector<NestedRecord>& records, const RatioModel& law,
                         const Deviations& deviations) {
  const auto n = static_cast<Eigen::Index>(records.size());
  Eigen::MatrixXd covariance(n, n), design(n, 2);
  Eigen::VectorXd values(n);
  const ScaledVariable scaled = scale_of(law);
  for (Eigen::Index i = 0; i < n; ++i) {
    const NestedRecord& a = records[static_cast<std::size_t>(i)];
    values[i] = a.value - 12.0;
    design(i, 0) = 1.0;
    design(i, 1) = (std::log(a.ratio) - scaled.middle) / scaled.half;
    for (Eigen::Index j = 0; j < n; ++j) {
      const NestedRecord& b = records[static_cast<std::size_t>(j)];
      covariance(i, j) = (a.ratio == b.ratio ? std::pow(deviations[2], 2) : 0.0) +
                         (a.specimen == b.specimen ? std::pow(deviations[1], 2) : 0.0);
      if (i == j) covariance(i, j) += std::pow(deviations[0], 2) + a.variance;
    }
  }
  const Eigen::MatrixXd inverse = covariance.inverse();
  const Eigen::MatrixXd normal = design.transpose() * inverse * design;
  const Eigen::VectorXd beta = normal.inverse() * design.transpose() * inverse * values;
  const Eigen::VectorXd rest = values - design * beta;
  return std::log(covariance.determinant()) + std::log(normal.determinant()) +
         rest.dot(inverse * rest);
}

// How many intervals of each level hold the truth, and of how many.
struct LevelCoverage {
  std::array<int, 3> held{}, identified{};
};
LevelCoverage coverage_of(const NestedDesign& design, int runs, std::uint64_t seed) {
  std::mt19937_64 dice(seed);
  LevelCoverage count;
  for (int run = 0; run < runs; ++run) {
    const Scatter found =
        scatter_of("ln_E0", drawn(design, dice), straight_law(design.touches.size()), 1);
    const std::array<const ScatterLevel*, 3> levels{&found.touch, &found.specimen, &found.ratio};
    const std::array<double, 3> truth{design.touch, design.specimen, design.ratio};
    for (std::size_t k = 0; k < levels.size(); ++k) {
      if (!is_identified(*levels[k])) continue;
      ++count.identified[k];
      count.held[k] +=
          levels[k]->interval_95.low <= truth[k] && truth[k] <= levels[k]->interval_95.high;
    }
  }
  return count;
}

void check_shares(const LevelCoverage& count, double low, double high) {
  for (std::size_t k = 0; k < 3; ++k) {
    CAPTURE(k, count.held[k], count.identified[k]);
    CHECK(count.held[k] >= low * count.identified[k]);
    CHECK(count.held[k] <= high * count.identified[k]);
  }
}

// Prints the shares of intervals that hold the truth (fit/laws/README.md).
void print_and_check(const char* name, const NestedDesign& design, std::uint64_t seed) {
  const LevelCoverage count = coverage_of(design, 400, seed);
  std::cout << name << ":";
  for (std::size_t k = 0; k < 3; ++k) {
    std::cout << " " << 100.0 * count.held[k] / count.identified[k] << " %";
  }
  std::cout << "\n";
  check_shares(count, 0.92, 1.0);
}

}  // namespace

TEST_CASE("the pooled likelihood of nested records is that of their covariance matrix",
          "[fit][joint]") {
  std::mt19937_64 dice(3);
  const NestedDesign design{{{2, 1}, {3}, {1, 2, 4}, {2}}, 0.02, 0.03, 0.06, 0.01};
  const std::vector<NestedRecord> records = drawn(design, dice);
  const RatioModel law = straight_law(4);
  const NestedLikelihood likelihood(records, law, 1);
  CHECK(likelihood.degrees_of_freedom() == std::array<int, 3>{8, 3, 2});
  const Deviations base{0.01, 0.02, 0.05};
  for (const Deviations& at :
       {Deviations{0.03, 0.02, 0.05}, Deviations{0.01, 0.0, 0.1}, Deviations{0.02, 0.04, 0.0}}) {
    const double rise = likelihood.minus_twice(at) - likelihood.minus_twice(base);
    CHECK(rise ==
          Approx(dense_minus_twice(records, law, at) - dense_minus_twice(records, law, base))
              .epsilon(1e-8));
  }
}

TEST_CASE("for a balanced design the components are those of the analysis of variance",
          "[fit][joint]") {
  // With equal numbers and errors, restricted maximum likelihood gives the mean squares' estimates
  // if none is negative (Searle, Casella & McCulloch (1992), ch. 4.5).
  std::mt19937_64 dice(8);
  NestedDesign design = balanced(6, 5, 4);
  design.own_error = 1e-6;
  design.ratio = 0.1;
  const std::vector<NestedRecord> records = drawn(design, dice);
  const Scatter found = scatter_of("ln_E0", records, straight_law(6), 1);
  double within = 0.0, between = 0.0;
  for (int r = 0; r < 6; ++r) {
    double ratio_mean = 0.0;
    std::array<double, 5> means{};
    for (int s = 0; s < 5; ++s) {
      for (int k = 0; k < 4; ++k) {
        means[static_cast<std::size_t>(s)] +=
            records[static_cast<std::size_t>((5 * r + s) * 4 + k)].value / 4.0;
      }
      ratio_mean += means[static_cast<std::size_t>(s)] / 5.0;
    }
    for (int s = 0; s < 5; ++s) {
      const double mean = means[static_cast<std::size_t>(s)];
      between += 4.0 * std::pow(mean - ratio_mean, 2) / (6 * 4);
      for (int k = 0; k < 4; ++k) {
        within += std::pow(records[static_cast<std::size_t>((5 * r + s) * 4 + k)].value - mean, 2) /
                  (30 * 3);
      }
    }
  }
  // The search ends when -2 ln L changes by less than 1e-5.
  CHECK(found.touch.deviation == Approx(std::sqrt(within)).epsilon(2e-3));
  CHECK(found.specimen.deviation == Approx(std::sqrt((between - within) / 4.0)).epsilon(5e-3));
  CHECK(found.touch.degrees_of_freedom == 90);
  CHECK(found.specimen.degrees_of_freedom == 24);
  CHECK(found.ratio.degrees_of_freedom == 4);
}

TEST_CASE("a level that the records cannot identify is reported as such", "[fit][joint]") {
  std::mt19937_64 dice(4);
  SECTION("one touch per specimen") {
    const Scatter found = scatter_of("ln_E0", drawn(balanced(3, 3, 1), dice), straight_law(3), 1);
    CHECK_FALSE(is_identified(found.touch));
    CHECK(found.touch.note == "every specimen was touched once");
    CHECK(found.specimen.note == "includes the scatter between touches");
    CHECK(found.ratio.note.empty());
  }
  SECTION("one specimen per ratio") {
    const Scatter found = scatter_of("ln_E0", drawn(balanced(4, 1, 3), dice), straight_law(4), 1);
    CHECK(is_identified(found.touch));
    CHECK_FALSE(is_identified(found.specimen));
    CHECK(found.ratio.note == "includes the scatter between specimens");
  }
  SECTION("as many coefficients as ratios") {
    const Scatter found = scatter_of("ln_E0", drawn(balanced(2, 3, 2), dice), straight_law(2), 1);
    CHECK(is_identified(found.specimen));
    CHECK_FALSE(is_identified(found.ratio));
    CHECK_THAT(found.ratio.note, Contains("2 coefficients, as many as there are ratios"));
  }
}

TEST_CASE("intervals of the three levels hold the truth", "[fit][joint]") {
  // 60 campaigns: 95 % is 57 +- 1.7.
  check_shares(coverage_of(balanced(3, 3, 3), 60, 5), 0.87, 1.0);
}

// 400 campaigns: 95 % is 380 +- 4.4. The ratios have one or two degrees of freedom and upper ends far
// away, so their intervals hold more.
TEST_CASE("intervals of the three levels hold 95 % of many truths", "[fit][joint][slow]") {
  print_and_check("3 x 3 x 3", balanced(3, 3, 3), 50);
  print_and_check("3 x 2 x 2", balanced(3, 2, 2), 51);
  const NestedDesign uneven{{{1, 3}, {2, 4, 1, 3}, {2, 4, 1}, {3}}, 0.02, 0.03, 0.06, 0.01};
  print_and_check("uneven", uneven, 52);
  NestedDesign alike = balanced(3, 3, 3);
  alike.specimen = alike.ratio = 0.0;
  print_and_check("3 x 3 x 3, touches only", alike, 53);
  NestedDesign noisy = balanced(5, 4, 2);
  noisy.own_error = 0.03;
  print_and_check("5 x 4 x 2, own error above the touches", noisy, 54);
}
