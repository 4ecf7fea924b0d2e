#include "fit/large_strain/fit_large_strain.h"
#include "tests/models/hyperelastic/foam_of.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

using namespace viscard;
using Catch::Matchers::Contains;
using viscard::test::foam_of;

namespace {

const FoamLaw& two_ratios() {
  static const FoamLaw kLaw = foam_of({{0.05, 8.0, 0.2}, {0.01, -2.0, 0.05}});
  return kLaw;
}

struct Made {
  FoamTest test = FoamTest::kUniaxial;
  double from = 0.4, to = 1.2;
  bool has_lateral = false;
};

// Noise of a share of the largest stress, and of the largest lateral strain.
LargeStrainTest foam_record(const FoamLaw& law, const Made& made, double share = 0.0,
                            unsigned seed = 1) {
  constexpr int kPoints = 60;
  LargeStrainTest record{name_of(made.test), Deformation::kUniaxial, {}, {}};
  record.foam_test = made.test;
  for (int i = 0; i < kPoints; ++i) {
    const double at = made.from + (made.to - made.from) * i / (kPoints - 1);
    const FoamState state = foam_state(law, made.test, at);
    record.stretch.push_back(at);
    record.nominal_stress_Pa.push_back(state.nominal_stress_Pa);
    if (made.has_lateral) record.lateral_stretch.push_back(state.lateral_stretch());
  }
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  double largest_Pa = 0.0, side = 0.0;
  for (const double stress : record.nominal_stress_Pa)
    largest_Pa = std::max(largest_Pa, std::abs(stress));
  for (const double s : record.lateral_stretch) side = std::max(side, std::abs(s - 1.0));
  for (double& stress : record.nominal_stress_Pa) stress += share * largest_Pa * normal(random);
  for (double& s : record.lateral_stretch) s += share * side * normal(random);
  return record;
}

std::vector<LargeStrainTest> all_four(const FoamLaw& law, double share, unsigned seed) {
  return {foam_record(law, {FoamTest::kUniaxial, 0.4, 1.2, true}, share, seed),
          foam_record(law, {FoamTest::kVolumetric, 0.75, 0.99}, share, seed + 1),
          foam_record(law, {FoamTest::kShear, 0.02, 1.0}, share, seed + 2)};
}

LargeStrainOptions foam_options(std::vector<Eigen::Index> terms) {
  LargeStrainOptions options;
  options.foam_terms = std::move(terms);
  return options;
}

bool has_flag(const std::vector<MaterialFlag>& flags, const std::string& name) {
  return std::any_of(flags.begin(), flags.end(),
                     [&](const MaterialFlag& flag) { return flag.name == name; });
}

}  // namespace

TEST_CASE("foam fit: terms with a nu of each are found again", "[fit][foam]") {
  const FittedRubber fitted =
      fit_large_strain(all_four(two_ratios(), 0.0, 1), foam_options({2})).best();
  REQUIRE(fitted.foam);
  CHECK(name_of(fitted) == "hyperfoam-2");
  CHECK_FALSE(fitted.foam->has_one_nu);
  const FoamLaw& law = fitted.foam->law;
  CHECK(law.mu_Pa[0] == Approx(5e4).epsilon(1e-4));
  CHECK(law.alpha[0] == Approx(8.0).epsilon(1e-4));
  CHECK(law.nu[0] == Approx(0.2).epsilon(1e-4));
  CHECK(law.mu_Pa[1] == Approx(1e4).epsilon(1e-3));
  CHECK(law.alpha[1] == Approx(-2.0).epsilon(1e-3));
  CHECK(law.nu[1] == Approx(0.05).epsilon(1e-2));
  CHECK(fitted.E0_Pa == Approx(0.141882353e6).epsilon(1e-5));
  CHECK(fitted.n_parameters == 6);
  CHECK(fitted.is_trustworthy);
}

TEST_CASE("foam fit: one term by its lateral stretch, and with nu = 0", "[fit][foam]") {
  for (const double nu : {0.0, 0.2, 0.4}) {
    const FoamLaw law = foam_of({{0.05, 8.0, nu}});
    const FittedRubber fitted =
        fit_large_strain({foam_record(law, {FoamTest::kUniaxial, 0.4, 1.1, true})},
                         foam_options({1}))
            .best();
    CAPTURE(nu);
    CHECK(fitted.foam->law.mu_Pa[0] == Approx(5e4).epsilon(1e-6));
    CHECK(fitted.foam->law.alpha[0] == Approx(8.0).epsilon(1e-6));
    CHECK(fitted.foam->law.nu[0] == Approx(nu).margin(1e-7));
    CHECK(fitted.is_trustworthy);
  }
}

