// Cards of rubber with damage by its first loading (models/hyperelastic/mullins_damage.h).
#include "io/cards/hyperelastic/check_rubber.h"
#include "io/cards/hyperelastic/rubber_card.h"
#include "io/cards/hyperelastic/rubber_file_card.h"
#include "io/materials/hyperelastic_file.h"
#include "tests/io/cards/rubber_findings.h"

#include <catch2/catch.hpp>

using namespace viscard;
using Catch::Matchers::Contains;
using viscard::test::rubber_findings;
using viscard::test::with_last;

namespace {

HyperelasticFile damaged_file(HyperelasticForm form, std::initializer_list<double> moduli_Pa,
                              std::initializer_list<double> shapes = {}) {
  HyperelasticFile file;
  const auto vector_from = [](std::initializer_list<double> values) {
    Eigen::VectorXd out(static_cast<Eigen::Index>(values.size()));
    Eigen::Index i = 0;
    for (const double value : values) out[i++] = value;
    return out;
  };
  file.law = {form, vector_from(moduli_Pa), vector_from(shapes)};
  file.E0_Pa = file.E_inf_Pa = youngs_modulus_Pa(file.law);
  file.damage = MullinsDamage{1.6, 0.15e6, 0.1};
  file.density_kg_m3 = 1100.0;
  return file;
}

HyperelasticFile yeoh_file() {
  return damaged_file(HyperelasticForm::kYeoh, {0.3e6, -0.01e6, 0.001e6});
}
HyperelasticFile boyce_file() {
  return damaged_file(HyperelasticForm::kArrudaBoyce, {0.4e6}, {3.0});
}

HyperelasticFile ogden_file() {
  return damaged_file(HyperelasticForm::kOgden1, {0.4e6}, {3.0});
}

RubberCardOptions options_for(const std::string& target, const std::string& units = "mm-t-s") {
  RubberCardOptions options{.target = target, .units = units};
  options.bulk_Pa = 1e9;
  options.density_kg_m3 = 1100.0;
  return options;
}

std::string card_for(const HyperelasticFile& file, const std::string& target,
                     const std::string& units = "mm-t-s") {
  return rubber_file_card(file, "rubber.json", options_for(target, units));
}

}  // namespace

TEST_CASE("mullins cards: abaqus takes r, m, beta below the law", "[cards][mullins]") {
  const HyperelasticFile file = yeoh_file();
  const std::string card = rubber_card(file.law, {}, options_for("abaqus"), file.damage);
  CHECK(
      card ==
      "*MATERIAL, NAME=RUBBER\n*DENSITY\n1.1e-09,\n*HYPERELASTIC, YEOH\n0.3, -0.01, 0.001, 0.002, "
      "0, 0\n*MULLINS EFFECT\n1.6, 0.15, 0.1\n");
  // m is a stress: in um-kg-s one of 1e-6 m kg/(m s2) ... the exponent of the unit system.
  CHECK_THAT(rubber_card(file.law, {}, options_for("abaqus", "SI"), file.damage),
             Contains("*MULLINS EFFECT\n1.6, 150000, 0.1\n"));
  CHECK_THAT(
      card_for(file, "abaqus"),
      Contains("yeoh+mullins-or for abaqus") &&
          Contains("eta = 1 - erf((W_m - W)/(m + beta W_m))/r. *MULLINS EFFECT: r, m, beta"));
  // Without damage the card is what it was.
  CHECK(rubber_card(file.law, {}, options_for("abaqus")) ==
        rubber_card(file.law, {}, options_for("abaqus"), std::nullopt));
}

TEST_CASE("mullins cards: openradioss takes R, beta, m beside LAW92 and LAW100",
          "[cards][mullins]") {
  const HyperelasticFile file = boyce_file();
  const std::string card = rubber_card(file.law, {}, options_for("openradioss"), file.damage);
  CHECK_THAT(card, Contains("/MAT/LAW92/1/1\n") &&
                       Contains("/FAIL/MULLINS_OR/1/1\n#                  R                BETA"
                                "                   m\n                 1.6                  .1"
                                "                 .15\n"));
  const HyperelasticFile yeoh = yeoh_file();
  CHECK_THAT(rubber_card(yeoh.law, {}, options_for("openradioss"), yeoh.damage),
             Contains("/MAT/LAW100/1/1\nRUBBER\n") &&
                 Contains("#    N_net   Flag_HE   Flag_Cr\n         0         5         0\n") &&
                 Contains("                  .3                -.01                .001"
                          "                .002\n") &&
                 Contains("/FAIL/MULLINS_OR/1/1\n"));
  CHECK_THAT(card_for(yeoh, "openradioss"), Contains("LAW100 without networks"));
  CHECK_THROWS_WITH(card_for(ogden_file(), "openradioss"),
                    Contains("openradioss cannot take the damage mullins-or beside ogden-1") &&
                        Contains("LAW92, 95 and 100 only") && Contains("arruda-boyce+mullins-or"));
}

