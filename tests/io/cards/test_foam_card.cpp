// Cards of foams (models/hyperelastic/foam_law.h).
#include "io/cards/hyperelastic/check_rubber.h"
#include "io/cards/hyperelastic/rubber_card.h"
#include "io/cards/hyperelastic/rubber_file_card.h"
#include "io/materials/hyperelastic_file.h"
#include "tests/io/cards/rubber_cube.h"
#include "tests/io/cards/rubber_findings.h"
#include "tests/models/hyperelastic/foam_of.h"

#include <catch2/catch.hpp>

#include <array>

using namespace viscard;
using Catch::Matchers::Contains;
using viscard::test::foam_of;
using viscard::test::rubber_findings;
using viscard::test::with_last;

namespace {

HyperelasticFile foam_file(std::initializer_list<std::array<double, 3>> terms) {
  HyperelasticFile file;
  const FoamLaw law = foam_of(terms);
  file.foam = law;
  file.E0_Pa = file.E_inf_Pa = youngs_modulus_Pa(law);
  file.density_kg_m3 = 30.0;
  return file;
}

HyperelasticFile one_term() {
  return foam_file({{0.05, 8.0, 0.2}});
}
HyperelasticFile two_terms() {
  return foam_file({{0.05, 8.0, 0.2}, {0.01, -2.0, 0.05}});
}
HyperelasticFile three_terms() {
  return foam_file({{0.05, 8.0, 0.2}, {0.02, 3.0, 0.1}, {0.01, -2.0, 0.05}});
}

RubberCardOptions with_units(const std::string& target, const std::string& units = "mm-t-s") {
  RubberCardOptions options{.target = target, .units = units};
  options.density_kg_m3 = 30.0;
  return options;
}

std::string foam_text(const HyperelasticFile& file, const std::string& target,
                      const std::string& units = "mm-t-s") {
  return rubber_file_card(file, "foam.json", with_units(target, units));
}

}  // namespace

TEST_CASE("foam cards: each solver's convention", "[cards][foam]") {
  CHECK(foam_card(*one_term().foam, with_units("abaqus")) ==
        "*MATERIAL, NAME=RUBBER\n*DENSITY\n3e-11,\n*HYPERFOAM, N=1\n0.05, 8, 0.2\n");
  // One term has no stiffness in CalculiX: two equal halves.
  CHECK(
      foam_card(*one_term().foam, with_units("calculix")) ==
      "*MATERIAL, NAME=RUBBER\n*DENSITY\n3e-11,\n*HYPERFOAM, N=2\n0.025, 8, 0.025, 8, 0.2, 0.2\n");
  CHECK_THAT(foam_card(*two_terms().foam, with_units("abaqus")),
             Contains("*HYPERFOAM, N=2\n0.05, 8, 0.01, -2, 0.2, 0.05\n"));
  // Eight to a row.
  CHECK_THAT(foam_card(*three_terms().foam, with_units("abaqus")),
             Contains("*HYPERFOAM, N=3\n0.05, 8, 0.02, 3, 0.01, -2, 0.2, 0.1\n0.05\n"));
  // C = 2 mu/alpha, B = alpha, N = nu/(1 - 2 nu), K.
  const std::string dyna = foam_card(*one_term().foam, with_units("lsdyna"));
  CHECK_THAT(dyna, Contains("*MAT_HILL_FOAM_TITLE\nRUBBER\n") && Contains(".3333333") &&
                       Contains("     .0125       0.0") && Contains("        8.       0.0") &&
                       Contains(".06666667") && Contains("MU = 0"));
  CHECK_THROWS_WITH(foam_card(*two_terms().foam, with_units("lsdyna")),
                    Contains("one N = nu/(1 - 2 nu) for all terms"));
  CHECK_THAT(foam_card(*two_terms().foam, with_units("openradioss")),
             Contains("/MAT/LAW62/1/1\n") &&
                 Contains("# mu\n                 .05                 .01\n# alpha\n"
                          "                  8.                 -2.\n# nu\n"
                          "                  .2                 .05\n"));
}

