#include "fit/fit_relaxation.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>

using namespace viscard;

// NIST Statistical Reference Datasets, Nonlinear Regression (www.itl.nist.gov/div898/strd), public
// domain.
namespace {

struct Certified {
  const char* format;  // the Lanczos data are the same sum printed to 13, 6 and 5 digits
  double b[6];         // amplitude, rate; slowest first
  double rss;
  double parameter_error;  // allowed relative error
};

// 0.0951 exp(-x) + 0.8607 exp(-3x) + 1.5576 exp(-5x)
const Certified kLanczos[] = {
    {"%.12E",
     {9.5100000027e-2, 1.0000000001, 8.6070000013e-1, 3.0000000002, 1.5575999998, 5.0000000001},
     1.4307867721e-25,
     1e-9},
    {"%.5E",
     {9.6251029939e-2, 1.0057332849, 8.6424689056e-1, 3.0078283915, 1.5529016879, 5.0028798100},
     2.2299428125e-11,
     1e-9},
    {"%.4f",
     {8.6816414977e-2, 9.5498101505e-1, 8.4400777463e-1, 2.9515951832, 1.5825685901, 4.9863565084},
     1.6117193594e-8,
     1e-9}};

RelaxationData lanczos_data(const char* format) {
  RelaxationData data;
  for (int i = 0; i < 24; ++i) {
    const double x = 0.05 * i;
    char text[40];
    std::snprintf(text, sizeof text, format,
                  0.0951 * std::exp(-x) + 0.8607 * std::exp(-3 * x) + 1.5576 * std::exp(-5 * x));
    data.time_s.push_back(x);
    data.value.push_back(std::atof(text));
  }
  return data;
}

}  // namespace

TEST_CASE("Lanczos problems give nine digits of every certified parameter without start values",
          "[fit]") {
  const auto& problem = kLanczos[GENERATE(0, 1, 2)];
  FitOptions options;
  options.is_liquid = true;
  options.n_terms = 3;
  options.white_noise = true;
  const FitResult fit = fit_relaxation(lanczos_data(problem.format), options);
  CHECK(fit.is_converged);
  REQUIRE(fit.terms.size() == 3);
  // Certified values have 11 digits.
  for (int i = 0; i < 3; ++i) {
    const FittedTerm& term = fit.terms[static_cast<std::size_t>(2 - i)];
    CHECK(term.modulus_Pa == Approx(problem.b[2 * i]).epsilon(problem.parameter_error));
    CHECK(1.0 / term.tau_s == Approx(problem.b[2 * i + 1]).epsilon(problem.parameter_error));
  }
  // The residual of Lanczos1 is the rounding error of the data themselves.
  CHECK(fit.rss == Approx(problem.rss).epsilon(problem.rss < 1e-20 ? 2e-3 : 1e-9));
}

TEST_CASE("Lanczos3 gives six digits of every certified standard deviation", "[fit]") {
  FitOptions options;
  options.is_liquid = true;
  options.n_terms = 3;
  options.white_noise = true;
  const FitResult fit = fit_relaxation(lanczos_data("%.4f"), options);
  const double sd[] = {1.7197908859e-2, 9.7041624475e-2, 4.1488663282e-2,
                       1.0766312506e-1, 5.8371576281e-2, 3.4436403035e-2};
  for (int i = 0; i < 3; ++i) {
    const FittedTerm& term = fit.terms[static_cast<std::size_t>(2 - i)];
    CHECK(term.modulus_se_Pa == Approx(sd[2 * i]).epsilon(1e-6));
    CHECK(term.ln_tau_se / term.tau_s == Approx(sd[2 * i + 1]).epsilon(1e-6));
  }
}

TEST_CASE("the number of Lanczos terms is found from the data", "[fit]") {
  FitOptions options;
  options.is_liquid = true;
  const FitResult fit = fit_relaxation(lanczos_data("%.12E"), options);
  CHECK(fit.terms.size() == 3);
}

TEST_CASE("MGH17 can be fitted with negative terms", "[fit]") {
  const double y[] = {.844, .908, .932, .936, .925, .908, .881, .850, .818, .784, .751,
                      .718, .685, .658, .628, .603, .580, .558, .538, .522, .506, .490,
                      .478, .467, .457, .448, .438, .431, .424, .420, .414, .411, .406};
  RelaxationData data;
  for (int i = 0; i < 33; ++i) {
    data.time_s.push_back(10.0 * i);
    data.value.push_back(y[i]);
  }
  FitOptions options;
  options.allow_negative = true;
  options.white_noise = true;
  options.n_terms = 2;
  const FitResult fit = fit_relaxation(data, options);
  REQUIRE(fit.terms.size() == 2);
  CHECK(fit.rss == Approx(5.4648946975e-5).epsilon(1e-9));
  CHECK(fit.E_inf_Pa == Approx(3.7541005211e-1).epsilon(1e-8));
  CHECK(fit.terms[1].modulus_Pa == Approx(1.9358469127).epsilon(1e-8));
  CHECK(1.0 / fit.terms[1].tau_s == Approx(1.2867534640e-2).epsilon(1e-8));
  CHECK(fit.terms[0].modulus_Pa == Approx(-1.4646871366).epsilon(1e-8));
  CHECK(1.0 / fit.terms[0].tau_s == Approx(2.2122699662e-2).epsilon(1e-8));
}
