// Cards of laws of rubber with terms of relaxation: each solver's rule, written from its manual or source
// in rubber_rules.cpp, integrates the numbers that stand in the card; CalculiX and SfePy themselves run in
// test_rubber_memory.cpp.
#include "tests/io/cards/rubber_rules.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace viscard;
using namespace viscard::test;
using Catch::Matchers::Contains;

TEST_CASE(
    "rubber cards: the rules of Abaqus, ANSYS and FEBio with the card's terms give the law's "
    "stress",
    "[io]") {
  for (const Rubber& rubber : rubbers()) {
    CAPTURE(name_of(rubber.law.form));
    const auto expected_MPa = fitted_MPa(rubber);
    const Written abaqus = abaqus_card(rubber), ansys = ansys_card(rubber);
    const auto [febio, share] = febio_card(rubber);
    const Recursion rule{share, [](double x) { return (1.0 - std::exp(-x)) / x; }};
    for (std::size_t i = 0; i < rule_times_s().size(); ++i) {
      CAPTURE(rule_times_s()[i]);
      CHECK(abaqus_stress(abaqus, rule_times_s()[i]) == Approx(expected_MPa[i]).epsilon(2e-6));
      CHECK(abaqus_stress(ansys, rule_times_s()[i]) == Approx(expected_MPa[i]).epsilon(2e-6));
      CHECK(recursive_stress(febio, rule, rule_times_s()[i]) ==
            Approx(expected_MPa[i]).epsilon(2e-6));
    }
    // Without <g0> FEBio would take 1.
    double sum = 0.0;
    for (const RubberTerm& term : rubber.terms) sum += term.g;
    CHECK(share == Approx(1.0 - sum).epsilon(1e-12));
  }
}

TEST_CASE("rubber cards: OpenRadioss LAW62 with the card's numbers gives the law's stress",
          "[io]") {
  const Rubber mooney =
      rubber_of(HyperelasticForm::kMooneyRivlin, {1.5e5, 2e4}, {},
                {{0.1, 0.05}, {0.1, 0.2}, {0.1, 0.6}, {0.1, 2.0}, {0.1, 5.0}, {0.1, 9.0}});
  for (const Rubber* each : {&rubbers()[0], &mooney, &rubbers()[2]}) {
    const Rubber& rubber = *each;
    CAPTURE(name_of(rubber.law.form));
    const std::string card = card_of(rubber, "openradioss");
    REQUIRE_THAT(card, Contains("/MAT/LAW62/1/1\n"));
    const auto first = numbers_below(card, "#                 nu");
    const auto mu = numbers_below(card, "# mu\n"), alpha = numbers_below(card, "# alpha\n");
    REQUIRE(first.size() == 4);
    CHECK(first[1] == static_cast<double>(mu.size()));
    CHECK(first[2] == static_cast<double>(rubber.terms.size()));
    // K = 2 G (1 + nu)/(3 (1 - 2 nu)), G the sum of mu: hm_read_mat62.F
    double shear = 0.0;
    for (const double value : mu) shear += value;
    CHECK(2.0 * shear * (1.0 + first[0]) / (3.0 * (1.0 - 2.0 * first[0])) ==
          Approx(1000.0 * shear).epsilon(1e-8));
    Written law;
    law.energy = ogden_energy(mu, alpha, [](double m, double a) { return 2.0 * m / (a * a); });
    law.g = numbers_below(card, "# gamma\n");
    law.tau = numbers_below(card, "# tau\n");
    REQUIRE(law.g.size() == rubber.terms.size());
    Recursion rule{1.0, [](double x) { return std::exp(-0.5 * x); }};  // sigeps62.F
    for (const double g : law.g) rule.share -= g;
    const auto expected_MPa = fitted_MPa(rubber);
    for (std::size_t i = 0; i < rule_times_s().size(); ++i) {
      CHECK(recursive_stress(law, rule, rule_times_s()[i]) ==
            Approx(expected_MPa[i]).epsilon(5e-6));
    }
  }
  CHECK_THROWS_WITH(card_of(rubbers()[1], "openradioss"), Contains("LAW62, which has no yeoh law"));
}

