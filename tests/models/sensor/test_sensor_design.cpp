#include "models/sensor/sensor_design.h"
#include "tests/support/printed_digits.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace viscard;

namespace {

constexpr double kD = 40e-6;
constexpr double kS = 60e-6;

SensorMaterial with_gamma(double gamma_J_m2) {
  SensorMaterial m;
  m.surface_energy_J_m2 = gamma_J_m2;
  m.work_of_adhesion_J_m2 = 2.0 * gamma_J_m2;
  return m;
}

}  // namespace

TEST_CASE("stress concentration follows the lattice", "[models][design]") {
  CHECK(stress_concentration(kD, kS, Lattice::kSquare) == Approx(7.958).epsilon(1e-4));
  CHECK(stress_concentration(kD, kS, Lattice::kHexagonal) == Approx(6.892).epsilon(1e-4));
  CHECK(stress_concentration(kD, kS, Lattice::kPlain) == Approx(6.25).epsilon(1e-12));
  // Without a gap, pillars of a square lattice cover pi/4 of the film.
  CHECK(stress_concentration(kD, 0.0, Lattice::kSquare) ==
        Approx(4.0 / std::numbers::pi).epsilon(1e-12));
}

TEST_CASE("buckling limits the length by Euler's formula", "[models][design]") {
  const auto longest_um = [](double K) {
    SensorRequirements r;
    r.end_factor = K;
    return 1e6 * longest_unbuckled_m(kD, kS, {}, r);
  };
  CHECK(longest_um(0.5) == Approx(298.8).epsilon(2e-4));  // digits given
  CHECK(longest_um(0.699) == Approx(213.8).epsilon(3e-4));
  CHECK(longest_um(1.0) == Approx(149.4).epsilon(4e-4));
  CHECK(longest_um(2.0) == Approx(74.7).epsilon(7e-4));
  // The closed form l = C d^2/(d + s), C = pi^(3/2)/(8 K) sqrt(E/p).
  CHECK(longest_um(1.0) == Approx(9.338 * kD * kD / (kD + kS) * 1e6).epsilon(1e-4));
  // At the limit Euler's load equals the load.
  const double l = longest_unbuckled_m(kD, kS, {}, {});
  const double I = std::numbers::pi * std::pow(kD, 4) / 64.0;
  const double load_N = 1e4 * (kD + kS) * (kD + kS);
  CHECK(std::numbers::pi * std::numbers::pi * 1.8e6 * I / (l * l) == Approx(load_N).epsilon(1e-12));
}

TEST_CASE("matting: the published limit, and its derivation from energies", "[models][design]") {
  CHECK(1e6 * longest_unmatted_m(kD, kS, with_gamma(0.02)) == test::printed("434.417"));
  CHECK(1e6 * longest_unmatted_m(kD, kS, with_gamma(0.025)) == Approx(403.3).epsilon(2e-4));
  CHECK(1e6 * longest_unmatted_m(kD, kS, with_gamma(0.05)) == Approx(320.1).epsilon(2e-4));
  // Two clamped pillars bend by s/2 each, 3 E I s^2/x^3 together, and gain W per length along which
  // they touch (Johnson, Kendall & Roberts, line contact without load): collapse from x^4 = 9 E I
  // s^2/W.
  const SensorMaterial m = with_gamma(0.02);
  const double pi = std::numbers::pi;
  const double w = 2.0 * m.surface_energy_J_m2;
  const double R = 0.25 * kD;
  const double E_contact = m.young_modulus_Pa / (2.0 * (1.0 - 0.33 * 0.33));
  const double W = 1.5 * w * std::cbrt(32.0 * R * R * w / (pi * E_contact));
  const double I = pi * std::pow(kD, 4) / 64.0;
  const double x = std::pow(9.0 * m.young_modulus_Pa * I * kS * kS / W, 0.25);
  CHECK(longest_unmatted_m(kD, kS, m) == Approx(x).epsilon(1e-12));
}

TEST_CASE("ground collapse: bending a quarter turn pays from the published length on",
          "[models][design]") {
  // The foot bends over a length x by a quarter turn, pi^2 E I/(8 x), the rest lies down and gains
  // W per length: least energy at x_0, and below zero from l = 2 x_0 on.
  const SensorMaterial m = with_gamma(0.02);
  const double pi = std::numbers::pi;
  const double w = 2.0 * m.surface_energy_J_m2;
  const double R = 0.5 * kD;
  const double E_contact = m.young_modulus_Pa / (2.0 * (1.0 - 0.33 * 0.33));
  const double W = 1.5 * w * std::cbrt(32.0 * R * R * w / (pi * E_contact));
  const double I = pi * std::pow(kD, 4) / 64.0;
  const double x = pi / std::sqrt(8.0) * std::sqrt(m.young_modulus_Pa * I / W);
  CHECK(longest_upright_m(kD, m) == Approx(2.0 * x).epsilon(1e-12));
}

