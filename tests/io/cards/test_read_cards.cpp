#include "io/cards/check_card.h"
#include "io/cards/targets/card_targets.h"
#include "tests/io/cards/card_materials.h"

#include <catch2/catch.hpp>

using namespace viscard;
using namespace viscard::test;

TEST_CASE("hand-written cards in each dialect are read", "[cards]") {
  const Material material = reference_material();
  const auto check = [&](const std::string& text, const char* target) {
    const CardCheck found =
        check_card(text, card_target(target), {.units = "mm-t-s", .tolerance = 2e-6}, &material);
    CAPTURE(target, found.findings.size());
    CHECK(found.agrees);
  };
  check(
      "** typed by hand\n*Material, name=rubber\n*Density\n 9.65E-10,\n*Elastic, "
      "moduli=instantaneous\n"
      "1.88, .495\n*Viscoelastic, time=Prony\n.008206, .008206, .1945\n 1.386D-2,1.386D-2, 2.403\n",
      "abaqus");
  check(
      "*MATERIAL,NAME=R\n*ELASTIC\n1.83851592,0.495\n*VISCOELASTIC, TIME = PRONY\n"
      "8.206e-3,8.206e-3,.1945\n.01386,.01386,2.403\n",
      "abaqus");
  check(
      "MP,EX,1,1.88 ! MPa\nMP,NUXY,1,.495\nTB,PRON,1,1,2,SHEA\nTBDATA,1,.008206,.1945,.01386\n"
      "TBDATA,4,2.403\nTB,PRON,1,1,2,BULK\nTBDATA,1,.008206,.1945,.01386,2.403\n",
      "ansys");
  check(
      "*KEYWORD\n*MAT_076\n         1  9.65E-10 62.666667\n\n.614888268       0.0\n"
      ".005159625 5.1413882\n.008714649 .41614648\n*END\n",
      "lsdyna");
  check(
      "*MAT_GENERAL_VISCOELASTIC\n1, 9.65E-10, 62.6666667\n0,0\n.614888268,0.0\n"
      ".00515962542,5.14138817\n.00871464883,.41614648\n",
      "lsdyna");
  check(
      "!! by hand\n!MATERIAL, NAME=R, ITEM=1\n!ELASTIC\n1.88,.495\n"
      "!VISCOELASTIC, INFINITESIMAL\n.008206,.1945\n.01386,2.403\n",
      "frontistr");
}

TEST_CASE("what cannot be read names the line and what was expected", "[cards]") {
  const auto fails = [](const std::string& text, const char* target, const char* part) {
    CAPTURE(target);
    CHECK_THROWS_WITH(check_card(text, card_target(target), {}, nullptr), Catch::Contains(part));
  };
  fails("*MATERIAL, NAME=A\n*ELASTIC\n1.88, abc\n", "abaqus", "line 3: 'abc' is not a number (nu");
  fails("*MATERIAL, NAME=A\n*ELASTIC\n", "abaqus", "no data line");
  fails("", "abaqus", "no *ELASTIC");
  fails("", "ansys", "no MP,EX");
  fails("", "lsdyna", "*MAT_GENERAL_VISCOELASTIC");
  fails("<material type=\"neo-Hookean\"/>", "febio", "neo-Hookean");
  fails("", "febio", "no <material");
  fails("", "mfront", "no E0");
  fails("", "moose", "no youngs_modulus");
  fails("", "comsol", "Einf");
  fails("", "frontistr", "no !ELASTIC");
  fails("", "openradioss", "LAW40");
  fails("{", "json", "not a JSON card");
  fails("{}", "json", "viscard-card/1");
  fails("a,b\n", "csv", "name a material file");
  fails("x", "abacus", "did you mean 'abaqus'? There are: abaqus, ansys");
  // Long matches would overflow the stack of std::regex.
  const std::string many(100000, '1');
  fails("\n@Parameter real E0 = " + many + ";", "mfront", "line 2: has 100022 characters");
  fails("creep_modulus = '" + many + "'", "moose", "line 1: has");
  fails("PDMS_Einf " + many, "comsol", "line 1: has");
  fails("<material type=\"viscoelastic\"><g0>" + many, "febio", "line 1: has");
}
