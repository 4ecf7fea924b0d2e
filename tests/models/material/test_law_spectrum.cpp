#include "models/material/law_spectrum.h"
#include "models/material/prony_series.h"
#include "models/maths/mittag_leffler.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <stdexcept>

using namespace viscard;

namespace {

using Index = Eigen::Index;

// The law with tau = 1 s as a Prony series; growth: the same with 1 - exp in the place of exp.
PronySeries dense(DecayShape shape, double exponent, bool is_growth = false) {
  const LogGrid grid = grid_for_times(std::log(1e-4), std::log(1e4));
  const Eigen::VectorXd weights =
      weights_on_grid(DecaySpectrum(shape, exponent, is_growth), 0.0, grid);
  PronySeries series;
  for (Index j = 0; j < grid.count; ++j) {
    series.terms.push_back({weights[j], std::exp(grid.at(j))});
  }
  return series;
}

double decay(const PronySeries& series, double t) {
  double sum = 0.0;
  for (const MaxwellTerm& term : series.terms) {
    sum += term.modulus_Pa * std::exp(-t / term.relaxation_time_s);
  }
  return sum;
}
double growth(const PronySeries& series, double t) {
  double sum = 0.0;
  for (const MaxwellTerm& term : series.terms) {
    sum -= term.modulus_Pa * std::expm1(-t / term.relaxation_time_s);
  }
  return sum;
}
// Response to a ramp of rate 1 from t = 0.
double ramp(const PronySeries& series, double t) {
  double sum = 0.0;
  for (const MaxwellTerm& term : series.terms) {
    sum -= term.modulus_Pa * term.relaxation_time_s * std::expm1(-t / term.relaxation_time_s);
  }
  return sum;
}

}  // namespace

TEST_CASE("a stretched exponential is its integral over exponentials", "[models][identity]") {
  for (const double beta : {0.1, 0.3, 0.5, 0.8, 0.95}) {
    const PronySeries series = dense(DecayShape::kStretched, beta);
    for (const double t : {1e-4, 1e-2, 0.3, 1.0, 4.0}) {
      CAPTURE(beta, t);
      CHECK(decay(series, t) == Approx(std::exp(-std::pow(t, beta))).margin(2e-6));
    }
  }
  // beta = 1/2 has the density exp(-T/4)/(2 sqrt(pi)) sqrt(T) in ln T.
  const DecaySpectrum half(DecayShape::kStretched, 0.5, false);
  for (const double s : {-6.0, -1.0, 0.0, 1.5, 3.0}) {
    CHECK(half.density(s) ==
          Approx(std::exp(-0.25 * std::exp(s)) * std::exp(0.5 * s) / std::sqrt(4.0 * M_PI))
              .epsilon(1e-8));
  }
}

TEST_CASE("a Mittag-Leffler decay is its integral over exponentials", "[models][identity]") {
  for (const double alpha : {0.1, 0.3, 0.5, 0.8, 0.95, 0.99}) {
    const PronySeries series = dense(DecayShape::kMittagLeffler, alpha);
    for (const double t : {1e-4, 1e-2, 0.3, 1.0, 4.0, 300.0}) {
      CAPTURE(alpha, t);
      CHECK(decay(series, t) ==
            Approx(mittag_leffler_decay(alpha, std::pow(t, alpha))).margin(2e-6));
    }
  }
  // mpmath: E_0.8(-1) and E_0.95(-3).
  CHECK(decay(dense(DecayShape::kMittagLeffler, 0.8), 1.0) ==
        Approx(0.386948578618977).margin(2e-6));
  CHECK(decay(dense(DecayShape::kMittagLeffler, 0.95), std::pow(3.0, 1.0 / 0.95)) ==
        Approx(0.0675320222140719).margin(2e-6));
}