TEST_CASE("the header of a rubber card states names of files as those of all cards do",
          "[cards][foam]") {
  HyperelasticFile file = one_term();
  file.raw_files = {{"x--\u00fc.csv", std::string(64, 'a')}, {"plain.csv", std::string(64, 'b')}};
  RubberCardOptions options = with_units("abaqus");
  options.file_name = "gr\u00fcn.json";
  options.file_sha256 = std::string(64, 'c');
  CHECK_THAT(rubber_file_card(file, "foam.json", options),
             Contains("** raw data x-%2D%C3%BC.csv sha256 aaaa") &&
                 Contains("** raw data plain.csv sha256 bbbb") &&
                 Contains("** material file gr%C3%BCn.json sha256 cccc"));
}

TEST_CASE("foam cards: other targets and a bulk modulus are refused", "[cards][foam]") {
  for (const std::string& target : rubber_card_targets()) {
    if (target == "abaqus" || target == "calculix" || target == "lsdyna" || target == "openradioss")
      continue;
    CAPTURE(target);
    CHECK_THROWS_WITH(foam_text(one_term(), target),
                      Contains("no card of a foam (hyperfoam-1) for " + target) &&
                          Contains("abaqus, calculix, lsdyna, openradioss"));
  }
  RubberCardOptions options = with_units("abaqus");
  options.bulk_Pa = 1e6;
  CHECK_THROWS_WITH(rubber_file_card(one_term(), "foam.json", options),
                    Contains("bulk modulus of a foam follows"));
}

TEST_CASE("foam cards: what was written is read back, in every unit system",
          "[cards][foam][identity]") {
  for (const char* units : {"SI", "mm-t-s", "mm-kg-ms", "mm-g-ms", "um-kg-s", "cgs"}) {
    for (const char* target : {"abaqus", "calculix", "lsdyna", "openradioss"}) {
      for (const HyperelasticFile& file : {one_term(), two_terms(), three_terms(),
                                           foam_file({{0.05, 8.0, 0.0}, {0.01, -2.0, 0.0}})}) {
        const bool is_one_nu = file.foam->nu.minCoeff() == file.foam->nu.maxCoeff();
        if (std::string(target) == "lsdyna" && !is_one_nu) continue;
        const std::string card = foam_text(file, target, units);
        CAPTURE(units, target, card);
        const RubberCheck check = check_rubber_card(card, &file, {.target = target});
        CHECK(check.agrees);
        CHECK(check.findings.empty());
        REQUIRE(check.read.foam);
        CHECK(name_of(check.read) == name_of(file));
        CHECK(check_rubber_card(card, nullptr, {.target = target}).findings.empty());
        CHECK(looks_like_rubber_card(card));
      }
    }
  }
}