TEST_CASE("adhesion: pull-off force and the widest flaw-insensitive pillar", "[models][design]") {
  SensorMaterial m;
  CHECK(pull_off_force_N(kD, m) == test::printed("127.46e-6"));
  CHECK(4.0 * pull_off_force_N(kD, m) / (std::numbers::pi * kD * kD) == test::printed("101.43e3"));
  const auto widest_um = [&](double strength_Pa) {
    m.adhesion_strength_Pa = strength_Pa;
    return 1e6 * widest_flaw_insensitive_m(m);
  };
  CHECK(widest_um(1e5) == Approx(41.0).epsilon(1e-2));  // two digits given
  CHECK(widest_um(6.4e4) == Approx(100.0).epsilon(1e-2));
  CHECK(widest_um(4e4) == Approx(257.0).epsilon(2e-3));
  CHECK(widest_um(1e4) == Approx(4.1e3).epsilon(1e-2));
  // At the widest, the stress of a crack from the rim is the strength.
  m.adhesion_strength_Pa = 5e4;
  const double d = widest_flaw_insensitive_m(m);
  CHECK(4.0 * pull_off_force_N(d, m) / (std::numbers::pi * d * d) == Approx(5e4).epsilon(1e-12));
}

TEST_CASE("sensitivity is that of the flat film times the concentration", "[models][design]") {
  const SensorRequirements r;
  const double flat_V_Pa = 7.058807e-6;  // g33 t of the film, 25 um
  CHECK(sensitivity_V_Pa(kD, kS, {}, r) ==
        Approx(flat_V_Pa * stress_concentration(kD, kS, r.lattice)).epsilon(1e-6));
}

TEST_CASE("the thesis' pillar is admissible, and is not when its foot counts as free",
          "[models][design]") {
  const SensorGeometry thesis;
  SensorRequirements r;
  CHECK(is_admissible(design_limits(thesis, {}, r)));
  const LongestPillar longest = longest_pillar(kD, kS, {}, r);
  CHECK(longest.limited_by == "buckling");
  CHECK(longest.length_m == Approx(149.4e-6).epsilon(4e-4));
  r.end_factor = 1.245;  // the largest it bears
  CHECK(is_admissible(design_limits(thesis, {}, r)));
  r.end_factor = 1.246;
  CHECK_FALSE(is_admissible(design_limits(thesis, {}, r)));
  r.end_factor = 2.0;
  CHECK_FALSE(is_admissible(design_limits(thesis, {}, r)));
}

TEST_CASE("buckling and matting exchange near a spacing of 20 um", "[models][design]") {
  const SensorRequirements r{.largest_aspect_ratio = 100.0};
  CHECK(longest_pillar(kD, 15e-6, {}, r).limited_by == "matting");
  CHECK(longest_pillar(kD, 25e-6, {}, r).limited_by == "buckling");
  CHECK(longest_unmatted_m(kD, 20e-6, {}) == Approx(250e-6).epsilon(0.01));  // read off a figure
}

TEST_CASE("limits of diameter and spacing exclude a design of any length", "[models][design]") {
  SensorRequirements r;
  r.coarsest_pitch_m = 90e-6;
  CHECK(longest_pillar(kD, kS, {}, r).limited_by == "resolution");
  CHECK(longest_pillar(kD, kS, {}, r).length_m == 0.0);
  r = {};
  r.least_relative_sensitivity = 9.0;
  CHECK(longest_pillar(kD, kS, {}, r).limited_by == "sensitivity");
  CHECK(longest_pillar(5e-6, kS, {}, {}).limited_by == "feature");
  CHECK(longest_pillar(300e-6, kS, {}, {}).limited_by == "flaw");
  CHECK_THROWS_WITH(validate({.diameter_m = -1.0}, {}, {}), Catch::Contains("diameter"));
  CHECK_THROWS_WITH(validate({}, {.poisson_ratio = 0.6}, {}), Catch::Contains("Poisson"));
  CHECK_THROWS_WITH(validate({}, {}, {.end_factor = std::nan("")}), Catch::Contains("end factor"));
}
