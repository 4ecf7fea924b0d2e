#include "models/maths/distributions.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace viscard;

TEST_CASE("upper tail of the F distribution", "[maths]") {
  // Closed forms for two degrees of freedom (Abramowitz & Stegun 1964, 26.6.4 and 26.6.5).
  for (const double f : {1e-3, 0.3, 1.0, 7.0, 250.0}) {
    for (const double n : {2.0, 4.5, 60.0, 1e5}) {
      // ln Gamma(n/2), some n ln(n)/2, is rounded to 1e-16 of itself.
      CHECK(f_upper_tail(f, 2.0, n) ==
            Approx(std::exp(-0.5 * n * std::log1p(2.0 * f / n))).epsilon(1e-12 + 1e-14 * n));
      const double below = std::pow(n * f / (2.0 + n * f), 0.5 * n);
      CHECK(f_upper_tail(f, n, 2.0) == Approx(1.0 - below).epsilon(1e-9).margin(1e-15));
    }
  }
  // Student's t with 10 degrees of freedom, squared; chi-square with one (tables 26.10 and 26.8).
  CHECK(f_upper_tail(2.228139 * 2.228139, 1.0, 10.0) == Approx(0.05).epsilon(1e-6));
  CHECK(f_upper_tail(3.841458820694124, 1.0, 1e9) == Approx(0.05).epsilon(1e-6));
  CHECK(f_upper_tail(0.0, 3.0, 5.0) == 1.0);
}

TEST_CASE("quantile of Student's t for degrees of freedom that need not be whole", "[maths]") {
  CHECK(student_t_975(1.0) == Approx(std::tan(0.475 * 3.14159265358979323846)).epsilon(1e-12));
  for (const double freedom : {1.5, 4.0, 7.25, 1e3, 1e8}) {
    const double t = student_t_975(freedom);  // t squared has the F distribution
    CHECK(f_upper_tail(t * t, 1.0, freedom) == Approx(0.05).epsilon(1e-9));
  }
  CHECK_THROWS_WITH(student_t_975(0.0), Catch::Contains("degrees of freedom"));
}