TEST_CASE("foam cards: edited numbers and common mistakes are named", "[cards][foam]") {
  const HyperelasticFile file = two_terms(), one = one_term();
  const std::string right = foam_text(file, "abaqus"), dyna = foam_text(one, "lsdyna");
  CHECK_THAT(rubber_findings(with_last(right, "0.05, 8,", "0.06, 8,"), "abaqus", &file),
             Contains("numbers-differ: mu_1_Pa is 60000, 1.2 times"));
  CHECK_THAT(rubber_findings(with_last(right, "-2, 0.2, 0.05", "-2, 0.2, 0.06"), "abaqus", &file),
             Contains("nu_2 is 0.06"));
  // 2 mu/alpha: 0.0125 and -0.01.
  CHECK_THAT(rubber_findings(with_last(right, "0.05, 8, 0.01, -2", "0.0125, 8, -0.01, -2"),
                             "abaqus", &file),
             Contains("foam-own-constants: "));
  // beta = 1/3 and 0.0555...
  CHECK_THAT(rubber_findings(with_last(right, "-2, 0.2, 0.05", "-2, 0.3333333333, 0.05555555556"),
                             "abaqus", &file),
             Contains("beta-for-nu: "));
  CHECK_THAT(rubber_findings(with_last(dyna, ".33333333", "       .2"), "lsdyna", &one),
             Contains("nu-for-beta: "));
  CHECK_THAT(rubber_findings(with_last(dyna, "     .0125", "       .05"), "lsdyna", &one),
             Contains("foam-shear-moduli: "));
  CHECK_THAT(rubber_findings(with_last(right, "0.05, 8, 0.01, -2", "50000, 8, 10000, -2"), "abaqus",
                             &file),
             Contains("stress-unit: "));
  CHECK_THAT(rubber_findings(right, "abaqus", &one),
             Contains("other-law: the card has the law hyperfoam-2, not hyperfoam-1"));
  CHECK_THAT(rubber_findings(with_last(right, "0.05, 8,", "0.06, 8,"), "abaqus", nullptr),
             Contains("header-differs: Young's modulus"));
  // CalculiX with one term.
  CHECK_THAT(
      rubber_findings("*MATERIAL, NAME=F\n*HYPERFOAM, N=1\n0.05, 8, 0.2\n", "calculix", &one),
      Contains("calculix-one-term: line 2"));
  CHECK_THAT(rubber_findings("*MATERIAL, NAME=F\n*HYPERFOAM\n0.05, 8, 0.2, 7\n", "abaqus", &one),
             Contains("other-count: "));
  CHECK_THAT(
      rubber_findings("*MATERIAL, NAME=F\n*HYPERFOAM\n0.05, 8, 0.2\n*VISCOELASTIC, TIME=PRONY\n"
                      "0.2, 0.2, 1\n",
                      "abaqus", nullptr),
      Contains("foam-with-terms: "));
  CHECK_THAT(
      rubber_findings(
          "*MATERIAL, NAME=F\n*HYPERFOAM, N=1\n0.05, 8, 0.2\n*MULLINS EFFECT\n1.5, 0.004, 0.1\n",
          "abaqus", &one),
      Contains("damage-beside-foam: "));
}

TEST_CASE("foam cards: a file of a foam is read again", "[io][foam]") {
  const HyperelasticFile file = two_terms();
  const HyperelasticFile read = hyperelastic_from_json(json_from_card_of_rubber(file), "foam.json");
  REQUIRE(read.foam);
  CHECK(read.foam->mu_Pa == file.foam->mu_Pa);
  CHECK(read.foam->alpha == file.foam->alpha);
  CHECK(read.foam->nu == file.foam->nu);
  CHECK(read.E0_Pa == Approx(0.141882353e6).epsilon(1e-8));
  CHECK(name_of(read) == "hyperfoam-2");
}

TEST_CASE("foam cards: CalculiX runs one cube to the stress of the law", "[cards][foam]") {
  struct Run {
    HyperelasticFile file;
    Deformation deformation;
    double stretch, reference_MPa;  // numpy, from the formula of the law
  };
  for (const Run& run : {Run{one_term(), Deformation::kUniaxial, 0.7, -0.0305682449},
                         Run{two_terms(), Deformation::kUniaxial, 0.7, -0.0463781816},
                         Run{two_terms(), Deformation::kUniaxial, 1.3, 0.0756330196},
                         Run{two_terms(), Deformation::kPlanar, 0.7, -0.0511654109},
                         Run{two_terms(), Deformation::kEquibiaxial, 0.7, -0.0899007076}}) {
    CAPTURE(name_of(run.deformation), run.stretch);
    const std::string card = foam_card(*run.file.foam, with_units("calculix"));
    CHECK(run_in_calculix(cube_deck(card, run.deformation, run.stretch)) ==
          Approx(run.reference_MPa).epsilon(2e-6));
  }
  // Confined: all sides held.
  std::string deck =
      cube_deck(foam_card(*two_terms().foam, with_units("calculix")), Deformation::kPlanar, 0.7);
  deck = with_last(deck, "BACK,2,2\n", "BACK,2,2\nRIGHT,1,1\n");
  CHECK(run_in_calculix(deck) == Approx(-0.0606201943).epsilon(2e-6));
  // Volumetric: all three sides are moved alike.
  deck = cube_deck(foam_card(*two_terms().foam, with_units("calculix")), Deformation::kEquibiaxial,
                   0.7);
  deck = with_last(deck, "RIGHT,1,1,-0.3\n", "RIGHT,1,1,-0.3\nBACK,2,2,-0.3\n");
  CHECK(run_in_calculix(deck) == Approx(-0.3252024).epsilon(2e-6));
}
