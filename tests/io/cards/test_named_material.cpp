// Files of other programs with several materials: one is chosen by its name or number.
#include "io/cards/check_card.h"
#include "io/cards/hyperelastic/read_rubber.h"
#include "io/cards/named_material.h"
#include "io/cards/targets/card_targets.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace viscard;
using Catch::Matchers::Contains;

namespace {

double young_of(const std::string& text, const char* target, const std::string& name) {
  CAPTURE(target, name);
  const CardCheck check = check_card(material_named(text, target, name), card_target(target),
                                     {.plausible = Plausible::kOff}, nullptr);
  for (const CardFinding& finding : check.findings) CHECK(finding.name == "units-not-stated");
  return std::round(1e6 * check.read.material.E0_Pa) * 1e-6;  // E of G and K
}

}  // namespace

TEST_CASE("of several materials in a file one is chosen by name or number", "[cards]") {
  using Names = std::vector<std::string>;
  const std::string abaqus =
      "*MATERIAL, NAME=steel\n*ELASTIC\n200., 0.3\n*MATERIAL, NAME=Gel\n*ELASTIC\n2., 0.4\n"
      "*STEP\n*STATIC, LONG TERM\n";
  CHECK(material_names(abaqus, "abaqus") == Names{"steel", "Gel"});
  CHECK(young_of(abaqus, "abaqus", "steel") == 200.0);
  CHECK(young_of(abaqus, "abaqus", "Gel") == 2.0);
  CHECK_THROWS_WITH(material_named(abaqus, "abaqus", "gum"),
                    Contains("no material 'gum'; the file has steel, Gel"));
  const std::string ansys =
      "MP,EX,1,200\nMP,PRXY,1,0.3\nMPDATA,R5.0, 1,EX  , 2, 1, 2.0,\nMPDATA,R5.0, 1,PRXY, 2, 1, "
      "0.4,\n"
      "TB,PRONY,2,1,1,SHEAR\nTBDATA,1,0.1,3\n";
  CHECK(material_names(ansys, "ansys") == Names{"1", "2"});
  CHECK(young_of(ansys, "ansys", "1") == 200.0);
  CHECK(young_of(ansys, "ansys", "2") == 2.0);
  const std::string febio =
      "<Material>\n<material id=\"1\" name=\"foot\" type=\"viscoelastic\">\n<g0>1</g0>\n"
      "<elastic type=\"isotropic elastic\"><E>200</E><v>0.3</v></elastic>\n</material>\n"
      "<material id=\"2\" name=\"gel\" type=\"viscoelastic\">\n<g0>1</g0>\n"
      "<elastic type=\"isotropic "
      "elastic\"><E>2</E><v>0.4</v></elastic>\n</material>\n</Material>\n";
  CHECK(material_names(febio, "febio") == Names{"foot", "gel"});
  CHECK(young_of(febio, "febio", "2") == 2.0);
  CHECK(young_of(febio, "febio", "foot") == 200.0);
  const std::string comsol = "foot_Einf 200[Pa]\nfoot_nu 0.3\ngel_Einf 2[Pa]\ngel_nu 0.4\n";
  CHECK(material_names(comsol, "comsol") == Names{"foot", "gel"});
  CHECK(young_of(comsol, "comsol", "gel") == Approx(2.0));
  const std::string frontistr =
      "!MATERIAL, NAME=A\n!ELASTIC, INFINITESIMAL\n200., 0.3\n!MATERIAL, NAME=B\n"
      "!ELASTIC, INFINITESIMAL\n2., 0.4\n!STEP\n";
  CHECK(young_of(frontistr, "frontistr", "B") == 2.0);
  CHECK_THROWS_WITH(material_named("", "moose", "a"), Contains("not distinguished"));
}

TEST_CASE("materials of LS-DYNA and OpenRadioss are chosen with what else bears their number",
          "[cards]") {
  const std::string dyna =
      "*KEYWORD\n*MAT_HYPERELASTIC_RUBBER_TITLE\nfoot\n         1    1.1E-9      .499\n"
      "       .15       .02\n*MAT_HYPERELASTIC_RUBBER_TITLE\ngel\n         2    1.1E-9      .499\n"
      "       .30       .04\n*MAT_ADD_EROSION\n         2\n*END\n";
  const auto both = read_rubber_card(dyna, "lsdyna", "").findings;
  REQUIRE_FALSE(both.empty());
  CHECK(both[0].name == "several-materials");
  CHECK_THAT(both[0].text, Contains("the file has the materials foot, gel"));
  // ANSYS: the density of another material is not that of the rubber.
  const auto other = read_rubber_card(
      "TB,HYPER,1,1,2,MOONEY $ TBDATA,1,0.15,0.02,0.001\nMP,DENS,2,1e-9\n", "ansys", "");
  CHECK(other.law.moduli_Pa[1] == 0.02);
  CHECK_THAT(other.findings.at(0).text, Contains("the materials 1, 2"));
  const ReadRubber foot = read_rubber_card(material_named(dyna, "lsdyna", "foot"), "lsdyna", ""),
                   gel = read_rubber_card(material_named(dyna, "lsdyna", "2"), "lsdyna", "");
  CHECK(foot.law.moduli_Pa[0] == 0.15);
  CHECK(foot.findings.empty());
  CHECK(gel.law.moduli_Pa[0] == 0.3);
  REQUIRE(gel.findings.size() == 1);
  CHECK_THAT(gel.findings[0].text, Contains("*MAT_ADD_EROSION"));
  const std::string radioss =
      "/MAT/LAW82/1\nfoot\n               1E-09\n         1                             0\n"
      "                 0.2\n                   2\n                0.01\n/MAT/LAW82/2\ngel\n"
      "               1E-09\n         1                             0\n                 0.4\n"
      "                   2\n                0.01\n/VISC/PRONY/2\n         1\n";
  CHECK(read_rubber_card(material_named(radioss, "openradioss", "foot"), "openradioss", "")
            .findings.empty());
  const ReadRubber second =
      read_rubber_card(material_named(radioss, "openradioss", "gel"), "openradioss", "");
  CHECK(second.law.moduli_Pa[0] == 0.4);
  CHECK(has_unread_parts(second.findings));  // /VISC/PRONY/2
}
