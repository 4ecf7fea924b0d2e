#include "models/material/ratio_model.h"
#include "models/maths/text_of_number.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace viscard;
using Catch::Contains;

namespace {

// E0 = 18.76 MPa ratio^-0.9876 through ratios 5 to 20, with that standard error of the exponent.
RatioFit power_law(double exponent_se) {
  RatioFit fit;
  fit.law.ratios = {5.0, 10.0, 20.0};
  fit.law.n_specimens = 9;
  const double middle = std::log(10.0), half = 0.5 * std::log(4.0);
  fit.law.coefficients = Eigen::Vector2d(std::log(18.76e6) - 0.9876 * middle, -0.9876 * half);
  fit.law.covariance = Eigen::Vector2d(1e-4, std::pow(exponent_se * half, 2)).asDiagonal();
  fit.law.spread_ln_E0 = 0.0834567;
  return fit;
}

}  // namespace

TEST_CASE("a law is printed with the digits that its standard errors allow", "[models]") {
  // ln of the factor: 0.01 and 2.30 times the exponent's error, added in squares.
  CHECK_THAT(law_in_words(power_law(0.02)),
             Contains("E0 = 18.76 MPa x ratio^-0.988 (exponent +- 0.02)"));
  CHECK_THAT(law_in_words(power_law(0.15)),
             Contains("E0 = 18.8 MPa x ratio^-0.99 (exponent +- 0.15)"));
  CHECK_THAT(law_in_words(power_law(0.15)),
             Contains("E0 scatters by 8.3 % (9 specimens, 3 ratios)"));
}

TEST_CASE("a number shows two digits of its standard error", "[models]") {
  CHECK(text_with_error(18.764321, 0.83) == "18.76");
  CHECK(text_with_error(0.00217432, 0.0005) == "0.00217");
  CHECK(text_with_error(-1234.56, 210.0) == "-1.23e+03");
  CHECK(text_with_error(1.0 / 3.0, 0.0) == "0.333333");
  CHECK(text_with_error(0.5, 30.0) == "0.5");
  CHECK(counted(1, "term") == "1 term");
  CHECK(counted(0, "term") == "0 terms");
}
