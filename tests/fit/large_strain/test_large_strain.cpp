#include "fit/large_strain/fit_large_strain.h"
#include "fit/large_strain/load_cycles.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>

using namespace viscard;
using Catch::Matchers::Contains;

namespace {

constexpr double kKgfPerCm2_Pa = 98066.5;

LargeStrainTest treloar(const std::string& name, Deformation deformation) {
  LargeStrainTest test{name, deformation, {}, {}};
  std::ifstream file(std::string(VISCARD_SOURCE_DIR) + "/data/reference/treloar_" + name + ".csv");
  std::string line;
  while (std::getline(file, line)) {
    double stretch = 0.0, stress = 0.0;
    char comma = 0;
    if (!(std::istringstream(line) >> stretch >> comma >> stress)) continue;
    test.stretch.push_back(stretch);
    test.nominal_stress_Pa.push_back(stress * kKgfPerCm2_Pa);
  }
  return test;
}

std::vector<LargeStrainTest> all_of_treloar() {
  return {treloar("uniaxial", Deformation::kUniaxial), treloar("planar", Deformation::kPlanar),
          treloar("equibiaxial", Deformation::kEquibiaxial)};
}

const FittedRubber& law_named(const LargeStrainResult& result, HyperelasticForm form) {
  for (const FittedRubber& law : result.laws) {
    if (law.law.form == form) return law;
  }
  throw std::logic_error("no such law");
}

bool has_flag(const std::vector<MaterialFlag>& flags, const std::string& name) {
  for (const MaterialFlag& flag : flags) {
    if (flag.name == name) return true;
  }
  return false;
}

LargeStrainTest made(const HyperelasticLaw& law, Deformation deformation, double from, double to,
                     int count, double noise_Pa, std::mt19937_64& random) {
  LargeStrainTest test{name_of(deformation), deformation, {}, {}};
  std::normal_distribution<double> normal(0.0, 1.0);
  for (int i = 0; i < count; ++i) {
    const double s = from + (to - from) * i / (count - 1);
    test.stretch.push_back(s);
    test.nominal_stress_Pa.push_back(nominal_stress_Pa(law, deformation, s) +
                                     noise_Pa * normal(random));
  }
  return test;
}

}  // namespace

TEST_CASE("large strain: Treloar's three tests together as the best of many scipy starts",
          "[fit][golden]") {
  const LargeStrainResult result = fit_large_strain(all_of_treloar());
  REQUIRE(result.tests[0].n_readings == 25);
  REQUIRE(result.tests[1].n_readings == 14);
  REQUIRE(result.tests[2].n_readings == 17);
  // Sums of squares in MPa^2 of scipy's least_squares, the best of 60 random starts, on these tables.
  const std::vector<std::pair<HyperelasticForm, double>> reference{
      {HyperelasticForm::kNeoHooke, 21.163497121378935},
      {HyperelasticForm::kYeoh, 0.9789476968409404},
      {HyperelasticForm::kOgden1, 7.413293481778139},
      {HyperelasticForm::kOgden2, 1.5676776370490413},
      {HyperelasticForm::kOgden3, 0.2048079328055244}};
  for (const auto& [form, rss] : reference) {
    CAPTURE(name_of(form));
    CHECK(law_named(result, form).rss * 1e-12 <= rss * (1.0 + 1e-7));
    CHECK(law_named(result, form).rss * 1e-12 >= rss * (1.0 - 1e-3));
  }
  // Ogden's own constants leave 2.966 (Ogden 1972, table 1: 0.63, 0.0012, -0.01 MPa; 1.3, 5, -2).
  const FittedRubber& best = result.best();
  CHECK(best.law.form == HyperelasticForm::kOgden3);
  CHECK(best.is_trustworthy);
  CHECK(best.E0_Pa == Approx(1.0543270413196975e6).epsilon(1e-4));
  CHECK(best.rms_relative == Approx(0.028340765).epsilon(1e-5));
}

