#include "tests/models/hyperelastic/foam_of.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>

using namespace viscard;
using Catch::Matchers::Contains;
using viscard::test::foam_of;

namespace {

// Reference numbers in MPa, computed with numpy from formula (4) of the header, independently of this
// program. The second law was run in CalculiX 2.20 (one cube), which agrees in all seven digits it prints.
FoamLaw one_term() {
  return foam_of({{0.05, 8.0, 0.2}});
}
FoamLaw two_terms() {
  return foam_of({{0.05, 8.0, 0.2}, {0.01, -2.0, 0.05}});
}
FoamLaw open_cells() {
  return foam_of({{0.05, 8.0, 0.0}, {0.01, -2.0, 0.0}});
}
const std::vector<double> kStretches{0.3, 0.5, 0.7, 0.9, 1.1, 1.3};
const std::vector<double> kTangents{0.1, 0.2, 0.4, 0.6, 0.8, 1.0};

void check_curve(const FoamLaw& law, FoamTest test, const std::vector<double>& reference_MPa) {
  const std::vector<double>& at = test == FoamTest::kShear ? kTangents : kStretches;
  for (std::size_t i = 0; i < at.size(); ++i) {
    CAPTURE(name_of(test), at[i]);
    CHECK(1e-6 * foam_state(law, test, at[i]).nominal_stress_Pa ==
          Approx(reference_MPa[i]).epsilon(6e-9));  // nine printed digits
  }
}

void check_sides(const FoamLaw& law, FoamTest test, const std::vector<double>& reference) {
  for (std::size_t i = 0; i < kStretches.size(); ++i) {
    CAPTURE(name_of(test), kStretches[i]);
    CHECK(foam_state(law, test, kStretches[i]).lateral_stretch() ==
          Approx(reference[i]).epsilon(6e-9));
  }
}

}  // namespace

TEST_CASE("foam: stresses of one term are the reference numbers", "[models][foam]") {
  const FoamLaw law = one_term();
  check_curve(
      law, FoamTest::kUniaxial,
      {-0.286016179, -0.0756881721, -0.0305682449, -0.0104604437, 0.0146025765, 0.0721165161});
  check_curve(
      law, FoamTest::kConfined,
      {-1.03307281, -0.158642449, -0.0451963106, -0.0124157672, 0.0155456986, 0.0736590589});
  check_curve(
      law, FoamTest::kPlanar,
      {-0.462960229, -0.0999023438, -0.0354137199, -0.0111680652, 0.0149675287, 0.0727460696});
  check_curve(
      law, FoamTest::kEquibiaxial,
      {-5.14403019, -0.399902344, -0.0733443441, -0.0151901485, 0.0165974472, 0.0750690328});
  check_curve(law, FoamTest::kVolumetric,
              {-635.06579, -6.39990234, -0.308732224, -0.0262859736, 0.0190577435, 0.0772569013});
  check_curve(law, FoamTest::kShear,
              {0.00512575125, 0.01102416, 0.02878848, 0.06318192, 0.13119744, 0.2625});
  CHECK(1e-6 * shear_modulus_Pa(law) == Approx(0.05).epsilon(1e-12));
  CHECK(1e-6 * bulk_modulus_Pa(law) == Approx(0.0666666666667).epsilon(1e-11));
  CHECK(1e-6 * youngs_modulus_Pa(law) == Approx(0.12).epsilon(1e-12));
}

TEST_CASE("foam: stresses and free sides of two terms are the reference numbers",
          "[models][foam]") {
  const FoamLaw law = two_terms();
  check_curve(
      law, FoamTest::kUniaxial,
      {-0.629701458, -0.138153862, -0.0463781816, -0.0132866037, 0.0163432853, 0.0756330196});
  check_curve(
      law, FoamTest::kConfined,
      {-1.37428361, -0.220124955, -0.0606201943, -0.0151513935, 0.0172202442, 0.0770272487});
  check_curve(
      law, FoamTest::kPlanar,
      {-0.806165263, -0.162204726, -0.0511654109, -0.0139806311, 0.0166974057, 0.0762346054});
  check_curve(law, FoamTest::kEquibiaxial,
              {-5.49145042, -0.464046677, -0.0899007076, -0.0182070431, 0.0184768365, 0.078865888});
  check_curve(law, FoamTest::kVolumetric,
              {-635.413846, -6.46402833, -0.3252024, -0.0292757349, 0.0209289602, 0.0811005698});
  check_curve(law, FoamTest::kShear,
              {0.00612575125, 0.01302416, 0.03278848, 0.06918192, 0.13919744, 0.2725});
  check_sides(law, FoamTest::kUniaxial,
              {1.26890233, 1.14435585, 1.07019335, 1.01969349, 0.983035272, 0.955444366});
  check_sides(law, FoamTest::kPlanar,
              {1.3479553, 1.18402791, 1.08816438, 1.02431358, 0.979453636, 0.947101056});
  check_sides(law, FoamTest::kEquibiaxial,
              {1.82516696, 1.4116254, 1.1901065, 1.05014933, 0.960400649, 0.906410362});
  CHECK(poisson_ratio(law) == Approx(0.182352941).epsilon(1e-8));
  CHECK(1e-6 * youngs_modulus_Pa(law) == Approx(0.141882353).epsilon(1e-8));
  // Cauchy stresses of simple shear at 0.6 along the axes of the test, in MPa.
  const FoamState sheared = foam_state(law, FoamTest::kShear, 0.6);
  const Eigen::Vector3d tau = 1e-6 * kirchhoff_Pa(law, sheared.log_strain);
  CHECK(tau[1] == Approx(0.0).margin(1e-15));
  CHECK(tau[0] + tau[2] == Approx(0.073592352 + 0.0320832).epsilon(1e-8));
}