TEST_CASE("mullins cards: other targets refuse by name, with the way on", "[cards][mullins]") {
  for (const std::string& target : rubber_card_targets()) {
    if (target == "abaqus" || target == "openradioss") continue;
    CAPTURE(target);
    const HyperelasticFile file = damaged_file(HyperelasticForm::kNeoHooke, {0.3e6});
    CHECK_THROWS_WITH(card_for(file, target),
                      Contains(target + " cannot take the damage mullins-or beside neo-hooke: ") &&
                          Contains("Write the card for abaqus") &&
                          Contains("viscard fit --model neo-hooke --cycle N"));
  }
}

TEST_CASE("mullins cards: what was written is read back, in every unit system",
          "[cards][mullins][identity]") {
  for (const char* units : {"SI", "mm-t-s", "mm-kg-ms", "mm-g-ms", "um-kg-s", "cgs"}) {
    for (const auto& [file, target] :
         {std::pair{yeoh_file(), "abaqus"}, std::pair{boyce_file(), "abaqus"},
          std::pair{boyce_file(), "openradioss"}, std::pair{yeoh_file(), "openradioss"},
          std::pair{damaged_file(HyperelasticForm::kNeoHooke, {0.3e6}), "openradioss"},
          std::pair{damaged_file(HyperelasticForm::kMooneyRivlin, {0.2e6, 0.05e6}), "openradioss"},
          std::pair{ogden_file(), "abaqus"}}) {
      CAPTURE(units, target);
      const std::string card = card_for(file, target, units);
      const RubberCheck check = check_rubber_card(card, &file, {.target = target});
      CHECK(check.agrees);
      CHECK(check.findings.empty());
      REQUIRE(check.read.damage);
      CHECK(check.read.damage->m_Pa == Approx(0.15e6).epsilon(1e-9));
      CHECK(check_rubber_card(card, nullptr, {.target = target}).findings.empty());
    }
  }
}

TEST_CASE("mullins cards: edited constants are named", "[cards][mullins]") {
  const HyperelasticFile file = yeoh_file(), boyce = boyce_file();
  const std::string right = card_for(file, "abaqus"), radioss = card_for(boyce, "openradioss");
  CHECK_THAT(rubber_findings(with_last(right, "1.6, 0.15", "1.7, 0.15"), "abaqus", &file),
             Contains("numbers-differ: r is 1.7, 1.0625 times the expected 1.6"));
  CHECK_THAT(rubber_findings(with_last(right, "0.15, 0.1", "0.16, 0.1"), "abaqus", &file),
             Contains("m_Pa is 160000"));
  CHECK_THAT(rubber_findings(with_last(right, "0.15, 0.1\n", "0.15, 0.2\n"), "abaqus", &file),
             Contains("beta is 0.2"));
  CHECK_THAT(rubber_findings(with_last(right, "0.15, 0.1\n", "0.1, 0.15\n"), "abaqus", &file),
             Contains("damage-order-exchanged: "));
  CHECK_THAT(rubber_findings(with_last(right, "1.6, 0.15", "1.6, 150000"), "abaqus", &file),
             Contains("damage-unit: m of the damage is in the unit of SI"));
  CHECK_THAT(rubber_findings(with_last(right, "1.6, 0.15", "0.625, 0.15"), "abaqus", &file),
             Contains("damage-out-of-range: r of mullins-or is 0.625") && Contains("one-over-r: "));
  CHECK_THAT(
      rubber_findings(with_last(right, "*MULLINS EFFECT\n1.6, 0.15, 0.1\n", ""), "abaqus", &file),
      Contains("other-damage: the card lacks the damage"));
  CHECK_THAT(rubber_findings(with_last(right, "0.15, 0.1\n", "0.15, 0.1, 23\n"), "abaqus", &file),
             Contains("other-count: "));
  // OpenRadioss: R, beta, m.
  CHECK_THAT(rubber_findings(with_last(radioss, "                 .15", "                 .19"),
                             "openradioss", &boyce),
             Contains("m_Pa is 190000"));
  CHECK_THAT(rubber_findings(with_last(radioss, "                  .1                 .15",
                                       "                 .15                  .1"),
                             "openradioss", &boyce),
             Contains("damage-order-exchanged: "));
  CHECK_THAT(rubber_findings(with_last(radioss, "/FAIL/MULLINS_OR/1/1", "/FAIL/MULLINS_OR/1"),
                             "openradioss", &boyce),
             Contains("unit-block: "));
  CHECK_THAT(rubber_findings(with_last(radioss, "/FAIL/MULLINS_OR/1/1", "/FAIL/MULLINS_OR/2/1"),
                             "openradioss", &boyce),
             Contains("other-damage: "));
  // Without the file the header has the constants.
  CHECK_THAT(rubber_findings(with_last(right, "1.6, 0.15", "1.7, 0.15"), "abaqus", nullptr),
             Contains("header-differs: the damage r is 1.7"));
  CHECK_THAT(rubber_findings(with_last(right, "0.15, 0.1\n", "0.15, 0.3\n"), "abaqus", nullptr),
             Contains("the damage beta is 0.3"));
}