// 077: the law after all relaxation and a solid with shear moduli G_i, which are the law's at small strain.
TEST_CASE("rubber cards: LS-DYNA's terms are those of the law at small strain, by --approximate",
          "[io]") {
  for (const Rubber& rubber : rubbers()) {
    CAPTURE(name_of(rubber.law.form));
    CHECK_THROWS_WITH(card_of(rubber, "lsdyna"),
                      Contains("right at small strain only; --approximate"));
    const std::string card = card_of(rubber, "lsdyna", true);
    const auto rows = numbers_below(card, "$       GI     BETAI");
    REQUIRE(rows.size() == 2 * rubber.terms.size());
    const double G_MPa = 1e-6 * youngs_modulus_Pa(rubber.law) / 3.0;
    double rest_MPa = G_MPa;
    for (std::size_t i = 0; i < rubber.terms.size(); ++i) {
      CHECK(rows[2 * i] == Approx(rubber.terms[i].g * G_MPa).epsilon(1e-6));
      CHECK(rows[2 * i + 1] == Approx(1.0 / rubber.terms[i].tau_s).epsilon(1e-6));
      rest_MPa -= rows[2 * i];
    }
    double written_MPa = 0.0;
    if (rubber.law.form == HyperelasticForm::kOgden2) {
      const auto mu = numbers_below(card, "$     MU1 to MU8"),
                 alpha = numbers_below(card, "$ ALPHA1");
      for (std::size_t i = 0; i < 2; ++i) written_MPa += 0.5 * mu[i] * alpha[i];
    } else {
      written_MPa = 2.0 * numbers_below(card, "$      C10")[0];
    }
    CHECK(written_MPa == Approx(rest_MPa).epsilon(1e-6));
  }
}

TEST_CASE("rubber cards: terms that a solver cannot take are refused with the reason", "[io]") {
  const Rubber& neo_hooke = rubbers()[0];
  CHECK_THROWS_WITH(card_of(neo_hooke, "calculix"), Contains("calculix cannot take the terms") &&
                                                        Contains("no Prony series") &&
                                                        Contains("--elastic-only long-term"));
  for (const char* target : {"comsol", "frontistr", "moose"}) {
    CAPTURE(target);
    CHECK_THROWS_WITH(card_of(neo_hooke, target), Contains("cannot take the terms of relaxation"));
    // Without terms they are the cards of the scaled law and of the law itself.
    const Rubber at_once = rubber_of(HyperelasticForm::kNeoHooke, {2e5}, {}, {}),
                 rest = rubber_of(HyperelasticForm::kNeoHooke, {1.4e5}, {}, {});
    CHECK(card_of(neo_hooke, target, false, "long-term") == card_of(rest, target));
    CHECK(card_of(neo_hooke, target, false, "instantaneous") == card_of(at_once, target));
  }
  Rubber many = neo_hooke;
  many.terms.assign(7, {0.05, 1.0});
  CHECK_THROWS_WITH(card_of(many, "febio"), Contains("febio takes 6 terms") && Contains("has 7"));
  CHECK_NOTHROW(card_of(many, "abaqus"));
  Rubber fluid = neo_hooke;
  fluid.terms = {{1.0, 1.0}};
  CHECK_THROWS_WITH(card_of(fluid, "abaqus"), Contains("sum to 1"));
}

TEST_CASE("rubber cards: times of relaxation have the unit of the card", "[io]") {
  const auto card =
      rubber_card(rubbers()[0].law, rubbers()[0].terms, {.target = "abaqus", .units = "mm-kg-ms"});
  CHECK_THAT(card, Contains("*VISCOELASTIC, TIME=PRONY\n0.3, 0, 400\n"));
  const auto dyna = rubber_card(
      rubbers()[0].law, rubbers()[0].terms,
      {.target = "lsdyna", .units = "mm-kg-ms", .density_kg_m3 = 1100.0, .may_approximate = true});
  CHECK(numbers_below(dyna, "$       GI")[1] == Approx(1.0 / 400.0));
}