TEST_CASE("foam: one nu of all terms gives the side s^-nu at any strain", "[models][foam]") {
  for (const double s : {0.2, 0.6, 1.7}) {
    CHECK(foam_state(one_term(), FoamTest::kUniaxial, s).lateral_stretch() ==
          Approx(std::pow(s, -0.2)).epsilon(1e-14));
  }
}

TEST_CASE("foam: with nu = 0 all tests but shear are one", "[models][foam][reduction]") {
  for (const FoamTest test : {FoamTest::kUniaxial, FoamTest::kPlanar, FoamTest::kEquibiaxial,
                              FoamTest::kConfined, FoamTest::kVolumetric}) {
    check_curve(
        open_cells(), test,
        {-0.37870097, -0.0849023437, -0.0316965188, -0.0105164877, 0.0145730885, 0.071960908});
  }
  // Shear does not depend on nu at all.
  for (const double gamma : kTangents) {
    CHECK(
        foam_state(open_cells(), FoamTest::kShear, gamma).nominal_stress_Pa ==
        Approx(foam_state(two_terms(), FoamTest::kShear, gamma).nominal_stress_Pa).epsilon(1e-13));
  }
}

TEST_CASE("foam: the stress is the slope of the energy in every test", "[models][foam]") {
  const FoamLaw law = two_terms();
  for (std::size_t t = 0; t < foam_test_names().size(); ++t) {
    const auto test = static_cast<FoamTest>(t);
    const double n_loaded = test == FoamTest::kVolumetric    ? 3.0
                            : test == FoamTest::kEquibiaxial ? 2.0
                                                             : 1.0;
    for (const double s : {0.6, 0.95, 1.25}) {
      const auto energy = [&](double at) {
        return energy_Pa(law, foam_state(law, test, at).log_strain);
      };
      constexpr double kStep = 1e-4;
      const double slope = (8.0 * (energy(s + kStep) - energy(s - kStep)) - energy(s + 2 * kStep) +
                            energy(s - 2 * kStep)) /
                           (12.0 * kStep);
      CAPTURE(name_of(test), s);
      CHECK(foam_state(law, test, s).nominal_stress_Pa == Approx(slope / n_loaded).epsilon(1e-8));
    }
    const FoamState state = foam_state(law, test, 0.7);
    constexpr double kStep = 1e-6;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(k);
      const Eigen::Vector3d change = (kirchhoff_Pa(law, state.log_strain + step) -
                                      kirchhoff_Pa(law, state.log_strain - step)) /
                                     (2.0 * kStep);
      const Eigen::Vector3d column = kirchhoff_tangent_Pa(law, state.log_strain).col(k);
      CHECK((change - column).norm() < 1e-6 * column.norm());
    }
  }
}

TEST_CASE("foam: positive moduli and nu are stable everywhere, a negative modulus is found",
          "[models][foam]") {
  const StableRange all = stable_range(two_terms(), FoamTest::kUniaxial);
  CHECK(all.low_is_open);
  CHECK(all.high_is_open);
  // tau of the sides: 2 (mu_1 s^8 + mu_2 s^-2) turns negative where s^10 = 0.02/0.05.
  const FoamLaw weak = foam_of({{0.05, 8.0, 0.0}, {-0.02, -2.0, 0.0}});
  const StableRange range = stable_range(weak, FoamTest::kConfined);
  CHECK_FALSE(range.low_is_open);
  CHECK(range.low == Approx(std::pow(0.4, 0.1)).epsilon(1e-9));
  CHECK(range.contains(0.95));
  CHECK_FALSE(range.contains(0.5));
}

TEST_CASE("foam: numbers out of range are refused by name", "[models][foam]") {
  CHECK_NOTHROW(validate(two_terms()));
  CHECK_THROWS_WITH(validate(foam_of({{0.05, 8.0, 0.5}})), Contains("nu_1 of hyperfoam-1 is 0.5"));
  CHECK_THROWS_WITH(validate(foam_of({{0.05, 0.0, 0.2}})), Contains("alpha_1"));
  CHECK_THROWS_WITH(validate(foam_of({{-0.05, 8.0, 0.2}})), Contains("shear modulus"));
  CHECK_THROWS_WITH(validate(foam_of({{0.05, 8.0, -0.9}, {-0.04, -2.0, 0.4}})),
                    Contains("bulk modulus"));
  CHECK_THROWS_WITH(validate(FoamLaw{}), Contains("1 to 3 terms"));
  CHECK(foam_terms_of("hyperfoam-2") == 2);
  CHECK_FALSE(foam_terms_of("hyperfoam-4"));
}