TEST_CASE("mullins cards: cards by hand", "[cards][mullins]") {
  const std::string law = "*MATERIAL, NAME=R\n*HYPERELASTIC, NEO HOOKE\n0.3, 0.002\n";
  const HyperelasticFile file = damaged_file(HyperelasticForm::kNeoHooke, {0.3e6});
  const ReadRubber read =
      read_rubber_card(law + "*Mullins Effect\n1.6, .15, .1\n", "abaqus", "mm-t-s");
  REQUIRE(read.damage);
  CHECK(read.damage->r == 1.6);
  CHECK(read.findings.empty());
  CHECK_THAT(rubber_findings(law + "*MULLINS EFFECT, TEST DATA INPUT, R=1.5\n*UNIAXIAL TEST DATA\n",
                             "abaqus", &file),
             Contains("other-law: line 4: *MULLINS EFFECT is given by test data"));
  CHECK_THAT(rubber_findings(law + "*MULLINS EFFECT\n1.6, .15, .1\n", "calculix", nullptr),
             Contains("ignored-damage: line 4: ccx skips"));
  CHECK_THAT(
      rubber_findings(law + "*MULLINS EFFECT\n1.6, .15, .1\n*VISCOELASTIC, TIME=PRONY\n0.2, 0, 1\n",
                      "abaqus", nullptr),
      Contains("damage-beside-terms: "));
  // The general polynomial of LAW100, and networks that are not read.
  const std::string law100 =
      "/MAT/LAW100/1\nR\n             1.1E-9\n         0         1         0\n"
      "                  .3                 .05                 0.0                 0.0"
      "                 0.0\n                 0.0                 0.0                 0.0"
      "                 0.0\n                .002                 0.0                 0.0\n"
      "/FAIL/MULLINS_OR/1\n                 1.6                  .1                 .15\n";
  const ReadRubber mooney = read_rubber_card(law100, "openradioss", "mm-t-s");
  CHECK(mooney.law.form == HyperelasticForm::kMooneyRivlin);
  CHECK(mooney.bulk_Pa == Approx(1e9));
  REQUIRE(mooney.damage);
  CHECK(mooney.damage->m_Pa == Approx(0.15e6));
  CHECK_THAT(rubber_findings(with_last(law100, "         0         1", "         1         1"),
                             "openradioss", nullptr),
             Contains("other-law: line 4: networks"));
  // Beside LAW82 the starter knows no such damage.
  HyperelasticFile plain = file;
  plain.damage.reset();
  const std::string law82 = rubber_card(plain.law, {}, options_for("openradioss"));
  CHECK_THAT(
      rubber_findings(law82 + "/FAIL/MULLINS_OR/1/1\n                 1.6                 0.1"
                              "                 .15\n",
                      "openradioss", &file),
      Contains("ignored-damage: "));
}

TEST_CASE("mullins cards: a file of a law keeps its damage", "[io][mullins]") {
  const HyperelasticFile file = yeoh_file();
  const std::string json = json_from_card_of_rubber(file);
  const HyperelasticFile read = hyperelastic_from_json(json, "rubber.json");
  REQUIRE(read.damage);
  CHECK(read.damage->r == file.damage->r);
  CHECK(read.damage->m_Pa == file.damage->m_Pa);
  CHECK(read.damage->beta == file.damage->beta);
  CHECK_THROWS_WITH(
      hyperelastic_from_json(with_last(json, "mullins-or", "mullins-xy"), "rubber.json"),
      Contains("there is no damage \"mullins-xy\""));
  CHECK_THROWS_WITH(hyperelastic_from_json(with_last(json, "1.6", "0.9"), "rubber.json"),
                    Contains("r of mullins-or is 0.9"));
}