TEST_CASE("large strain: constants of Ogden 1972 leave the published sum of squares",
          "[fit][golden]") {
  // mu alpha/2 in the convention of this program.
  Eigen::VectorXd moduli_Pa(3), alpha(3);
  alpha << 1.3, 5.0, -2.0;
  moduli_Pa << 6.3 * 1.3 / 2.0, 0.012 * 5.0 / 2.0, 0.1;
  const HyperelasticLaw law{HyperelasticForm::kOgden3, kKgfPerCm2_Pa * moduli_Pa, alpha};
  double rss = 0.0;
  for (const LargeStrainTest& test : all_of_treloar()) {
    for (std::size_t i = 0; i < test.stretch.size(); ++i) {
      const double left =
          test.nominal_stress_Pa[i] - nominal_stress_Pa(law, test.deformation, test.stretch[i]);
      rss += left * left;
    }
  }
  CHECK(rss * 1e-12 == Approx(2.966056332305106).epsilon(1e-10));
}

TEST_CASE("large strain: parameters without noise are found again", "[fit]") {
  std::mt19937_64 random(1);
  const auto numbers = [](std::vector<double> values) {
    return Eigen::VectorXd(
        Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())));
  };
  const std::vector<HyperelasticLaw> laws{
      {HyperelasticForm::kMooneyRivlin, numbers({1.5e5, 2e4}), {}},
      {HyperelasticForm::kYeoh, numbers({1.8e5, -1.4e3, 40.0}), {}},
      {HyperelasticForm::kOgden2, numbers({1e4, 2e5}), numbers({-2.0, 1.3})},
      {HyperelasticForm::kOgden3, numbers({9.8e3, 4e5, 3e3}), numbers({-2.0, 1.3, 5.0})},
      {HyperelasticForm::kArrudaBoyce, numbers({2.7e5}), numbers({3.2})},
      {HyperelasticForm::kGent, numbers({2.7e5}), numbers({40.0})}};
  for (const HyperelasticLaw& law : laws) {
    CAPTURE(name_of(law.form));
    LargeStrainOptions options;
    options.forms = {law.form};
    const LargeStrainResult result =
        fit_large_strain({made(law, Deformation::kUniaxial, 0.4, 4.0, 60, 0.0, random),
                          made(law, Deformation::kPlanar, 1.0, 4.0, 40, 0.0, random),
                          made(law, Deformation::kEquibiaxial, 1.0, 3.0, 40, 0.0, random)},
                         options);
    const HyperelasticLaw& found = result.best().law;
    CHECK(youngs_modulus_Pa(found) == Approx(youngs_modulus_Pa(law)).epsilon(1e-6));
    CHECK(result.best().rms_relative < 1e-7);
    for (Eigen::Index j = 0; j < law.moduli_Pa.size(); ++j) {
      CHECK(found.moduli_Pa.sum() == Approx(law.moduli_Pa.sum()).epsilon(1e-5));
    }
  }
}

TEST_CASE("large strain: 95 % of the intervals hold", "[fit]") {
  std::mt19937_64 random(7);
  Eigen::VectorXd moduli_Pa(2), alpha(2);
  moduli_Pa << 2e4, 2.5e5;
  alpha << -2.5, 2.2;
  const HyperelasticLaw law{HyperelasticForm::kOgden2, moduli_Pa, alpha};
  LargeStrainOptions options;
  options.forms = {law.form};
  int held = 0, all = 0;
  for (int k = 0; k < 100; ++k) {
    const LargeStrainResult result =
        fit_large_strain({made(law, Deformation::kUniaxial, 0.6, 3.5, 60, 5e3, random),
                          made(law, Deformation::kEquibiaxial, 1.0, 2.5, 60, 5e3, random)},
                         options);
    const FittedRubber& fitted = result.best();
    all += 3;
    held += fitted.E0_interval_95.low < youngs_modulus_Pa(law) &&
            youngs_modulus_Pa(law) < fitted.E0_interval_95.high;
    // The terms come in any order; the one with the larger modulus is the second of the truth.
    const bool swapped = fitted.law.moduli_Pa[0] > fitted.law.moduli_Pa[1];
    const LawParameter& mu = fitted.parameters[swapped ? 0 : 1];
    const LawParameter& exponent = fitted.parameters[swapped ? 2 : 3];
    held += mu.interval_95.low < 2.5e5 && 2.5e5 < mu.interval_95.high;
    held += exponent.interval_95.low < 2.2 && 2.2 < exponent.interval_95.high;
  }
  CAPTURE(held, all);
  CHECK(held >= 0.90 * all);
  CHECK(held < all);  // intervals that never miss are too wide
}

