#include "models/contact/punch_contact.h"

#include <catch2/catch.hpp>

#include <stdexcept>
#include <vector>

using namespace viscard;

TEST_CASE("the layer factor agrees with an independent solution to its printed digits",
          "[models]") {
  // Computed with another quadrature and confirmed by finite elements to four digits; the values of
  // Hayes et al. (1972) agree within 0.3 %.
  struct Row {
    double ratio;
    std::vector<double> kappa;  // at nu = 0.30, 0.33, 0.40, 0.45, 0.49, 0.50
  };
  const Row row =
      GENERATE(values<Row>({{0.1, {1.0954, 1.0981, 1.1063, 1.1146, 1.1234, 1.1260}},
                            {0.2, {1.2066, 1.2128, 1.2323, 1.2523, 1.2741, 1.2806}},
                            {0.3, {1.3328, 1.3436, 1.3780, 1.4141, 1.4541, 1.4662}},
                            {0.4, {1.4726, 1.4891, 1.5422, 1.5993, 1.6638, 1.6837}},
                            {0.5, {1.6240, 1.6472, 1.7230, 1.8063, 1.9028, 1.9329}},
                            {0.6, {1.7848, 1.8156, 1.9178, 2.0328, 2.1694, 2.2129}},
                            {0.8, {2.1260, 2.1744, 2.3402, 2.5354, 2.7796, 2.8602}},
                            {1.0, {2.4835, 2.5521, 2.7938, 3.0914, 3.4840, 3.6187}},
                            {1.5, {3.4090, 3.5355, 4.0100, 4.6576, 5.6322, 6.0030}},
                            {2.0, {4.3532, 4.5446, 5.2985, 6.4206, 8.3370, 9.1495}},
                            {3.0, {6.2613, 6.5928, 7.9916, 10.365, 15.462, 18.157}},
                            {5.0, {10.100, 10.726, 13.558, 19.156, 36.263, 50.140}},
                            {10.0, {19.716, 21.089, 27.659, 42.515, 114.37, 252.898}}}));
  const std::vector<double> nu = {0.30, 0.33, 0.40, 0.45, 0.49, 0.50};
  for (std::size_t i = 0; i < nu.size(); ++i) {
    CAPTURE(row.ratio, nu[i]);
    const double last = row.kappa[i] < 10.0 ? 1e-4 : row.kappa[i] < 100.0 ? 1e-3 : 1e-2;
    // Half a unit of the last digit; 36.263 was 36.2625 before it was rounded.
    CHECK(layer_factor(row.ratio, nu[i]) == Approx(row.kappa[i]).epsilon(0.0).margin(0.53 * last));
  }
}

TEST_CASE("a thick layer is a half-space", "[models][reduction]") {
  CHECK(layer_factor(0.0, 0.5) == 1.0);
  CHECK(layer_factor(0.01, 0.5) == Approx(1.0 + 1.140 * 0.01).epsilon(2e-4));
  CHECK(layer_factor(0.01, 0.3) == Approx(1.0 + 0.884 * 0.01).epsilon(2e-4));
}

TEST_CASE("the layer factor refuses arguments outside its range", "[models]") {
  CHECK_THROWS_AS(layer_factor(-0.1, 0.4), std::invalid_argument);
  CHECK_THROWS_AS(layer_factor(11.0, 0.4), std::invalid_argument);
  CHECK_THROWS_AS(layer_factor(0.1, 0.51), std::invalid_argument);
  CHECK_THROWS_AS(layer_factor(0.1, std::nan("")), std::invalid_argument);
}

TEST_CASE("a flat punch on a half-space takes 2 a E* h", "[models]") {
  // The seed's numbers: E = 1.88 MPa, nu = 0.5, d = 4.4 mm, h = 0.25 mm give 2.7573 N.
  const PunchContact contact{.punch_radius_m = 2.2e-3, .poisson_ratio = 0.5};
  CHECK(force_per_modulus_and_depth_m(contact) * 1.88e6 * 0.25e-3 == Approx(2.7573).epsilon(2e-5));
}

TEST_CASE("uncertain geometry scales the modulus by its sensitivity", "[models]") {
  PunchContact contact{.punch_radius_m = 2.2e-3, .poisson_ratio = 0.3};
  contact.punch_radius_u_m = 0.022e-3;  // 1 %, and F is proportional to a on a half-space
  CHECK(relative_uncertainty(contact) == Approx(0.01).epsilon(1e-9));
  contact.punch_radius_u_m = 0.0;
  contact.poisson_ratio_u = 0.01;  // d ln[1/(1 - nu^2)]/d nu = 2 nu/(1 - nu^2)
  CHECK(relative_uncertainty(contact) == Approx(0.01 * 0.6 / 0.91).epsilon(1e-3));
}
