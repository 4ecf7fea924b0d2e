#include "fit/reduce_terms.h"
#include "tests/cards/card_materials.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace viscard;
using namespace viscard::test;

namespace {

constexpr double kFrom_s = 1e-4, kTo_s = 1e6;

// Thirty terms over ten decades, bell-shaped and uneven.
PronySeries thirty_terms(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  PronySeries series{1e6 * (0.05 + unit(random)), {}};
  for (int i = 0; i < 30; ++i) {
    const double bell = std::exp(-std::pow((i - 15) / 7.0, 2.0));
    series.terms.push_back(
        {1e6 * unit(random) * bell, 1e-4 * std::pow(10.0, (i + unit(random)) / 3.0)});
  }
  return series;
}

// Heights of the alternating peaks of E'/E - 1 over the window.
std::vector<double> peak_heights(const PronySeries& reduced, const PronySeries& series) {
  std::vector<double> peaks;
  bool was_positive = false;
  for (int i = 0; i < 4000; ++i) {
    const double t_s = kFrom_s * std::pow(kTo_s / kFrom_s, i / 3999.0);
    const double r = relaxation_modulus_Pa(reduced, t_s) / relaxation_modulus_Pa(series, t_s) - 1.0;
    if (peaks.empty() || (r > 0.0) != was_positive) {
      peaks.push_back(std::abs(r));
    } else {
      peaks.back() = std::max(peaks.back(), std::abs(r));
    }
    was_positive = r > 0.0;
  }
  return peaks;
}

double error_of(const PronySeries& one, const PronySeries& reference) {
  double error = 0.0;
  for (int i = 0; i < 300; ++i) {
    const double t_s = kFrom_s * std::pow(kTo_s / kFrom_s, i / 299.0);
    error = std::max(
        error,
        std::abs(relaxation_modulus_Pa(one, t_s) / relaxation_modulus_Pa(reference, t_s) - 1.0));
  }
  return error;
}

}  // namespace

TEST_CASE("thirty terms become six with 14 alternating equal peaks, so none can be better",
          "[cards][fit]") {
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U}) {
    CAPTURE(seed);
    const PronySeries series = thirty_terms(seed);
    const ReducedSeries reduced = reduce_terms(series, 6, kFrom_s, kTo_s);
    REQUIRE(reduced.series.terms.size() == 6);
    const std::vector<double> peaks = peak_heights(reduced.series, series);
    CAPTURE(peaks);
    // de la Vallee-Poussin: the best error lies between the smallest and the largest of 2n + 2
    // peaks.
    REQUIRE(peaks.size() >= 14);
    const double lowest = *std::min_element(peaks.begin(), peaks.end());
    CHECK(reduced.largest_error <= 1.02 * lowest);  // the grid of the exchange
    CHECK(reduced.largest_error == Approx(error_of(reduced.series, series)).epsilon(0.01));
  }
}

TEST_CASE("a random search around the reduced series finds nothing better", "[cards][fit]") {
  const PronySeries series = thirty_terms(9);
  const ReducedSeries reduced = reduce_terms(series, 6, kFrom_s, kTo_s);
  std::mt19937 random(77);
  std::normal_distribution<double> normal;
  PronySeries best = reduced.series;
  double best_error = error_of(best, series);
  const double found = best_error;
  for (int trial = 0; trial < 3000; ++trial) {
    PronySeries other = best;
    const double size = std::pow(10.0, -1.0 - 3.0 * (trial % 7) / 6.0);
    other.equilibrium_modulus_Pa *= std::exp(size * normal(random));
    for (MaxwellTerm& term : other.terms) {
      term.modulus_Pa *= std::exp(size * normal(random));
      term.relaxation_time_s *= std::exp(size * normal(random));
    }
    const double error = error_of(other, series);
    if (error < best_error) {
      best_error = error;
      best = other;
    }
  }
  CHECK(best_error >= 0.95 * found);
}

TEST_CASE("a series with no more terms than requested is not changed", "[cards][fit]") {
  const PronySeries series = thirty_terms(3);
  const ReducedSeries same = reduce_terms(series, 30, kFrom_s, kTo_s);
  CHECK(same.largest_error == 0.0);
  CHECK(same.series.terms[4].modulus_Pa == series.terms[4].modulus_Pa);
  CHECK_THROWS_WITH(reduce_terms(series, 0, kFrom_s, kTo_s), Catch::Contains("one term"));
  CHECK_THROWS_WITH(reduce_terms(series, 3, 1.0, 0.5), Catch::Contains("t_min < t_max"));
}

TEST_CASE("thirty terms that are six split ones are reduced to six with no error but rounding",
          "[cards][fit][reduction]") {
  PronySeries series{2e5, {}};
  for (int i = 0; i < 6; ++i) {
    // Each split into five equal parts of the same time: a 30-term series that is a 6-term one.
    for (int part = 0; part < 5; ++part) {
      series.terms.push_back({2e4 * (1.0 + i), 1e-3 * std::pow(10.0, 1.4 * i)});
    }
  }
  const ReducedSeries reduced = reduce_terms(series, 6, kFrom_s, kTo_s);
  CHECK(reduced.largest_error < 1e-6);
}

TEST_CASE("a reduced material keeps its bulk rule and states its error over the window",
          "[cards][fit]") {
  for (const bool is_constant_bulk : {false, true}) {
    CAPTURE(is_constant_bulk);
    Material material = material_of_terms(30, 0.4);
    material.valid = {1e-3, 1e6, 0.0};
    if (is_constant_bulk) {
      for (MaterialTerm& term : material.terms) term.k = 0.0;
    }
    const ReducedMaterial reduced = reduce_material(material, 6);
    REQUIRE(reduced.material.terms.size() == 6);
    CHECK_NOTHROW(validate(reduced.material));
    CHECK(has_constant_poisson_ratio(reduced.material) == !is_constant_bulk);
    double error = 0.0;
    const PronySeries before = young_series(material), after = young_series(reduced.material);
    for (double t_s = 1e-3; t_s <= 1e6; t_s *= 1.17) {
      error = std::max(
          error,
          std::abs(relaxation_modulus_Pa(after, t_s) / relaxation_modulus_Pa(before, t_s) - 1.0));
    }
    CHECK(error <= reduced.largest_error * (1.0 + 1e-9));
    CHECK(error >= 0.9 * reduced.largest_error);
    CHECK(reduced.largest_error < 0.02);
  }
  Material own = material_of_terms(8, 0.3);
  own.terms[2].k = 0.1;
  CHECK_THROWS_WITH(reduce_material(own, 4), Catch::Contains("bulk terms of their own"));
}