TEST_CASE("large strain: a compression and a tension below each other are no cycles", "[fit]") {
  std::vector<double> both;
  for (int i = 0; i <= 20; ++i) both.push_back(1.0 - 0.025 * i);
  for (int i = 1; i <= 20; ++i) both.push_back(1.0 + 0.015 * i);
  const std::vector<LoadCycle> one = load_cycles(both);
  REQUIRE(one.size() == 1);
  CHECK(one.front().first == 0);
  CHECK(one.front().peak == both.size() - 1);
  // Loaded twice in tension they are cycles, as they were.
  std::vector<double> twice;
  for (int n = 0; n < 2; ++n) {
    for (int i = 0; i <= 20; ++i) twice.push_back(1.0 + 0.05 * i);
    for (int i = 19; i >= 0; --i) twice.push_back(1.0 + 0.05 * i);
  }
  CHECK(load_cycles(twice).size() == 2);
}

TEST_CASE("large strain: a known modulus is kept", "[fit]") {
  LargeStrainOptions options;
  options.modulus = KnownModulus{1.2e6, 0.0};
  const LargeStrainResult exact = fit_large_strain(all_of_treloar(), options);
  for (const FittedRubber& law : exact.laws) {
    CAPTURE(name_of(law.law.form));
    CHECK(law.E0_Pa == Approx(1.2e6).epsilon(1e-8));
  }
  options.modulus = KnownModulus{1.2e6, 1e3};
  const LargeStrainResult with_error = fit_large_strain(all_of_treloar(), options);
  CHECK(with_error.best().E0_Pa != Approx(1.2e6).epsilon(1e-8));
}

TEST_CASE("large strain: doubtful laws are flagged", "[fit]") {
  const LargeStrainResult result = fit_large_strain(all_of_treloar());
  const FittedRubber& neo = law_named(result, HyperelasticForm::kNeoHooke);
  CHECK(has_flag(neo.flags, "misfit"));
  CHECK_FALSE(neo.is_trustworthy);
  CHECK(result.notes.empty());

  // Data that soften beyond what is stable.
  LargeStrainTest softening{"uniaxial", Deformation::kUniaxial, {}, {}};
  for (int i = 0; i <= 40; ++i) {
    const double s = 1.0 + 0.05 * i;
    softening.stretch.push_back(s);
    softening.nominal_stress_Pa.push_back(1e6 * (s - 1.0) * std::exp(-1.5 * (s - 1.0)));
  }
  LargeStrainOptions yeoh;
  yeoh.forms = {HyperelasticForm::kYeoh};
  const LargeStrainResult soft = fit_large_strain({softening}, yeoh);
  CHECK(has_flag(soft.best().flags, "unstable-in-range"));
  CHECK(has_flag(soft.notes, "one-deformation"));
  CHECK_FALSE(soft.best().is_trustworthy);
}

TEST_CASE("large strain: criteria of one law are those that it has beside all others", "[fit]") {
  const LargeStrainResult all = fit_large_strain(all_of_treloar(), {});
  LargeStrainOptions options;
  options.forms = {HyperelasticForm::kYeoh};
  const LargeStrainResult one = fit_large_strain(all_of_treloar(), options);
  const FittedRubber& beside = law_named(all, HyperelasticForm::kYeoh);
  CHECK(one.best().aicc == Approx(beside.aicc).epsilon(1e-9));
  CHECK(one.best().bic == Approx(beside.bic).epsilon(1e-9));
}

TEST_CASE("large strain: bad tests are refused with what to do", "[fit]") {
  const LargeStrainTest good = all_of_treloar()[0];
  LargeStrainTest bad = good;
  bad.stretch[3] = -0.2;
  CHECK_THROWS_WITH(fit_large_strain({bad}), Contains("reading 4 of the uniaxial test has the "
                                                      "stretch -0.2"));
  bad = good;
  bad.nominal_stress_Pa[2] = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_WITH(fit_large_strain({bad}), Contains("the stress nan Pa"));
  bad = good;
  for (double& stress : bad.nominal_stress_Pa) stress = -stress;
  CHECK_THROWS_WITH(fit_large_strain({bad}), Contains("stresses against its strains"));
  for (double& stress : bad.nominal_stress_Pa) stress = 0.0;
  CHECK_THROWS_WITH(fit_large_strain({bad}), Contains("every stress of the uniaxial test is 0"));
  bad.stretch = {1.0, 1.1};
  bad.nominal_stress_Pa = {0.0, 1e5};
  CHECK_THROWS_WITH(fit_large_strain({bad}), Contains("2 readings"));
  CHECK_THROWS_WITH(fit_large_strain({}), Contains("no test"));
}