TEST_CASE("foam fit: standard errors are those of the reference", "[fit][foam]") {
  // Relative standard errors at 1 % noise of mu_1, mu_2, alpha_1, alpha_2, nu_1, nu_2 from uniaxial tests
  // with their lateral strain, a hydrostatic test and shear: 0.019, 0.072, 0.0067, 0.061, 0.0024 and 0.49,
  // from a separate jacobian by differences.
  const FittedRubber fitted =
      fit_large_strain(all_four(two_ratios(), 0.01, 5), foam_options({2})).best();
  REQUIRE(fitted.foam);
  const std::vector<LawParameter>& found = fitted.parameters;
  const double truth[] = {5e4, 1e4, 8.0, 2.0}, reference[] = {0.019, 0.072, 0.0067, 0.061};
  for (std::size_t k = 0; k < 4; ++k) {
    const LawParameter& one = found[k];
    CAPTURE(one.name, one.value, one.se, fitted.foam->has_one_nu);
    CHECK(one.se / truth[k] < 1.7 * reference[k]);
    CHECK(one.se / truth[k] > reference[k] / 2.5);
  }
  CHECK(fitted.E0_interval_95.low < 0.141882353e6);
  CHECK(fitted.E0_interval_95.high > 0.141882353e6);
}

TEST_CASE("foam fit: a given Poisson ratio is kept and named; without any the fit asks for it",
          "[fit][foam]") {
  const FoamLaw law = foam_of({{0.05, 8.0, 0.0}});
  const std::vector<LargeStrainTest> tests{foam_record(law, {FoamTest::kUniaxial, 0.4, 1.0})};
  LargeStrainOptions options = foam_options({1, 2});
  CHECK_THROWS_WITH(fit_large_strain(tests, options),
                    Contains("do not show the Poisson ratio") && Contains("--poisson-ratio"));
  options.poisson_ratio = 0.0;
  const LargeStrainResult result = fit_large_strain(tests, options);
  CHECK(result.best().foam->law.mu_Pa.size() == 1);
  CHECK(result.best().parameters.back().name == "nu");
  CHECK(result.best().parameters.back().se == 0.0);
  CHECK(has_flag(result.best().flags, "poisson-ratio-given"));
  CHECK(has_flag(result.notes, "platens"));
  CHECK(result.best().is_trustworthy);
  CHECK(result.tests[0].kind == "uniaxial");
}

TEST_CASE("foam fit: confined and volumetric tests beside another one show the volume",
          "[fit][foam]") {
  const FoamLaw law = foam_of({{0.05, 8.0, 0.3}});
  for (const FoamTest volume : {FoamTest::kConfined, FoamTest::kVolumetric}) {
    const FittedRubber fitted = fit_large_strain({foam_record(law, {FoamTest::kUniaxial, 0.5, 1.0}),
                                                  foam_record(law, {volume, 0.8, 1.0})},
                                                 foam_options({1}))
                                    .best();
    CHECK(fitted.foam->law.nu[0] == Approx(0.3).epsilon(1e-5));
  }
}

TEST_CASE("foam fit: BIC keeps few terms, and a lateral stretch that is none is refused",
          "[fit][foam]") {
  const FoamLaw law = foam_of({{0.05, 8.0, 0.2}});
  LargeStrainTest record = foam_record(law, {FoamTest::kUniaxial, 0.4, 1.2, true}, 0.005, 7);
  const LargeStrainResult result = fit_large_strain({record}, foam_options({1, 2, 3}));
  CHECK(result.laws.size() == 3);
  CHECK(name_of(result.best()) == "hyperfoam-1");
  CHECK(std::abs(result.best().parameters[2].value - 0.2) < 4.0 * result.best().parameters[2].se);
  record.lateral_stretch[3] = -0.1;
  CHECK_THROWS_WITH(fit_large_strain({record}, foam_options({1})),
                    Contains("lateral stretch -0.1"));
}
