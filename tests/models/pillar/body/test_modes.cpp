#include "models/pillar/body/pillar_modes.h"
#include "tests/support/printed_digits.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace viscard;

namespace {

PillarMedia media(double nu, bool film, double E_Pa = 1.8e6) {
  PillarMedia out{isotropic_medium(E_Pa, nu, 965.0), std::nullopt};
  if (film) out.film = isotropic_medium(2e9, 0.29, 1780.0);
  return out;
}

PillarGeometry geometry(bool film) {
  PillarGeometry out;
  if (film) out.film = FilmGeometry{25e-6, 60e-6};
  return out;
}

std::vector<double> frequencies_Hz(const PillarModel& model, int count) {
  std::vector<double> out;
  for (const PillarMode& mode : lowest_modes(model, count)) out.push_back(mode.frequency_Hz);
  return out;
}

void check_close(const std::vector<double>& found, const std::vector<double>& expected,
                 double epsilon) {
  REQUIRE(found.size() == expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    CAPTURE(i);
    CHECK(found[i] == Approx(expected[i]).epsilon(epsilon));
  }
}

const Discretisation kFine{.degree = 7, .layers = 3, .shaft_elements = 2};

}  // namespace

TEST_CASE("the modes of the pillar have their converged frequencies, with and without a film",
          "[pillar][golden]") {
  // Two orders of an independent program agree to the digits given, Hz; nu 0.33, E 1.8 MPa,
  // rho 965.
  struct Case {
    Motion motion;
    bool film;
    std::vector<double> frequency_Hz;
  };
  const auto c =
      GENERATE(Case{Motion::kLateral, true, {16026.87, 77403.97, 173645.7, 274668.4}},
               Case{Motion::kLateral, false, {16029.18, 77413.28, 173664.2, 274693.5}},
               Case{Motion::kLongitudinal, true, {90760.26, 268141.2, 429790.3, 556936.1}},
               Case{Motion::kLongitudinal, false, {90769.96, 268168.4, 429827.5, 556970.8}},
               Case{Motion::kTorsion, true, {55165.77, 165497.3, 275828.9, 386160.4}},
               Case{Motion::kOvalling, true, {449529.5, 493537.6}},
               Case{Motion::kOvalling, false, {449529.6, 493537.6}});
  const PillarModel model(geometry(c.film), kFine, media(0.33, c.film), {.motion = c.motion});
  check_close(frequencies_Hz(model, static_cast<int>(c.frequency_Hz.size())), c.frequency_Hz, 1e-5);
}

TEST_CASE("torsion of the fixed pillar is exact", "[pillar]") {
  // f = (2k - 1)/(4L) sqrt(G/rho): the shape is r sin(...), and r is in every element.
  const PillarModel model({}, {.degree = 10, .layers = 1, .shaft_elements = 3}, media(0.33, false),
                          {.motion = Motion::kTorsion});
  const double base_Hz = std::sqrt(1.8e6 / 2.66 / 965.0) / (4.0 * 120e-6);
  CHECK(base_Hz == test::printed("55168.4192"));
  CHECK(3 * base_Hz == test::printed("165505.2577"));
  check_close(frequencies_Hz(model, 4), {base_Hz, 3 * base_Hz, 5 * base_Hz, 7 * base_Hz}, 1e-9);
}

TEST_CASE("a strip has the converged modes of plane stress and plane strain", "[pillar][golden]") {
  struct Case {
    Motion motion;
    PlaneState plane;
    std::vector<double> frequency_Hz;
  };
  const auto c = GENERATE(
      Case{Motion::kPlaneAntisymmetric,
           PlaneState::kStress,
           {17955.74, 82013.82, 180048.7, 276479.8, 360374.3}},
      Case{Motion::kPlaneSymmetric, PlaneState::kStress, {90319.09, 267873.9, 424358.8, 474111.0}},
      Case{Motion::kPlaneAntisymmetric,
           PlaneState::kStrain,
           {18973.91, 85061.13, 185614.8, 282965.7, 364075.4}},
      Case{Motion::kPlaneSymmetric, PlaneState::kStrain, {96076.99, 281097.9, 430460.0}});
  const PillarModel model({}, {.degree = 10, .layers = 5, .shaft_elements = 2}, media(0.33, false),
                          {.motion = c.motion, .plane = c.plane});
  check_close(frequencies_Hz(model, static_cast<int>(c.frequency_Hz.size())), c.frequency_Hz, 1e-5);
}

