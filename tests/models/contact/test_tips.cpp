#include "models/contact/punch_contact.h"
#include "tests/support/error_text.h"
#include "tests/support/printed_digits.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <sstream>

using namespace viscard;
using viscard::test::error_text;

TEST_CASE("a sticking punch on a half-space takes Mossakovskii's force", "[models][reduction]") {
  for (const double nu : {0.0, 0.2, 0.3, 0.45, 0.499}) {
    CAPTURE(nu);
    const double exact = (1.0 - nu) * std::log(3.0 - 4.0 * nu) / (1.0 - 2.0 * nu);
    // The extrapolated Galerkin solution; its error is largest at nu = 0, where the edge oscillates
    // most.
    CHECK(sticking_layer_factor(0.0, nu) == Approx(exact).epsilon(2e-6));
  }
  CHECK(sticking_layer_factor(0.0, 0.5) == Approx(1.0).epsilon(1e-12));  // no coupling: rounding
}

TEST_CASE("a sticking punch on a bonded layer agrees with finite elements", "[models]") {
  // Axisymmetric finite elements, four to five digits printed; at nu = 0.499 the last is uncertain.
  CHECK(sticking_layer_factor(0.25, 0.499) == test::printed("1.3694"));
  CHECK(sticking_layer_factor(0.5, 0.3) == test::printed("1.6605"));
  CHECK(sticking_layer_factor(1.0, 0.45) == test::printed("3.1599"));
  CHECK(sticking_layer_factor(1.0, 0.499) == test::printed("3.9055", 1.0, 1.5));
  CHECK(sticking_layer_factor(2.0, 0.499) == test::printed("12.25"));
}

// On thick layers the gain is that of the half-space, 0.3 % at nu = 0.45; it first falls a little
// with a/H, because the coupling of pressure and shear changes sign, then grows
// until the layer is squeezed as a column, sticking or not.
TEST_CASE("sticking always stiffens, and the more the thinner the layer is", "[models]") {
  CHECK(sticking_layer_factor(0.1, 0.45) > layer_factor(0.1, 0.45));
  CHECK(sticking_layer_factor(0.5, 0.45) > layer_factor(0.5, 0.45));
  double before = 0.0;
  for (const double ratio : {1.0, 2.0, 3.0}) {
    const double gain = sticking_layer_factor(ratio, 0.45) / layer_factor(ratio, 0.45);
    CAPTURE(ratio, gain);
    CHECK(gain > 1.0);
    CHECK(gain > before);
    before = gain;
  }
  CHECK_THROWS_AS(sticking_layer_factor(11.0, 0.4), std::invalid_argument);
  CHECK_THROWS_AS(sticking_layer_factor(1.0, 0.51), std::invalid_argument);
}

TEST_CASE("a very thin sticking layer of nu below 0.5 is squeezed like a column",
          "[models][reduction]") {
  // Confined modulus over the punch's area: F/h -> M pi a^2/H, so kappa (2 a E/(1 - nu^2)) tends to
  // it; the edge adds a few per cent at a/H = 10, less than a third of the difference at 5.
  constexpr double kNu = 0.3;
  const auto excess = [](double ratio) {
    const double confined =
        std::numbers::pi * ratio * (1.0 - kNu) * (1.0 - kNu) / (2.0 * (1.0 - 2.0 * kNu));
    return sticking_layer_factor(ratio, kNu) / confined - 1.0;
  };
  CHECK(excess(10.0) > 0.0);
  CHECK(excess(10.0) < 0.06);
  CHECK(excess(10.0) < 0.6 * excess(5.0));  // the edge's share falls as H/a
}

TEST_CASE("the table of layer factors in data/reference is what the program computes", "[models]") {
  const std::string path = VISCARD_SOURCE_DIR "/data/reference/layer_factor.csv";
  constexpr double kRatios[] = {0.1, 0.2, 0.3, 0.5, 0.8, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0};
  constexpr double kPoisson[] = {0.0, 0.2, 0.3, 0.33, 0.4, 0.45, 0.49, 0.495, 0.499, 0.5};
  if (std::getenv("VISCARD_UPDATE_GOLDEN") != nullptr) {
    std::ofstream out(path);
    out.precision(10);
    out << "radius_over_thickness,poisson_ratio,frictionless,sticking\n";
    for (const double ratio : kRatios) {
      for (const double nu : kPoisson) {
        out << ratio << "," << nu << "," << layer_factor(ratio, nu) << ","
            << sticking_layer_factor(ratio, nu) << "\n";
      }
    }
  }
  std::ifstream file(path);
  std::string line;
  REQUIRE(std::getline(file, line));
  int rows = 0;
  while (std::getline(file, line)) {
    double ratio = 0.0, nu = 0.0, frictionless = 0.0, sticking = 0.0;
    char comma = ',';
    std::istringstream(line) >> ratio >> comma >> nu >> comma >> frictionless >> comma >> sticking;
    CAPTURE(line);
    CHECK(layer_factor(ratio, nu) == Approx(frictionless).epsilon(1e-9));  // ten digits printed
    if (rows % 7 == 0) {
      CHECK(sticking_layer_factor(ratio, nu) == Approx(sticking).epsilon(1e-9));
    }
    ++rows;
  }
  CHECK(rows == 110);
}

TEST_CASE("sphere and cone follow Hertz and Sneddon", "[models]") {
  const PunchContact sphere{
      .punch_radius_m = 1e-3, .poisson_ratio = 0.5, .shape = TipShape::kSphere};
  // F = (4/3) E* sqrt(R) h^(3/2) = 4/3 x (4/3 MPa) x 0.0316228 x (1e-4)^1.5
  CHECK(depth_law(sphere).factor * 1e6 * std::pow(1e-4, depth_law(sphere).power) ==
        Approx(4.0 / 3.0 * 4.0 / 3.0 * 1e6 * 0.0316227766 * 1e-6).epsilon(1e-9));
  const PunchContact cone{
      .poisson_ratio = 0.3, .shape = TipShape::kCone, .half_angle_rad = std::numbers::pi / 4};
  // F = (2/pi) E* tan(45 deg) h^2
  CHECK(depth_law(cone).power == 2.0);
  CHECK(depth_law(cone).factor == Approx(2.0 / std::numbers::pi / 0.91).epsilon(1e-14));
}

TEST_CASE("uncertain tips scale the modulus by their sensitivity", "[models]") {
  PunchContact sphere{.punch_radius_m = 1e-3, .poisson_ratio = 0.5, .shape = TipShape::kSphere};
  sphere.punch_radius_u_m = 0.02e-3;                                  // F goes with sqrt(R)
  CHECK(relative_uncertainty(sphere) == Approx(0.01).epsilon(1e-3));  // central difference
  PunchContact cone{
      .poisson_ratio = 0.5, .shape = TipShape::kCone, .half_angle_rad = std::numbers::pi / 4};
  cone.half_angle_u_rad = 0.01;  // d ln tan/d angle = 2 at 45 degrees
  CHECK(relative_uncertainty(cone) == Approx(0.02).epsilon(1e-3));
}

TEST_CASE("tips are refused if no formula holds", "[models]") {
  PunchContact contact{.punch_radius_m = 1e-3, .shape = TipShape::kSphere};
  CHECK(error_text([&] { force_per_modulus_and_depth_m(contact); }).find("flat punch") !=
        std::string::npos);
  contact.layer_thickness_m = 1e-3;
  CHECK(error_text([&] { validate(contact); }).find("half-space") != std::string::npos);
  contact = {.shape = TipShape::kCone};
  CHECK(error_text([&] { validate(contact); }).find("half-angle") != std::string::npos);
}