TEST_CASE("power laws decay and grow with their gamma functions", "[models][identity]") {
  for (const double alpha : {0.05, 0.3, 0.6, 0.95}) {
    const PronySeries falling = dense(DecayShape::kPowerLaw, alpha);
    const PronySeries rising = dense(DecayShape::kPowerLaw, alpha, true);
    for (const double t : {1e-4, 0.1, 1.0, 1e4}) {
      CAPTURE(alpha, t);
      CHECK(decay(falling, t) ==
            Approx(std::pow(t, -alpha) / std::tgamma(1.0 - alpha)).epsilon(2e-6));
      CHECK(growth(rising, t) ==
            Approx(std::pow(t, alpha) / std::tgamma(1.0 + alpha)).epsilon(2e-6));
      // Ramp and oscillation: int E = t^(1 - alpha)/Gamma(2 - alpha), E* = (i w)^alpha.
      CHECK(ramp(falling, t) ==
            Approx(std::pow(t, 1.0 - alpha) / std::tgamma(2.0 - alpha)).epsilon(2e-6));
      const ComplexModulus dynamic = complex_modulus_Pa(falling, 1.0 / t);
      CHECK(dynamic.storage_Pa ==
            Approx(std::pow(t, -alpha) * std::cos(0.5 * M_PI * alpha)).epsilon(2e-6));
      CHECK(dynamic.loss_Pa ==
            Approx(std::pow(t, -alpha) * std::sin(0.5 * M_PI * alpha)).epsilon(2e-6));
    }
  }
}

TEST_CASE("ramps and oscillations of the laws agree with values of mpmath", "[models]") {
  const auto of = [](DecayShape shape, double exponent) { return dense(shape, exponent); };
  // t E_(alpha,2)(-t^alpha)
  CHECK(ramp(of(DecayShape::kMittagLeffler, 0.4), 0.2) == Approx(0.139462981519122).margin(1e-6));
  CHECK(ramp(of(DecayShape::kMittagLeffler, 0.4), 1.5) == Approx(0.753532588492018).margin(2e-6));
  CHECK(ramp(of(DecayShape::kMittagLeffler, 0.7), 1.5) == Approx(0.760287659310105).margin(2e-6));
  // gamma(1/beta, t^beta)/beta
  CHECK(ramp(of(DecayShape::kStretched, 0.3), 0.2) == Approx(0.125240432741588).margin(1e-6));
  CHECK(ramp(of(DecayShape::kStretched, 0.8), 1.5) == Approx(0.748606487331838).margin(2e-6));
  // i w int exp(-t^beta - i w t) dt
  const auto dynamic = [&](double beta, double w) {
    return complex_modulus_Pa(of(DecayShape::kStretched, beta), w);
  };
  CHECK(dynamic(0.3, 10.0).storage_Pa == Approx(0.661349902714934).margin(2e-6));
  CHECK(dynamic(0.3, 10.0).loss_Pa == Approx(0.130829531479997).margin(2e-6));
  CHECK(dynamic(0.8, 0.1).storage_Pa == Approx(0.0161353916535974).margin(2e-6));
  CHECK(dynamic(0.8, 0.1).loss_Pa == Approx(0.110628301919023).margin(2e-6));
}

TEST_CASE("a coarse spectrum has positive weights and keeps the whole", "[models]") {
  const LogGrid grid{std::log(1e-3), 1.15, 13};
  for (const DecayShape shape : {DecayShape::kStretched, DecayShape::kMittagLeffler}) {
    const CoarseSpectrum found = coarse_spectrum(DecaySpectrum(shape, 0.4, false), 0.0, grid);
    CHECK(found.weights.minCoeff() >= 0.0);
    PronySeries series;
    for (Index j = 0; j < grid.count; ++j) {
      series.terms.push_back({found.weights[j], std::exp(grid.at(j))});
    }
    const double exact =
        shape == DecayShape::kStretched ? std::exp(-1.0) : mittag_leffler_decay(0.4, 1.0);
    CHECK(decay(series, 1.0) + found.slower == Approx(exact).epsilon(2e-3));
  }
  CHECK_THROWS_AS(DecaySpectrum(DecayShape::kStretched, 1.0, false), std::invalid_argument);
}
