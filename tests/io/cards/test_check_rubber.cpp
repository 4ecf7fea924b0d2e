// Cards of rubber that are read back: round trip, and mistakes that are named.
#include "io/cards/hyperelastic/check_rubber.h"
#include "io/cards/unit_system.h"
#include "tests/io/cards/rubber_rules.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace viscard;
using namespace viscard::test;
using Catch::Matchers::Contains;

namespace {

std::vector<Rubber> all_laws(const std::vector<RubberTerm>& terms) {
  using Form = HyperelasticForm;
  std::vector<Rubber> out;
  out.push_back(rubber_of(Form::kNeoHooke, {2.1e5}, {}, terms));
  out.push_back(rubber_of(Form::kMooneyRivlin, {1.5e5, 2.3e4}, {}, terms));
  out.push_back(rubber_of(Form::kYeoh, {1.8e5, -1.4e3, 40.0}, {}, terms));
  out.push_back(rubber_of(Form::kOgden1, {3.1e5}, {2.9}, terms));
  out.push_back(rubber_of(Form::kOgden2, {2.2e5, 1.1e4}, {1.3, -2.1}, terms));
  out.push_back(rubber_of(Form::kOgden3, {3.45e5, 6.2e3, 4.2}, {1.9, -2.2, 8.5}, terms));
  out.push_back(rubber_of(Form::kArrudaBoyce, {2.7e5}, {3.2}, terms));
  out.push_back(rubber_of(Form::kGent, {2.7e5}, {80.0}, terms));
  return out;
}

HyperelasticFile file_of(const Rubber& rubber) {
  HyperelasticFile file;
  file.law = rubber.law;
  file.terms = rubber.terms;
  return file;
}

constexpr double kBulk_Pa = 3e8;

// The card, or nothing where the target refuses the law.
std::string card_or_nothing(const Rubber& rubber, const std::string& target,
                            const std::string& units) {
  try {
    return rubber_card(rubber.law, rubber.terms,
                       {.target = target,
                        .units = units,
                        .bulk_Pa = kBulk_Pa,
                        .density_kg_m3 = 1100.0,
                        .may_approximate = true});
  } catch (const std::invalid_argument&) {
    return "";
  }
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

// The name of the first mistake.
std::string mistake_in(const std::string& card, const Rubber& rubber, const std::string& target,
                       std::optional<double> bulk_Pa = std::nullopt) {
  const HyperelasticFile file = file_of(rubber);
  const RubberCheck check =
      check_rubber_card(card, &file, {.target = target, .units = "mm-t-s", .bulk_Pa = bulk_Pa});
  CHECK_FALSE(check.agrees);
  for (const CardFinding& finding : check.findings) {
    if (finding.is_mistake) return finding.name;
  }
  return "";
}

}  // namespace

namespace {

bool agrees_in_febio(const std::string& card, const Rubber& rubber) {
  const HyperelasticFile file = file_of(rubber);
  return check_rubber_card(card, &file, {.target = "febio", .units = "mm-t-s"}).agrees;
}

}  // namespace

TEST_CASE("rubber cards: every law in every unit system is read back from every target", "[io]") {
  int read = 0;
  for (const auto& terms :
       {std::vector<RubberTerm>{}, std::vector<RubberTerm>{{0.2, 0.013}, {0.25, 3.7}}}) {
    for (const Rubber& rubber : all_laws(terms)) {
      const HyperelasticFile file = file_of(rubber);
      for (const std::string& target : rubber_card_targets()) {
        for (const UnitSystem& units : unit_systems()) {
          CAPTURE(name_of(rubber.law.form), target, units.name, terms.size());
          const std::string card = card_or_nothing(rubber, target, units.name);
          if (card.empty()) continue;
          ++read;
          CAPTURE(card);
          // A Mooney-Rivlin of FEBio may be the child of a linear card; COMSOL has parameters alone.
          CHECK((looks_like_rubber_card(card) || target == "comsol" ||
                 card.find("\"Mooney-Rivlin\"") != std::string::npos));
          // Ten columns of lsdyna, where Poisson's ratio stands for the bulk modulus.
          const bool is_exact = target != "lsdyna";
          const RubberCheck check = check_rubber_card(
              card, &file,
              {.target = target,
               .units = units.name,
               .bulk_Pa = is_exact ? std::optional<double>(kBulk_Pa) : std::nullopt});
          CHECK(check.agrees);
          CHECK(*check.difference <= (is_exact ? 1e-8 : check.tolerance));
          CHECK(check.tolerance <= 1e-3);
          CHECK(check.read.bulk_Pa == Approx(kBulk_Pa).epsilon(is_exact ? 1e-8 : 1e-2));
        }
      }
    }
  }
  // Laws with terms: abaqus 7, ansys 8, febio 8, lsdyna 6, mfront 8, openradioss 5, sfepy 6; without: calculix 7 and
  // frontistr 3 in units that they take, comsol 2, moose 1, and 7 of openradioss.
  CHECK(read >= 6 * (7 + 8 + 8 + 6 + 8 + 5 + 6) + 6 * (7 + 8 + 2 + 8 + 6 + 8 + 1 + 7 + 6) + 7 + 3);
}

TEST_CASE("rubber cards: a wrong basis, order or convention of a card is named", "[io]") {
  const Rubber ogden =
      rubber_of(HyperelasticForm::kOgden2, {2e5, 1e4}, {1.3, -2.1}, {{0.1, 0.05}, {0.3, 7.0}});
  const Rubber mooney = rubber_of(HyperelasticForm::kMooneyRivlin, {1.5e5, 2e4}, {}, {{0.3, 0.4}});
  const Rubber neo_hooke = rubber_of(HyperelasticForm::kNeoHooke, {2e5}, {}, {{0.3, 0.4}});
  const auto card = [](const Rubber& rubber, const char* target) {
    return card_or_nothing(rubber, target, "mm-t-s");
  };
  CHECK(mistake_in(changed(card(ogden, "abaqus"), ", MODULI=INSTANTANEOUS", ""), ogden, "abaqus") ==
        "instantaneous-for-long-term");
  // A tag that FEBio does not know: g0 is 1.
  CHECK(mistake_in(changed(changed(card(ogden, "febio"), "<g0>", "<h0>"), "</g0>", "</h0>"), ogden,
                   "febio") == "branches-on-top");
  CHECK(mistake_in(changed(card(mooney, "abaqus"), "0.15, 0.02", "0.02, 0.15"), mooney, "abaqus") ==
        "order-exchanged");
  CHECK(mistake_in(changed(card(neo_hooke, "abaqus"), "0.3, 0, 0.4", "0.3, 0, 2.5"), neo_hooke,
                   "abaqus") == "tau-for-beta");
  CHECK(mistake_in(changed(card(ogden, "abaqus"), "0.1, 0, 0.05", "0.3, 0, 0.05"), ogden,
                   "abaqus") == "numbers-differ");
  CHECK(mistake_in(changed(changed(card(ogden, "abaqus"), "0.1, 0, 0.05", "0.3, 0, 0.05"),
                           "0.3, 0, 7", "0.1, 0, 7"),
                   ogden, "abaqus") == "terms-swapped");
  CHECK(mistake_in(changed(card(neo_hooke, "abaqus"), "0.3, 0, 0.4", "0.4, 0, 0.3"), neo_hooke,
                   "abaqus") == "g-and-tau-exchanged");
  CHECK(mistake_in(changed(card(neo_hooke, "abaqus"), "0.3, 0, 0.4", "0.3, 0, 400"), neo_hooke,
                   "abaqus") == "time-unit");
  CHECK(mistake_in(changed(card(neo_hooke, "abaqus"), "\n0.2, ", "\n200000, "), neo_hooke,
                   "abaqus") == "stress-unit");
  CHECK(mistake_in(changed(card(neo_hooke, "abaqus"), "\n0.2, ", "\n0.4, "), neo_hooke, "abaqus") ==
        "double-constants");
  CHECK(mistake_in(changed(card(neo_hooke, "abaqus"), "\n0.2, ", "\n0.14, "), neo_hooke,
                   "abaqus") == "long-term-for-instantaneous");
  // mu = 0.2, 0.01 MPa; Ogden's own constants are 2 mu/alpha.
  CHECK(mistake_in(changed(changed(card(ogden, "ansys"), "TBDATA,1,0.3076923", "TBDATA,1,0.2 !"),
                           "TBDATA,3,-0.0095238", "TBDATA,3,0.01 !"),
                   ogden, "ansys") == "ogden-shear-moduli");
  CHECK(mistake_in(changed(card(ogden, "abaqus"), "0.2, 1.3, 0.01, -2.1",
                           "0.307692308, 1.3, -0.00952380952, -2.1"),
                   ogden, "abaqus") == "ogden-own-constants");
  // K = 300 MPa: D = 2/300.
  CHECK(mistake_in("*MATERIAL, NAME=R\n*HYPERELASTIC, NEO HOOKE\n0.2, 300\n",
                   rubber_of(HyperelasticForm::kNeoHooke, {2e5}, {}, {}), "abaqus",
                   kBulk_Pa) == "K-for-D");
  CHECK(mistake_in("*MATERIAL, NAME=R\n*HYPERELASTIC, NEO HOOKE\n0.2, 0.0033333333333\n",
                   rubber_of(HyperelasticForm::kNeoHooke, {2e5}, {}, {}), "abaqus",
                   kBulk_Pa) == "D-without-2");
  CHECK(mistake_in(card(mooney, "abaqus"), neo_hooke, "abaqus") == "other-law");
  CHECK(mistake_in(card(ogden, "calculix") + card(neo_hooke, "abaqus"), neo_hooke, "calculix") ==
        "ignored-viscoelastic");
  const Rubber chains = rubber_of(HyperelasticForm::kArrudaBoyce, {2.7e5}, {3.2}, {{0.3, 0.4}});
  CHECK(mistake_in(changed(card(neo_hooke, "lsdyna"), " .12       2.5", " .12       0.4"),
                   neo_hooke, "lsdyna") == "tau-for-beta");
}

TEST_CASE("rubber cards: wrong shares, limits, numbers of terms and volumes are named", "[io]") {
  const Rubber neo_hooke = rubber_of(HyperelasticForm::kNeoHooke, {2e5}, {}, {{0.3, 0.4}});
  const Rubber chains = rubber_of(HyperelasticForm::kArrudaBoyce, {2.7e5}, {3.2}, {{0.3, 0.4}});
  const std::string card = card_or_nothing(neo_hooke, "abaqus", "mm-t-s");
  // 0.3 of the law at once is 0.3/0.7 of the law after all relaxation.
  CHECK(mistake_in(changed(card, "0.3, 0, 0.4", "0.428571429, 0, 0.4"), neo_hooke, "abaqus") ==
        "g-of-long-term");
  CHECK(mistake_in(changed(card, "\n0.2, ", "\n0.1, "), neo_hooke, "abaqus") == "half-constants");
  CHECK(
      mistake_in(changed(card_or_nothing(chains, "abaqus", "mm-t-s"), "0.27, 3.2,", "0.27, 10.24,"),
                 chains, "abaqus") == "N-for-s_m");
  CHECK(mistake_in(card + "0.1, 0, 7\n", neo_hooke, "abaqus") == "other-terms");
  CHECK(mistake_in(changed(card, "0.3, 0, 0.4", "0.3, 0.3, 0.4"), neo_hooke, "abaqus") ==
        "bulk-relaxes");
  CHECK(mistake_in("*MATERIAL, NAME=R\n*HYPERELASTIC, NEO HOOKE\n0.2, 0\n",
                   rubber_of(HyperelasticForm::kNeoHooke, {2e5}, {}, {}),
                   "calculix") == "replaced-D");
}

TEST_CASE("rubber cards: what cannot be read is refused with its reason", "[io]") {
  CHECK_THROWS_WITH(read_rubber_card("*MATERIAL, NAME=R\n*ELASTIC\n1, 0.4\n", "abaqus", ""),
                    Contains("the card has no *HYPERELASTIC"));
  CHECK_THROWS_WITH(read_rubber_card("", "sofa", ""), Contains("no card of rubber for 'sofa'"));
  CHECK_THROWS_WITH(read_rubber_card("*HYPERELASTIC, VAN DER WAALS\n1, 2\n", "abaqus", ""),
                    Contains("only OGDEN"));
  CHECK_THROWS_WITH(read_rubber_card("*HYPERELASTIC, YEOH\n1, 2\n", "abaqus", ""),
                    Contains("has 2 numbers, not the 3"));
  CHECK_THROWS_WITH(read_rubber_card("TB,HYPER,1,1,2,OGDEN\nTBDATA,1,1\n", "ansys", ""),
                    Contains("has 1 numbers, not the 4"));
  CHECK_FALSE(looks_like_rubber_card("*ELASTIC\n1, 0.4\n"));
}

TEST_CASE("rubber cards: FEBio's Yeoh and Arruda-Boyce are read as its versions compute them",
          "[io]") {
  const Rubber yeoh = rubber_of(HyperelasticForm::kYeoh, {2e5, 3e4, 5e3}, {}, {});
  const auto card = [](const std::string& type, const std::string& numbers) {
    return "<!-- units: mm-t-s -->\n<material id=\"1\" name=\"R\" type=\"" + type + "\">\n" +
           numbers + "<k>300</k>\n</material>\n";
  };
  // c_i = C_i0 is right before 2023 only; c_i = i C_i0 since then.
  CHECK(mistake_in(card("Yeoh", "<c1>0.2</c1><c2>0.03</c2><c3>0.005</c3>"), yeoh, "febio") ==
        "yeoh-of-older-febio");
  CHECK(agrees_in_febio(card("Yeoh", "<c1>0.2</c1><c2>0.06</c2><c3>0.015</c3>"), yeoh));
  CHECK(agrees_in_febio(
      card("uncoupled hyperelastic", "<W>2E-1*(I1 - 3) + .03*(I1-3)^2 + 0.005*(I1-3)^3</W>"),
      yeoh));
  CHECK(mistake_in(card("uncoupled hyperelastic", "<W>0.2*(I1-3)+0.03*(I1-3)^2+0.006*(I1-3)^3</W>"),
                   yeoh, "febio") == "numbers-differ");
  const Rubber chains = rubber_of(HyperelasticForm::kArrudaBoyce, {2.7e5}, {3.2}, {});
  CHECK(mistake_in(card("Arruda-Boyce", "<mu>0.27</mu><N>10.24</N>"), chains, "febio") ==
        "febio-arruda-boyce");
  const std::string right = card_or_nothing(chains, "febio", "mm-t-s");
  const std::size_t third = right.find("+", right.find("I1^2")) + 1;
  CHECK_THROWS_WITH(read_rubber_card(std::string(right).insert(third, "1"), "febio", ""),
                    Contains("the factor of I1^3") && Contains("times the"));
  CHECK_THROWS_WITH(
      read_rubber_card(card("uncoupled hyperelastic", "<W>0.2*(I1-2)</W>"), "febio", ""),
      Contains("W is not 0 at rest"));
  CHECK_THROWS_WITH(read_rubber_card(card("uncoupled hyperelastic", "<W>exp(I1)</W>"), "febio", ""),
                    Contains("line 3: 'exp(I1)' is not read"));
}

TEST_CASE("rubber cards: what FEBio stops at, and what of a card is not read, is named", "[io]") {
  const Rubber ogden = rubber_of(HyperelasticForm::kOgden1, {3e5}, {1.3}, {{0.2, 0.1}});
  const std::string right = card_or_nothing(ogden, "febio", "mm-t-s");
  CHECK(agrees_in_febio(right, ogden));
  CHECK(mistake_in(changed(right, "uncoupled viscoelastic", "viscoelastic"), ogden, "febio") ==
        "coupled-parent");
  const std::string mooney =
      "<material type=\"viscoelastic\"><elastic "
      "type=\"Mooney-Rivlin\"><c1>1</c1><c2>0</c2></elastic></material>";
  CHECK(looks_like_rubber_card(mooney));
  CHECK_FALSE(
      looks_like_rubber_card(changed(mooney, "\"viscoelastic\"", "\"uncoupled viscoelastic\"")));
  CHECK(mistake_in(changed(right, "  <k>300</k>\n", ""), ogden, "febio") == "missing-bulk-modulus");
  const auto unread = [&](const std::string& text) {
    std::string out;
    for (const CardFinding& finding : read_rubber_card(text, "febio", "").findings)
      if (finding.name == "not-read")
        out += finding.text.substr(0, finding.text.find(" is not")) + "|";
    return out;
  };
  CHECK(unread(right) == "");
  CHECK(unread(changed(right, "<c1>", "<pressure_model>2</pressure_model><c1 lc=\"1\">")) ==
        "line 7: <pressure_model>|line 7: <c1 lc=\"1\">|");
}

TEST_CASE("rubber cards: what of a card was not read is listed", "[io]") {
  const auto findings = [](const std::string& text, const char* target) {
    std::string out;
    for (const CardFinding& finding : read_rubber_card(text, target, "").findings)
      out += finding.name + ": " + finding.text + "|";
    return out;
  };
  const std::string mooney = "*MATERIAL, NAME=R\n*HYPERELASTIC, MOONEY-RIVLIN\n0.15, 0.02, 0.001\n";
  CHECK(findings(mooney, "abaqus") == "");
  CHECK(findings(mooney + "*NODE\n1, 0., 0., 0.\n*STEP\n*STATIC\n", "abaqus") == "");
  CHECK_THAT(findings(mooney + "*EXPANSION\n1e-4\n", "abaqus"),
             Contains("not-read: line 4: '*EXPANSION'") && Contains("not-read: line 5: '1e-4'"));
  CHECK(findings(mooney + "*MULLINS EFFECT\n1.2, 0.1, 0.1\n", "abaqus") == "");
  CHECK_THAT(findings(mooney + "*HYSTERESIS\n1.6, 0.05, 4, -0.5\n", "abaqus"),
             Contains("other-law: line 4: *HYSTERESIS"));
  CHECK_THAT(findings(mooney + "*MATERIAL, NAME=S\n", "abaqus"), Contains("several-materials"));
  CHECK_THAT(findings("*HYPERELASTIC, NEO HOOKE\n0.2, 0.001, 7.5\n", "abaqus"),
             Contains("other-count: line 1: 3 numbers stand below"));
  // The same laws by their other names.
  CHECK(read_rubber_card("*HYPERELASTIC, REDUCED POLYNOMIAL, N=3\n.2,.03,.005,.001,0,0\n", "abaqus",
                         "")
            .law.form == HyperelasticForm::kYeoh);
  CHECK(read_rubber_card("*HYPERELASTIC, POLYNOMIAL, N=1\n.2,.03,.001\n", "abaqus", "").law.form ==
        HyperelasticForm::kMooneyRivlin);
  // Announced counts.
  CHECK_THAT(
      findings("TB,HYPER,1,1,,NEO\nTBDATA,1,0.4,0.001\nTB,PRONY,1,1,8,SHEAR\nTBDATA,1,0.3,0.4\n",
               "ansys"),
      Contains("npts-mismatch: line 3: TB,PRONY announces 8 pairs and 1 are given"));
  CHECK(findings("TB,HYPER,1,1,,NEO\nTBTEMP,0.0\nTBDATA,1,0.4,0.001\nTB,PRON,1,1,1,SHEA\n"
                 "TBDAT,1,0.3,0.4\n",
                 "ansys") == "");
  // A foam's nu = 0 is K = 2G/3.
  const std::string foam =
      "/MAT/LAW62/11\nFoam\n               5E-11                   0\n"
      "                   0         2         0                   0         0         0\n"
      "                .015                .005\n                   2                  -2\n"
      "                   0                   0\n";
  const ReadRubber read = read_rubber_card(foam, "openradioss", "");
  CHECK(read.bulk_Pa == Approx(2.0 / 3.0 * 0.02));
  CHECK(findings(foam, "openradioss") == "");
  const Rubber ogden = rubber_of(HyperelasticForm::kOgden1, {3e5}, {1.3}, {{0.2, 0.1}});
  // Every right card of viscard is read to its last word.
  for (const auto& terms : {std::vector<RubberTerm>{}, std::vector<RubberTerm>{{0.2, 0.013}}}) {
    for (const Rubber& rubber : all_laws(terms)) {
      for (const std::string& target : rubber_card_targets()) {
        const std::string card = card_or_nothing(rubber, target, "mm-t-s");
        if (card.empty()) continue;
        CAPTURE(target, card);
        CHECK_FALSE(has_unread_parts(read_rubber_card(card, target, "").findings));
      }
    }
  }
}

TEST_CASE("rubber cards: what the solver would miss or the reader does not use is named", "[io]") {
  const Rubber neo = rubber_of(HyperelasticForm::kNeoHooke, {2.1e5}, {}, {});
  const Rubber yeoh = rubber_of(HyperelasticForm::kYeoh, {1.8e5, -1.4e3, 40.0}, {}, {{0.2, 0.1}});
  const auto findings = [](const std::string& text, const char* target) {
    std::string out;
    for (const CardFinding& finding : read_rubber_card(text, target, "mm-t-s").findings)
      out += finding.name + "|";
    return out;
  };
  const std::string abaqus = card_or_nothing(yeoh, "abaqus", "mm-t-s");
  CHECK(findings(changed(abaqus, "NAME=RUBBER", "NAME="), "abaqus") == "missing-name|");
  CHECK(findings(changed(abaqus, "*MATERIAL, NAME=RUBBER\n", ""), "abaqus") == "missing-material|");
  CHECK_THAT(findings(changed(abaqus, "*VISCOELASTIC, TIME=PRONY\n",
                              "*VISCOELASTIC, TIME=PRONY\n*VISCOELASTIC, TIME=PRONY\n"),
                      "abaqus"),
             Contains("doubled-keyword"));
  // Behind *VISCOELASTIC, too.
  CHECK_THAT(findings(abaqus + "*FAIL STRESS\n1., 2.\n", "abaqus"), Contains("not-read"));
  const Rubber ogden = rubber_of(HyperelasticForm::kOgden1, {3e5}, {1.3}, {{0.2, 0.1}});
  const std::string radioss = card_or_nothing(ogden, "openradioss", "mm-t-s");
  CHECK(findings(radioss, "openradioss") == "");
  CHECK(findings(changed(radioss, "/UNIT/1", "/UNIT/4"), "openradioss") == "unit-block|");
  CHECK_THAT(findings(radioss + "/DAMP/1\nd\n 0.1\n", "openradioss"), Contains("not-read"));
  const std::string moose = card_or_nothing(neo, "moose", "mm-t-s");
  CHECK(findings(moose, "moose") == "");
  CHECK(findings(changed(moose, "    type = ComputeLagrangianStrain\n", ""), "moose") ==
        "missing-type|");
  CHECK(findings(changed(moose, "    displacements = 'disp_x disp_y disp_z'\n", ""), "moose") ==
        "missing-displacements|");
  CHECK_THROWS_WITH(findings(changed(moose, "[Materials]\n", ""), "moose"), Contains("not open"));
  const std::string sfepy = card_or_nothing(yeoh, "sfepy", "mm-t-s");
  CHECK(findings(sfepy, "sfepy") == "");
  CHECK_THROWS_WITH(
      findings(changed(sfepy, "np.zeros((points, 3, 3))", "np.zeros((points, 3, 4))"), "sfepy"),
      Contains("is not that of viscard's card"));
  CHECK_THROWS_WITH(findings(sfepy + "foo = 3.0\n", "sfepy"), Contains("has no such line"));
}

TEST_CASE(
    "rubber cards: bulk modulus and density are compared with the file, the options or the "
    "header",
    "[io]") {
  const Rubber rubber =
      rubber_of(HyperelasticForm::kOgden2, {2e5, 1e4}, {1.3, -2.1}, {{0.1, 0.05}, {0.3, 7.0}});
  HyperelasticFile file = file_of(rubber);
  file.bulk_Pa = kBulk_Pa;
  file.density_kg_m3 = 1100.0;
  const auto checked = [](const std::string& card, const std::string& target,
                          const HyperelasticFile* of) {
    std::string out;
    for (const CardFinding& finding :
         check_rubber_card(card, of, {.target = target, .units = "mm-t-s"}).findings)
      out += finding.name + ": " + finding.text + "|";
    return out;
  };
  struct Edit {
    const char *target, *from, *to, *says;
  };
  // D = 2/K = 0.00666..., nu of K = 300 MPa and G = 0.21 or 0.126 MPa, the density in t/mm3.
  for (const Edit& edit :
       {Edit{"febio", "<k>300</k>", "<k>450</k>", "1.5 times"},
        Edit{"abaqus", "0.00666666666666", "0.01666666666666", "0.4 times"},
        Edit{"openradioss", "499650", "499450", "0.63"}, Edit{"lsdyna", ".49979", ".49959", "0.51"},
        Edit{"abaqus", "1.1e-09", "1.3e-09", "1.18182 times"},
        Edit{"lsdyna", "1.1E-9", "1.2E-9", "1.09091 times"}}) {
    CAPTURE(edit.target, edit.from);
    const std::string right = card_or_nothing(rubber, edit.target, "mm-t-s");
    CAPTURE(right);
    CHECK(checked(right, edit.target, &file) == "");
    const std::string wrong = changed(right, edit.from, edit.to);
    CHECK_THAT(checked(wrong, edit.target, &file),
               Contains("numbers-differ: ") && Contains(edit.says));
    // Without the file its header says what the numbers should be.
    const std::string header = "** viscard card: ogden-2 for " + std::string(edit.target) +
                               "\n** bulk modulus 3e+08 Pa\n** density 1100 kg/m3\n";
    const std::string comment = std::string(edit.target) == "lsdyna"        ? "$"
                                : std::string(edit.target) == "openradioss" ? "#"
                                                                            : "**";
    std::string commented = header;
    for (std::size_t at = 0; (at = commented.find("** ", at)) != std::string::npos; ++at)
      commented.replace(at, 2, comment);
    if (std::string(edit.target) == "febio")
      commented = "<!-- viscard card: ogden-2 for febio -->\n<!-- bulk modulus 3e+08 Pa -->\n";
    CHECK(checked(commented + right, edit.target, nullptr) == "");
    CHECK_THAT(checked(commented + wrong, edit.target, nullptr),
               Contains("header-differs: ") && Contains(edit.says));
  }
  // Softer in volume than rubber is: a note; below 2G/3: a mistake.
  const std::string abaqus = card_or_nothing(rubber, "abaqus", "mm-t-s");
  CHECK_THAT(checked(changed(abaqus, "0.00666666666666", "1.66666666666"), "abaqus", nullptr),
             Contains("soft-volume: ") && !Contains("negative"));
  CHECK_THAT(checked(changed(abaqus, "0.00666666666666", "100.66666666666"), "abaqus", nullptr),
             Contains("soft-volume: ") && Contains("negative"));
}

TEST_CASE("a card of rubber whose modulus no solid has names the units it may be in", "[cards]") {
  const std::string by_hand = "*MATERIAL, NAME=RUBBER\n*HYPERELASTIC, NEO HOOKE\n0.35, 0.001\n";
  const RubberCheck alone = check_rubber_card(by_hand, nullptr, {.target = "abaqus"});
  REQUIRE(!alone.findings.empty());
  CHECK(alone.findings.back().name == "implausible");
  CHECK_THAT(alone.findings.back().text, Contains("in mm-t-s the modulus is 2.1 MPa"));
  CHECK_FALSE(alone.agrees);
  CHECK(check_rubber_card(by_hand, nullptr, {.target = "abaqus", .units = "mm-t-s"}).agrees);
}