TEST_CASE("first modes follow Poisson ratio up to the incompressible limit",
          "[pillar][stability]") {
  struct Case {
    double nu, lateral_Hz, longitudinal_Hz, torsion_Hz;
  };
  const auto c =
      GENERATE(Case{.45, 16190.4, 91590.2, 52834.0}, Case{.49, 16270.0, 91972.1, 52120.0},
               Case{.499, 16290.1, 92067.4, 51963.3}, Case{.4999, 16292.2, 92077.1, 51947.8},
               // limits: the step from 0.4999 to 0.5 is a ninth of that from 0.499 to 0.4999
               Case{.499999, 16292.43, 92078.2, 51946.1}, Case{.5, 16292.43, 92078.2, 51946.1});
  const auto first = [&](Motion motion) {
    const PillarModel model(geometry(true), kFine, media(c.nu, true), {.motion = motion});
    return frequencies_Hz(model, 1).front();
  };
  CAPTURE(c.nu);
  CHECK(first(Motion::kLateral) == Approx(c.lateral_Hz).epsilon(2e-5));
  CHECK(first(Motion::kLongitudinal) == Approx(c.longitudinal_Hz).epsilon(2e-5));
  CHECK(first(Motion::kTorsion) == Approx(c.torsion_Hz).epsilon(2e-5));
}

TEST_CASE("higher modes of an incompressible pillar continue those of nearly incompressible ones",
          "[pillar][stability]") {
  const Discretisation mesh{.degree = 8, .layers = 3};
  const auto at = [&](double nu) {
    const PillarModel model({}, mesh, media(nu, false), {.motion = Motion::kLateral});
    return frequencies_Hz(model, 12);
  };
  const std::vector<double> far = at(.4999), near = at(.49999), limit = at(.5);
  for (std::size_t i = 3; i < 12; ++i) {  // rounding of stiff volume takes more of the first ones
    CAPTURE(i, far[i], near[i]);
    // Linear in 1 - 2 nu up to its square, 1e-10 here.
    CHECK(limit[i] == Approx(near[i] - (far[i] - near[i]) / 9.0).epsilon(2e-7));
  }
}

TEST_CASE("buckling pressures equal the converged ones", "[pillar][golden]") {
  struct Case {
    double nu;
    bool film;
    double pressure_Pa;
  };
  const auto c =
      GENERATE(Case{.33, false, 29368.9}, Case{.33, true, 29364.8}, Case{.45, false, 29707.0},
               Case{.49, false, 29866.0}, Case{.4999, false, 29909.0});
  const Discretisation fine{.degree = 8, .layers = 3, .shaft_elements = 2};
  const PillarModel axial(geometry(c.film), fine, media(c.nu, c.film),
                          {.motion = Motion::kLongitudinal});
  const PillarModel lateral(geometry(c.film), fine, media(c.nu, c.film),
                            {.motion = Motion::kLateral});
  CAPTURE(c.nu, c.film);
  // Five digits are known; near nu = 0.5 the reference used displacements alone, good to 1e-4.
  CHECK(buckling(axial, lateral).pressure_Pa ==
        Approx(c.pressure_Pa).epsilon(c.nu == .33 ? 3e-5 : 1e-4));
}

TEST_CASE("a stubby pillar's own buckling stays where it is while modes of the rim fall below it",
          "[pillar][stability]") {
  PillarGeometry stubby = geometry(false);
  stubby.length_m = 1.45 * stubby.diameter_m;
  const auto answer = [&](const Discretisation& mesh, int count = 4) {
    const PillarModel axial(stubby, mesh, media(.448, false), {.motion = Motion::kLongitudinal});
    const PillarModel lateral(stubby, mesh, media(.448, false), {.motion = Motion::kLateral});
    return buckling(axial, lateral, count);
  };
  const Buckling coarse = answer({.degree = 5, .layers = 1});
  const Buckling fine = answer({.degree = 7, .layers = 4});
  CAPTURE(coarse.pressure_Pa, fine.pressure_Pa);
  CHECK(fine.pressures_Pa.front() < 0.9 * fine.pressure_Pa);  // at the rim, falling with the mesh
  CHECK(coarse.pressure_Pa == Approx(fine.pressure_Pa).epsilon(0.05));
  // The same without the modes of the rim below it, with which it mixes.
  const Buckling alone = answer({.degree = 7, .layers = 4}, 1);
  CHECK(alone.rim_share > 0.0);
  CHECK(alone.rim_share < 1e-3);
  CHECK(alone.pressure_Pa ==
        Approx(fine.pressure_Pa).epsilon(0.0).margin(alone.rim_share * fine.pressure_Pa));
  const Buckling finer =
      answer({.degree = 8, .layers = 6}, 1);  // hidden by modes of the rim before
  CHECK(finer.pressure_Pa == Approx(alone.pressure_Pa).epsilon(2e-5));
}