TEST_CASE("large strain: cycles are counted, and softening is seen at equal stretch", "[fit]") {
  LargeStrainTest test{"uniaxial", Deformation::kUniaxial, {}, {}};
  // Three cycles to 1.8, 2 and 2; each one softer by 10 %, with a little noise in the stretch.
  const double peaks[] = {1.8, 2.0, 2.0};
  for (int cycle = 0; cycle < 3; ++cycle) {
    for (int i = 0; i <= 40; ++i) {
      const double share = i <= 20 ? i / 20.0 : (40 - i) / 20.0;
      const double s = 1.0 + (peaks[cycle] - 1.0) * share + (i % 2 == 0 ? 0.004 : -0.004);
      test.stretch.push_back(s);
      test.nominal_stress_Pa.push_back((1.0 - 0.1 * cycle) * 1e5 * (s - 1.0 / (s * s)));
    }
  }
  const std::vector<LoadCycle> cycles = load_cycles(test.stretch);
  REQUIRE(cycles.size() == 3);
  CHECK(cycles[0].peak == 20);
  CHECK(cycles[2].peak == 2 * 41 + 20);
  CHECK(softening(test, cycles).value() == Approx(0.2).epsilon(1e-2));
  CHECK(loading_of(test, cycles[1]).stretch.back() == Approx(2.004));
  LargeStrainTest timed = test;
  for (std::size_t i = 0; i < test.stretch.size(); ++i) {
    timed.time_s.push_back(0.1 * static_cast<double>(i));
  }
  const LargeStrainTest second = loading_of(timed, cycles[1]);
  REQUIRE(second.before.size() == cycles[1].first);
  CHECK(second.before.back().value == test.stretch[cycles[1].first - 1]);
  CHECK(second.before.back().time_s == timed.time_s[cycles[1].first - 1]);
  // Compression: strains grow away from 1 downwards.
  CHECK(load_cycles({1.0, 0.9, 0.8, 0.7, 0.8, 0.9, 1.0, 0.8, 0.6}).size() == 2);
  CHECK(load_cycles({1.0, 1.1, 1.2}).size() == 1);
  // A sorted table through 1 is one loading of all rows.
  for (const auto& sorted : {std::vector{0.6, 0.8, 1.0, 1.5, 2.5}, {2.5, 1.5, 0.9, 0.6}}) {
    REQUIRE(load_cycles(sorted).size() == 1);
    CHECK(load_cycles(sorted)[0].first == 0);
    CHECK(load_cycles(sorted)[0].last == sorted.size() - 1);
    CHECK(load_cycles(sorted)[0].peak == sorted.size() - 1);
  }
  CHECK_FALSE(softening(test, {cycles[0]}).has_value());
}

TEST_CASE(
    "large strain: a table without times in any order of its rows is one curve, cycles are not",
    "[fit]") {
  LargeStrainTest test{"uniaxial", Deformation::kUniaxial, {1.0, 1.6, 1.2, 2.0, 1.4, 1.8}, {}};
  for (const double s : test.stretch) test.nominal_stress_Pa.push_back(1e5 * (s - 1.0 / (s * s)));
  CHECK(load_cycles(test.stretch).size() > 1);  // what the rows look like
  REQUIRE(is_unsorted_curve(test));
  CHECK(share_of_turns(test.stretch) == 1.0);
  const LargeStrainTest sorted = sorted_by_stretch(test);
  CHECK(sorted.stretch == std::vector<double>{1.0, 1.2, 1.4, 1.6, 1.8, 2.0});
  CHECK(std::is_sorted(sorted.nominal_stress_Pa.begin(), sorted.nominal_stress_Pa.end()));
  CHECK_FALSE(is_unsorted_curve(sorted));
  // A stretch with two stresses is hysteresis, and with times the order is known.
  LargeStrainTest cycle = test;
  cycle.stretch = {1.0, 1.5, 2.0, 1.4, 1.1, 1.9};
  cycle.nominal_stress_Pa = {0.0, 1e5, 2e5, 5e4, 6e4, 1.8e5};
  CHECK_FALSE(is_unsorted_curve(cycle));
  test.time_s = {0.0, 1.0, 2.0, 3.0, 4.0, 5.0};
  CHECK_FALSE(is_unsorted_curve(test));
  CHECK(share_of_turns({1.0, 1.5, 2.0, 1.5, 1.0}) == Approx(1.0 / 3.0));
}
