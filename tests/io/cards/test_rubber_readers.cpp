// Cards of rubber for FrontISTR, SfePy, MFront, MOOSE and COMSOL that are read back: what their readers refuse and
// report. The round trip of every law is in test_check_rubber.cpp.
#include "io/cards/hyperelastic/check_rubber.h"
#include "tests/io/cards/rubber_rules.h"

#include <catch2/catch.hpp>

using namespace viscard;
using namespace viscard::test;
using Catch::Matchers::Contains;

namespace {

std::string edited(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

const Rubber& neo_hooke() {
  static const Rubber kRubber = rubber_of(HyperelasticForm::kNeoHooke, {2e5}, {}, {});
  return kRubber;
}

const Rubber& ogden() {
  static const Rubber kRubber =
      rubber_of(HyperelasticForm::kOgden2, {2e5, 1e4}, {1.3, -2.1}, {{0.1, 0.05}, {0.3, 7.0}});
  return kRubber;
}

// The first mistake of the card of a target, compared with its law.
std::string first_mistake(const std::string& card, const Rubber& rubber,
                          const std::string& target) {
  HyperelasticFile file;
  file.law = rubber.law;
  file.terms = rubber.terms;
  const RubberCheck check = check_rubber_card(card, &file, {.target = target, .units = "mm-t-s"});
  CHECK_FALSE(check.agrees);
  for (const CardFinding& finding : check.findings) {
    if (finding.is_mistake) return finding.name;
  }
  return "";
}

ReadRubber read_as_mm(const std::string& card, const std::string& target) {
  return read_rubber_card(card, target, "mm-t-s");
}

}  // namespace

TEST_CASE("rubber cards: mistakes in cards of SfePy, MFront, FrontISTR, MOOSE and COMSOL are named",
          "[io]") {
  const std::string sfepy = card_of(ogden(), "sfepy"), mfront = card_of(ogden(), "mfront");
  // SfePy takes Ogden's own constants, 2 mu/alpha: 0.307692 and -0.00952381 of 0.2 and 0.01.
  CHECK(first_mistake(edited(edited(sfepy, "[[0.3076923", "[[0.2, 1.3]],  # "), "[[-0.0095238",
                             "[[0.01, -2.1]],  # "),
                      ogden(), "sfepy") == "ogden-shear-moduli");
  CHECK(first_mistake(edited(sfepy, "TAU = [0.05, 7]", "TAU = [7, 0.05]"), ogden(), "sfepy") ==
        "terms-swapped");
  CHECK(first_mistake(edited(sfepy, "G = [0.1, 0.3]", "G = [0.166666667, 0.5]"), ogden(),
                      "sfepy") == "g-of-long-term");
  CHECK(first_mistake(edited(mfront, "tau[Nv] = {0.05, 7}", "tau[Nv] = {20, 0.142857143}"), ogden(),
                      "mfront") == "tau-for-beta");
  CHECK(first_mistake(
            edited(mfront, "mu[Nt] = {0.2, 0.01}", "mu[Nt] = {0.307692308, -0.00952380952}"),
            ogden(), "mfront") == "ogden-own-constants");
  const std::string frontistr = card_of(neo_hooke(), "frontistr");
  CHECK(first_mistake(edited(frontistr, "\n0.2, ", "\n0.4, "), neo_hooke(), "frontistr") ==
        "double-constants");
  CHECK(first_mistake(frontistr + "!VISCOELASTIC\n0.3, 0.4\n", neo_hooke(), "frontistr") ==
        "last-decides");
  CHECK(first_mistake("!HYPERELASTIC, TYPE=NEOHOOKE\n0.2, 0\n", neo_hooke(), "frontistr") ==
        "replaced-D");
  const std::string moose = card_of(neo_hooke(), "moose");
  CHECK(first_mistake(edited(moose, "    mu = 0.4", "    mu = 0.2"), neo_hooke(), "moose") ==
        "half-constants");
  CHECK(first_mistake(edited(moose, "large_kinematics = true", "large_kinematics = false"),
                      neo_hooke(), "moose") == "small-kinematics");
  // Each number of COMSOL has its unit, so that --units changes nothing.
  const std::string comsol = card_of(neo_hooke(), "comsol");
  CHECK(read_as_mm(edited(comsol, "0.4[MPa]", "400[kPa]"), "comsol").law.moduli_Pa[0] ==
        Approx(2e5).epsilon(1e-12));
  CHECK(first_mistake(edited(comsol, "0.4[MPa]", "0.4[Pa]"), neo_hooke(), "comsol") ==
        "stress-unit");
}

TEST_CASE("rubber cards: behaviours and modules of another formula are refused with the line",
          "[io]") {
  const std::string mfront = card_of(ogden(), "mfront"), sfepy = card_of(ogden(), "sfepy");
  CHECK_THROWS_WITH(
      read_as_mm(edited(mfront, "2 * mu[i] / alpha[i]", "mu[i] / alpha[i]"), "mfront"),
      Contains("line ") && Contains("is not that of viscard's card"));
  CHECK_THROWS_WITH(read_as_mm(mfront + "@Predictor {}\n", "mfront"), Contains("no such line"));
  CHECK_THROWS_WITH(read_as_mm(edited(mfront, "@Behaviour", "@Law"), "mfront"),
                    Contains("no @Behaviour"));
  CHECK_THROWS_WITH(read_as_mm(edited(mfront, "@Parameter real K", "@Parameter real k"), "mfront"),
                    Contains("the card has no K"));
  CHECK_THROWS_WITH(read_as_mm(edited(mfront, "g[Nv] = {0.1, 0.3}", "g[Nv] = {0.1}"), "mfront"),
                    Contains("g and tau must have the same length"));
  CHECK_THROWS_WITH(
      read_as_mm(edited(mfront, "@Parameter real K", "@Parameter real K = 1;\n@Parameter real K"),
                 "mfront"),
      Contains("K is set a second time"));
  CHECK_THROWS_WITH(read_as_mm(edited(sfepy, "dw_tl_he_ogden", "dw_tl_he_new"), "sfepy"),
                    Contains("the term dw_tl_he_new of SfePy is not read"));
  CHECK_THROWS_WITH(read_as_mm(edited(sfepy, "\"ogden1\": [[", "\"ogden1\": [[1, "), "sfepy"),
                    Contains("odd number"));
  CHECK_THROWS_WITH(read_as_mm("VALUES = {}\n", "sfepy"), Contains("of one law in its TERMS"));
  CHECK_THROWS_WITH(
      read_as_mm("    \"y\": [[1, 4]],\n    (\"dw_tl_he_genyeoh\", \"y\"),\n", "sfepy"),
      Contains("powers 1, 2 and 3"));
}

TEST_CASE("rubber cards: what FrontISTR, MOOSE and COMSOL lack is refused", "[io]") {
  CHECK_THROWS_WITH(read_as_mm("!HYPERELASTIC, TYPE=YEOH\n1, 2\n", "frontistr"),
                    Contains("only NEOHOOKE"));
  CHECK_THROWS_WITH(read_as_mm("!ELASTIC\n1, 0.4\n", "frontistr"),
                    Contains("the card has no !HYPERELASTIC"));
  CHECK_THROWS_WITH(read_as_mm("[Materials]\n[]\n", "moose"),
                    Contains("no ComputeNeoHookeanStress"));
  CHECK_THROWS_WITH(read_as_mm("R_mu 1[MPa]\nR_C10 1[MPa]\n", "comsol"), Contains("or has both"));
  CHECK_THROWS_WITH(read_as_mm("R_mu 1[psi]\n", "comsol"), Contains("unit [psi] is not known"));
  CHECK_THROWS_WITH(read_as_mm("R_mu 1[MPa]\nS_mu 1[MPa]\n", "comsol"), Contains("twice"));
}

TEST_CASE("rubber cards: what other programs write for the same law is read as that law", "[io]") {
  const auto moduli = [](const std::string& text, const char* target) {
    CAPTURE(text);
    CHECK(looks_like_rubber_card(text));
    const ReadRubber read = read_rubber_card(text, target, "");
    CHECK_FALSE(has_unread_parts(read.findings));
    for (const CardFinding& finding : read.findings) CHECK_FALSE(finding.is_mistake);
    return std::vector<double>(read.law.moduli_Pa.begin(), read.law.moduli_Pa.end());
  };
  const std::vector<double> mooney{0.15, 0.02}, yeoh{0.2, 0.03, 0.005}, two_orders{0.2, 0.03, 0.0};
  // Abaqus: capitals are free, blank cells are 0, eight cells to a line.
  const std::string head = "*Material, name=R\n";
  CHECK(moduli(head + "*Hyperelastic, mooney-rivlin\n0.15, 0.02,, ,\n", "abaqus") == mooney);
  CHECK(moduli(head + "*Hyperelastic, polynomial, n=2\n0.15, 0.02, , , , 0.001\n", "abaqus") ==
        mooney);
  CHECK(moduli(head + "*Hyperelastic, polynomial, n=2\n0.2, , 0.03, , , 0.001\n", "abaqus") ==
        two_orders);
  CHECK(moduli(head + "*Hyperelastic, polynomial, n=3\n0.2, , 0.03, , , 0.005, , \n, 0.001\n",
               "abaqus") == yeoh);
  CHECK(moduli(head + "*Hyperelastic, reduced polynomial, n=2\n0.2, 0.03, 0.001\n", "abaqus") ==
        two_orders);
  CHECK(read_rubber_card(head + "*Hyperelastic, mooney-rivlin\n0.2, , 0.001\n", "abaqus", "")
            .bulk_Pa == Approx(2000.0));
  // ANSYS: three, five and nine constants of Mooney and Rivlin, and POLY.
  CHECK(moduli("TB,HYPE,1,1,3,MOON\nTBDATA,1,0.15,0.02,0,0.001\n", "ansys") == mooney);
  CHECK(moduli("tb,hyper,1,1,5,mooney\ntbdata,1,0.2,0,0.03,0,0,0.001\n", "ansys") == two_orders);
  CHECK(moduli("TB,HYPER,1,1,9,MOONEY\nTBDATA,1,0.2,0,0.03,0,0,0.005\nTBDATA,7,0,0,0,0.001\n",
               "ansys") == yeoh);
  CHECK(moduli("TB,HYPER,1,1,2,POLY\nTBDATA,1,0.15,0.02,0,0,0,0.001\n", "ansys") == mooney);
  CHECK(moduli("TB,HYPER,1,1,2,YEOH\nTBDATA,1,0.2,0.03,0.001\n", "ansys") == two_orders);
  // LS-DYNA: twenty columns, or commas.
  const std::string row = "*MAT_HYPERELASTIC_RUBBER";
  CHECK(moduli("*KEYWORD LONG=Y\n" + row +
                   "\n                   1             1.1E-09               0.499"
                   "                   0\n                0.15                0.02\n*END\n",
               "lsdyna") == mooney);
  CHECK(moduli("*KEYWORD\n" + row +
                   " +\n                   7             1.1E-09               0.499\n"
                   "                0.15                0.02\n*END\n",
               "lsdyna") == mooney);
  CHECK(moduli("*KEYWORD\n" + row + "\n7,1.1E-9,.499\n.15,.02\n*END\n", "lsdyna") == mooney);
  // A constant of no law of viscard is named.
  CHECK_THROWS_WITH(
      read_rubber_card("*HYPERELASTIC, POLYNOMIAL, N=2\n0.2,0.1,0,0.03,0,0.001\n", "abaqus", ""),
      Contains("C11 = 0.03 is not of Neo-Hooke, Mooney-Rivlin or Yeoh"));
  CHECK_THROWS_WITH(
      read_rubber_card("TB,HYPER,1,1,5,MOONEY\nTBDATA,1,0.2,0.1,0.03,0,0,0.001\n", "ansys", ""),
      Contains("C01 = 0.1 is not of") && Contains("beside C20"));
}