TEST_CASE("a pressed pillar softens as the root of one minus its share of the buckling pressure",
          "[pillar]") {
  const Discretisation mesh{.degree = 5, .layers = 2, .shaft_elements = 2};
  const PillarModel axial({}, mesh, media(.33, false), {.motion = Motion::kLongitudinal});
  const PillarModel lateral({}, mesh, media(.33, false), {.motion = Motion::kLateral});
  const double critical_Pa = buckling(axial, lateral).pressure_Pa;
  const double free_Hz = lowest_modes(lateral, 1).front().frequency_Hz;
  const double share = GENERATE(0.34, 0.9, 0.999);
  const double pressed_Hz =
      modes_under_pressure(axial, lateral, share * critical_Pa, 1).front().frequency_Hz;
  // Exact if the buckling and the vibration shape were one; Rayleigh's quotient makes it a lower
  // bound.
  CHECK(pressed_Hz / free_Hz == Approx(std::sqrt(1.0 - share)).epsilon(0.07));
  CHECK(pressed_Hz / free_Hz >= std::sqrt(1.0 - share));
  CHECK_THROWS_WITH(modes_under_pressure(axial, lateral, 1.01 * critical_Pa, 1),
                    Catch::Contains("buckling"));
}

// Ovalling modes of a long pillar lie close together above the cut-off of its section.
TEST_CASE("closely spaced modes of slender pillars are all found", "[pillar][stability]") {
  const double slenderness = GENERATE(40.0, 100.0);
  const PillarGeometry geometry{.diameter_m = 40e-6, .length_m = slenderness * 40e-6};
  const Discretisation mesh{.degree = 4, .layers = 2, .longest_m = 20e-6};
  const PillarMedia media{isotropic_medium(1.8e6, .33, 965.0), {}};
  const auto modes_of = [&](Motion motion) {
    const PillarModel model(geometry, mesh, media, {.motion = motion});
    return lowest_modes(model, 4);
  };
  const auto ovalling = modes_of(Motion::kOvalling);
  REQUIRE(ovalling.size() == 4);
  for (std::size_t i = 1; i < 4; ++i) {
    CHECK(ovalling[i].frequency_Hz > ovalling[i - 1].frequency_Hz);
  }
  // Only the end vibrates, independent of the length: as for the seed's pillar.
  CHECK(ovalling[0].frequency_Hz == Approx(449529.6).epsilon(5e-3));
  const double speed_m_s = std::sqrt(1.8e6 / 965.0);
  const double euler_Hz = 3.5160153 / (2.0 * std::numbers::pi) * 10e-6 * speed_m_s /
                          (geometry.length_m * geometry.length_m);
  // Clamped contraction stiffens the foot, shear softens the shaft: both some diameters over L.
  CHECK(modes_of(Motion::kLateral)[0].frequency_Hz == Approx(euler_Hz).epsilon(0.1 / slenderness));
}

// There the search starts again half a thousandth below a mode, with a penalty that is stiffer.
TEST_CASE("closely spaced modes of an incompressible pillar are the limit of nu below 0.5",
          "[pillar][stability]") {
  const PillarGeometry geometry{.diameter_m = 40e-6, .length_m = 1600e-6};
  const Discretisation mesh{.degree = 4, .layers = 2, .longest_m = 20e-6};
  const auto modes_at = [&](double nu) {
    const PillarMedia media{isotropic_medium(1.8e6, nu, 965.0), {}};
    return lowest_modes(PillarModel(geometry, mesh, media, {.motion = Motion::kOvalling}), 4);
  };
  const auto limit = modes_at(0.5);
  const auto near = modes_at(0.4999);
  const auto nearer = modes_at(0.49999);
  REQUIRE(limit.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    const double far_off = near[i].frequency_Hz / limit[i].frequency_Hz - 1.0;
    CHECK(std::abs(far_off) < 5e-4);
    // The difference falls as 1 - 2 nu.
    CHECK(nearer[i].frequency_Hz / limit[i].frequency_Hz - 1.0 ==
          Approx(0.1 * far_off).margin(1e-8));
  }
}
