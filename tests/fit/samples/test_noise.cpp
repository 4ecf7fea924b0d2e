#include "fit/fit_relaxation.h"
#include "fit/samples/noise_model.h"
#include "tests/fit/spectra.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace viscard;
using namespace viscard::test;

namespace {

Eigen::VectorXd ar1(double rho, Eigen::Index n, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  Eigen::VectorXd x(n);
  x[0] = normal(random);
  for (Eigen::Index i = 1; i < n; ++i) {
    x[i] = rho * x[i - 1] + std::sqrt(1.0 - rho * rho) * normal(random);
  }
  return x;
}

}  // namespace

TEST_CASE("the autoregression of white noise has order zero", "[fit]") {
  CHECK(autoregression(ar1(0.0, 4000, GENERATE(1U, 2U, 3U))).inflation() == 1.0);
}

TEST_CASE("the autoregression finds the correlation of the noise", "[fit]") {
  const double rho = GENERATE(0.5, 0.9, 0.97);
  const Autoregression noise = autoregression(ar1(rho, 100000, 4));
  // The standard error of rho from 1e5 values is sqrt((1 - rho^2)/1e5) < 0.003; that of the
  // inflation is 2/(1 - rho^2) times that, at most 10 %.
  CHECK(noise.autocorrelation()[1] == Approx(rho).margin(0.01));
  CHECK(noise.inflation() == Approx((1.0 + rho) / (1.0 - rho)).epsilon(0.25));
}

TEST_CASE("sums over pairs of stretches equal the double sum", "[fit]") {
  const PairSums sums(Autoregression{{0.6, 0.2}});
  const std::vector<double> rho = Autoregression{{0.6, 0.2}}.autocorrelation();
  const auto direct = [&](int p, int q, int distance) {
    double sum = 0.0;
    for (int i = 0; i < p; ++i) {
      for (int j = 0; j < q; ++j) {
        const auto lag = static_cast<std::size_t>(std::abs(distance + j - i));
        sum += lag < rho.size() ? rho[lag] : 0.0;
      }
    }
    return sum;
  };
  CHECK(sums.over(7, 7, 0) == Approx(direct(7, 7, 0)).epsilon(1e-10));
  CHECK(sums.over(5, 9, 5) == Approx(direct(5, 9, 5)).epsilon(1e-10));
  CHECK(sums.over(300, 200, 310) == Approx(direct(300, 200, 310)).epsilon(1e-6));
}

TEST_CASE("the scatter from differences ignores trends and spikes", "[fit]") {
  const Eigen::VectorXd noise = ar1(0.0, 10000, 5);
  std::vector<double> values;
  for (Eigen::Index i = 0; i < noise.size(); ++i) {
    const double t = static_cast<double>(i);
    values.push_back(0.1 * noise[i] + 3.0 * std::exp(-t / 500.0) + (i % 500 == 7 ? 20.0 : 0.0));
  }
  CHECK(sigma_from_differences(values) == Approx(0.1).epsilon(0.05));
}

namespace {

// Share of runs whose 95 % intervals hold E_inf, E_1 and ln tau_2 of S2.
struct Coverage {
  double E_inf = 0.0, E_1 = 0.0, tau_2 = 0.0;
};

Coverage coverage(double rho, int runs) {
  Coverage share;
  for (int run = 0; run < runs; ++run) {
    FitOptions options;
    options.n_terms = 2;
    options.with_curves = false;
    const FitResult fit = fit_relaxation(
        relaxation_of(s2(), 4000, 1000.0, 0.01, 1000 + static_cast<std::uint64_t>(run), rho),
        options);
    const auto holds = [](const Interval& interval, double value) {
      return value >= interval.low && value <= interval.high ? 1.0 : 0.0;
    };
    share.E_inf += holds(fit.E_inf_interval_95, 1.6) / runs;
    if (fit.terms.size() < 2) continue;
    share.E_1 += holds(fit.terms[0].modulus_Pa_95, 0.12) / runs;
    share.tau_2 += holds(fit.terms[1].tau_s_95, 40.0) / runs;
  }
  return share;
}

}  // namespace

TEST_CASE(
    "95 % intervals hold the truth in 90 to 99 % of runs for any autocorrelation of the noise",
    "[fit][slow]") {
  const double rho = GENERATE(0.0, 0.5, 0.9, 0.97);
  CAPTURE(rho);
  const Coverage share = coverage(rho, 400);
  // 400 runs determine the share to about +-1.1 %.
  for (const double value : {share.E_inf, share.E_1, share.tau_2}) {
    CHECK(value >= 0.90);
    CHECK(value <= 0.99);
  }
}

TEST_CASE("intervals widen with the autocorrelation of the noise", "[fit]") {
  const double rho = GENERATE(0.0, 0.9);
  CAPTURE(rho);
  const Coverage share = coverage(rho, 40);
  // 40 runs at 95 %: fewer than 33 hold with a probability below one in a thousand.
  CHECK(share.E_inf >= 0.82);
  CHECK(share.E_1 >= 0.82);
  CHECK(share.tau_2 >= 0.82);
}
