#include "io/cards/card.h"
#include "io/cards/check_card.h"
#include "io/cards/targets/card_targets.h"
#include "tests/io/cards/card_materials.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <regex>

using namespace viscard;
using namespace viscard::test;

namespace {

std::string card_text(const char* target, const char* units = "mm-t-s") {
  Material material = reference_material();
  if (std::string(target) == "lsdyna006") material.terms.resize(1);
  return write_card(material, card_target(target), {.units = units, .is_reproducible = true}).text;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  INFO("looking for: " << from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

// Names of the mistakes found in a card meant to be `material`.
std::string mistakes(const std::string& text, const std::string& target,
                     const Material& material = reference_material(),
                     const std::string& units = "") {
  const CardCheck check = check_card(text, card_target(target), {.units = units}, &material);
  std::string names;
  for (const CardFinding& finding : check.findings) {
    if (finding.is_mistake) names += (names.empty() ? "" : " ") + finding.name;
  }
  CHECK(check.agrees == names.empty());
  return names;
}

}  // namespace

TEST_CASE("cards as written agree with their material and hold no mistake", "[cards]") {
  for (const CardTarget& target : card_targets()) {
    CAPTURE(target.name);
    Material material = reference_material();
    if (target.max_terms == 1) material.terms.resize(1);
    const std::string text = card_text(target.name.c_str());
    const CardCheck check = check_card(text, target, {}, &material);
    CHECK(check.agrees);
    CHECK(check.findings.empty());
    REQUIRE(check.E_difference);
    CHECK(*check.E_difference <= (target.name.rfind("lsdyna", 0) == 0 ? 2e-6 : 1e-9));
  }
}

TEST_CASE("mistakes planted in Abaqus cards are named", "[cards]") {
  const std::string card = card_text("abaqus");
  CHECK(mistakes(replaced(card, ", MODULI=INSTANTANEOUS", ""), "abaqus") ==
        "E0-without-instantaneous");
  CHECK(mistakes(replaced(card, "1.88, 0.495", "1.83851592, 0.495"), "abaqus") ==
        "long-term-modulus-as-instantaneous");
  CHECK(mistakes(replaced(card, "1.88, 0.495", "2.490147521, 0.495"), "abaqus") ==
        "plane-strain-modulus");
  std::string swapped = replaced(card, "0.008206, 0.008206, 0.1945", "0.008206, 0.008206, 2.403");
  swapped = replaced(swapped, "0.01386, 0.01386, 2.403", "0.01386, 0.01386, 0.1945");
  CHECK(mistakes(swapped, "abaqus") == "terms-swapped");
  std::string columns = replaced(card, "0.008206, 0.008206, 0.1945", "0.008206, 0.1945, 0.008206");
  columns = replaced(columns, "0.01386, 0.01386, 2.403", "0.01386, 2.403, 0.01386");
  CHECK(mistakes(columns, "abaqus") == "columns-swapped");
  std::string ms = replaced(card, ", 0.1945", ", 194.5");
  ms = replaced(ms, ", 2.403", ", 2403.");
  CHECK(mistakes(ms, "abaqus") == "time-in-ms");
  std::string beta = replaced(card, ", 0.1945", ", 5.141388175");
  beta = replaced(beta, ", 2.403", ", 0.4161464836");
  CHECK(mistakes(beta, "abaqus") == "beta-for-tau");
  std::string absolute = replaced(card, "0.008206, 0.008206", "0.00515962542, 0.00515962542");
  absolute = replaced(absolute, "0.01386, 0.01386", "0.00871464883, 0.00871464883");
  CHECK(mistakes(replaced(card, "\n9.65e-10", "\n965"), "abaqus") == "density-unit");
  CHECK(mistakes(card + "*STEP\n*STATIC\n1., 1.\n*END STEP\n", "abaqus") == "static-step");
  CHECK(mistakes(card_text("abaqus", "SI"), "abaqus", reference_material(), "mm-t-s") ==
        "other-unit-system");
  CHECK(mistakes(replaced(card, "0.008206, 0.008206", "0.99, 0.99"), "abaqus") == "no-solid");
}

TEST_CASE("mistakes planted in ANSYS cards are named", "[cards]") {
  const std::string card = card_text("ansys");
  CHECK(mistakes(replaced(card, "TB,PRONY,1,1,2,SHEAR", "TB,PRONY,1,1,3,SHEAR"), "ansys") ==
        "npts-mismatch");
  CHECK(mistakes(replaced(card, "TBDATA,3,0.01386", "TBDATA,1,0.01386"), "ansys")
            .find("tbdata-overwritten") == 0);
  CHECK(mistakes(replaced(card, "MP,EX,1,1.88", "MP,EX,1,1.83851592"), "ansys") ==
        "long-term-modulus-as-instantaneous");
  const std::string sheared =
      std::regex_replace(card, std::regex("(TBDATA,\\d,)(0.008206|0.01386)"), "$1$2");
  CHECK(mistakes(sheared, "ansys").empty());
  std::string shear_only = card.substr(0, card.find("TB,PRONY,1,1,2,BULK"));
  CHECK(mistakes(shear_only, "ansys") == "bulk-left-out");
}

TEST_CASE("mistakes planted in LS-DYNA cards are named", "[cards]") {
  const std::string card = card_text("lsdyna");
  CHECK(mistakes(replaced(card, " .61488827       0.0\n", ""), "lsdyna") ==
        "missing-equilibrium-row");
  CHECK(mistakes(replaced(card, "TRAMPK\n\n", "TRAMPK\n"), "lsdyna") == "missing-blank-card");
  std::string tau = replaced(card, " 5.1413882", "    0.1945");
  tau = replaced(tau, " .41614648", "     2.403");
  CHECK(mistakes(tau, "lsdyna") == "tau-for-beta");
  std::string g = replaced(card, ".005159625", "  0.008206");
  g = replaced(g, ".008714649", "   0.01386");
  CHECK(mistakes(g, "lsdyna") == "g-for-G");
  CHECK(mistakes(replaced(card, " .61488827", ".628762542"), "lsdyna") ==
        "instantaneous-as-equilibrium");
  CHECK(mistakes(replaced(card, " 62.666667", "      1.88"), "lsdyna") == "E-for-K");
  Material one = reference_material();
  one.terms.resize(1);
  const std::string six = card_text("lsdyna006");
  CHECK(mistakes(replaced(six, " .62360292", ".005159625"), "lsdyna006", one) ==
        "branch-modulus-as-GI");
}

TEST_CASE("mistakes planted in FEBio, CalculiX, MOOSE and COMSOL cards are named", "[cards]") {
  CHECK(mistakes(replaced(card_text("febio"), "<g0>0.977934</g0>", ""), "febio") == "g0-left-at-1");
  CHECK(mistakes(replaced(card_text("febio"), "<g0>0.977934</g0>", "<g0>1</g0>"), "febio") ==
        "g0-left-at-1");
  CHECK(mistakes(replaced(card_text("febio"), "<t1>0.1945</t1>", "<t1>194.5</t1>"), "febio") != "");
  // Also right: a long-term child, and branches relative to it.
  std::string relative = replaced(card_text("febio"), "<g0>0.977934</g0>", "");
  relative = replaced(relative, "<E>1.88</E>", "<E>1.83851592</E>");
  relative = replaced(relative, "<g1>0.008206</g1>", "<g1>0.00839115932486160335</g1>");
  relative = replaced(relative, "<g2>0.01386</g2>", "<g2>0.0141727356815572421</g2>");
  CHECK(mistakes(relative, "febio").empty());

  const std::string ccx = card_text("calculix");
  CHECK(mistakes(card_text("abaqus"), "calculix").find("calculix-ignores-prony") == 0);
  CHECK(mistakes(replaced(ccx, "332.15513131443174", "996.46539394329522"), "calculix") != "");
  std::string three = replaced(ccx, "332.15513131443174", "996.46539394329522");
  three = replaced(three, "15.917508236506652", "47.752524709519956");
  CHECK(mistakes(three, "calculix") == "A-without-3");
  CHECK(mistakes(replaced(ccx, "1.8385159199999999", "1.88"), "calculix") ==
        "instantaneous-as-equilibrium");

  const std::string moose = card_text("moose");
  CHECK(mistakes(replaced(moose, "0.015427279999999998 0.0260568", "0.008206 0.01386"), "moose") ==
        "g-for-E_i");
  CHECK(mistakes(replaced(moose, "0.015427279999999998 0.0260568", "0.00515962542 0.00871464883"),
                 "moose") == "G-for-E_i");
  CHECK(mistakes(moose.substr(0, moose.find("[UserObjects]")), "moose") == "missing-user-object");

  const std::string comsol = card_text("comsol");
  CHECK(mistakes(std::regex_replace(comsol, std::regex("1\\.83865\\d*\\[MPa\\]"), "1.88[MPa]"),
                 "comsol") != "");
}

TEST_CASE("an edited card of viscard disagrees with its own header", "[cards]") {
  const auto names = [](const std::string& text, const char* target) {
    std::string out;
    for (const CardFinding& finding : check_card(text, card_target(target), {}, nullptr).findings) {
      out += finding.name;
    }
    return out;
  };
  for (const CardTarget& target : card_targets()) {
    CAPTURE(target.name);
    if (target.name != "csv")
      CHECK(names(card_text(target.name.c_str()), target.name.c_str()).empty());
  }
  CHECK(names(replaced(card_text("abaqus"), ", MODULI=INSTANTANEOUS", ""), "abaqus") ==
        "E0-without-instantaneous");
  CHECK(names(replaced(card_text("moose"), "young_modulus = 1.88", "young_modulus = 2.49"),
              "moose") == "header-disagrees");
}

TEST_CASE("rounding to the columns of a card is no mistake in any unit system", "[cards]") {
  const double moduli_Pa[] = {1.8812345678e6, 4.7191234567e4, 3.3333333333e9, 9.8765432101e5};
  for (const CardTarget& target : card_targets()) {
    if (target.name == "csv" || target.name == "json") continue;
    for (const UnitSystem& units : unit_systems()) {
      for (const double E0_Pa : moduli_Pa) {
        CAPTURE(target.name, units.name, E0_Pa);
        Material material = reference_material();
        material.E0_Pa = E0_Pa;
        material.terms[0].tau_s = 0.19453219876;
        material.terms[1].g = 0.0138612345678;
        if (target.max_terms == 1) material.terms.resize(1);
        std::string text;
        try {
          text = write_card(material, target, {.units = units.name}).text;
        } catch (const std::invalid_argument&) {
          continue;  // refused as not fitting the columns
        }
        CHECK(mistakes(text, target.name, material).empty());
      }
    }
  }
}

TEST_CASE("a Poisson ratio above 0.5 is named with and without the material", "[cards]") {
  const Material material = reference_material();
  for (const char* target : {"abaqus", "calculix", "febio", "frontistr", "ansys"}) {
    CAPTURE(target);
    std::string card = card_text(target);
    for (std::size_t at = 0; (at = card.find("0.495", at)) != std::string::npos;)
      card.replace(at, 5, "0.645");
    const CardCheck with = check_card(card, card_target(target), {}, &material),
                    without = check_card(card, card_target(target), {}, nullptr);
    for (const CardCheck& check : {with, without}) {
      CHECK_FALSE(check.agrees);
      CHECK(std::any_of(check.findings.begin(), check.findings.end(), [](const auto& finding) {
        return finding.name == "poisson-ratio" && finding.text.find("nu is 0.645") == 0;
      }));
    }
  }
}

TEST_CASE("a card is compared in Poisson ratio, density and shift too, not in E(t) alone",
          "[cards]") {
  Material material = reference_material();
  const std::string abaqus = card_text("abaqus");
  CHECK(mistakes(replaced(abaqus, "1.88, 0.495", "1.88, 0.3"), "abaqus") == "poisson-ratio");
  CHECK(mistakes(replaced(abaqus, "\n9.65e-10", "\n1e-9"), "abaqus") == "density");
  CHECK(mistakes(replaced(card_text("febio"), "<v>0.495</v>", "<v>0.45</v>"), "febio") ==
        "poisson-ratio");
  const CardCheck without = check_card(replaced(abaqus, "*DENSITY\n9.65e-10,\n", ""),
                                       card_target("abaqus"), {}, &material);
  CHECK(without.agrees);
  REQUIRE(without.findings.size() == 1);
  CHECK(without.findings[0].name == "density-missing");

  material.T_ref_C = 23.0;
  material.shift = TemperatureShift{.T_ref_C = 23.0, .C1 = 8.86, .C2_K = 101.6};
  const std::string shifted =
      write_card(material, card_target("abaqus"), {.units = "mm-t-s", .is_reproducible = true})
          .text;
  const auto found = [&](const std::string& line) {
    return mistakes(replaced(shifted, "23, 8.86, 101.6", line), "abaqus", material);
  };
  CHECK(found("23, 8.86, 101.6").empty());
  CHECK(found("23, 17.44, 51.6") == "shift-differs");
  CHECK(found("296.15, 8.86, 101.6") == "reference-temperature-in-kelvin");
  CHECK(found("23, 20.4009039, 101.6") == "natural-logarithm-C1");
  CHECK(mistakes(abaqus, "abaqus", material) == "shift-missing");
}

TEST_CASE("times a thousand off, negative shares and a doubled c1 are named", "[cards]") {
  const Material material = reference_material();
  const std::string abaqus = card_text("abaqus");
  CHECK(mistakes(replaced(replaced(abaqus, "0.1945", "0.0001945"), "2.403", "0.002403"),
                 "abaqus") == "time-unit");
  CHECK(mistakes(replaced(abaqus, "0.008206, 0.008206", "-0.008206, 0.008206"), "abaqus") ==
        "negative-branch");
  const std::string comsol = card_text("comsol", "mm-t-s");
  CHECK(mistakes(std::regex_replace(comsol, std::regex("(tau\\d+\\s+\\S+)\\[s\\]"), "$1[ms]"),
                 "comsol") == "time-unit");
}

TEST_CASE("other ways to write the same card are read", "[cards]") {
  const Material material = reference_material();
  const auto agrees = [&](const std::string& text, const char* target) {
    const CardCheck check = check_card(text, card_target(target), {.units = "mm-t-s"}, &material);
    CAPTURE(target, text);
    CHECK(check.agrees);
  };
  agrees(replaced(card_text("abaqus"), "*ELASTIC, MODULI=INSTANTANEOUS",
                  "*ELASTIC,\n MODULI=INSTANTANEOUS"),
         "abaqus");
  agrees(
      "MP,EX,1,1.88 $ MP,PRXY,1,.495 $ MP,DENS,1,9.65E-10\n"
      "TB,PRON,1,1,2,SHEAR\nTBDATA,1,.008206,.1945,.01386,2.403\n"
      "TB,PRON,1,1,2,BULK\nTBDATA,1,.008206,.1945,.01386,2.403\n",
      "ansys");
  agrees(std::regex_replace(card_text("moose"), std::regex("'"), "\""), "moose");
  agrees(replaced(card_text("febio"), "<material ",
                  "<material id=\"9\" name=\"steel\" type=\"isotropic elastic\"><density>7.8e-9"
                  "</density><E>2e5</E><v>0.3</v></material>\n<material "),
         "febio");
}

TEST_CASE("numbers typed with fewer digits are reported as rounded, not as a mistake", "[cards]") {
  Material material = reference_material();
  material.E0_Pa = 1.88031234e6;
  const std::string right =
      write_card(material, card_target("abaqus"), {.units = "mm-t-s", .is_reproducible = true})
          .text;
  const std::size_t young = right.find("INSTANTANEOUS\n") + 14;
  const std::string text =
      std::string(right).replace(young, right.find(',', young) - young, "1.8803");
  const CardCheck check = check_card(text, card_target("abaqus"), {}, &material);
  CHECK_FALSE(check.agrees);
  REQUIRE(check.findings.size() == 1);
  CHECK(check.findings[0].name == "rounded");
  CHECK_FALSE(check.findings[0].is_mistake);
  CHECK(check_card(text, card_target("abaqus"), {.tolerance = 1e-3}, &material).agrees);
}

TEST_CASE("one digit of a number is named with both values, not as terms that were swapped",
          "[cards]") {
  for (const std::size_t n : {std::size_t{1}, std::size_t{2}}) {
    Material material = reference_material();
    material.terms.erase(material.terms.begin(),
                         material.terms.end() - static_cast<std::ptrdiff_t>(n));
    const std::string text =
        replaced(write_card(material, card_target("abaqus"), {.units = "mm-t-s"}).text, ", 2.403\n",
                 ", 2.404\n");
    const CardCheck check = check_card(text, card_target("abaqus"), {}, &material);
    CAPTURE(n);
    CHECK_FALSE(check.agrees);
    REQUIRE(check.findings.size() == 1);
    CHECK(check.findings[0].name == "one-number");
    CHECK(check.findings[0].text.find("is 2.404 where 2.403 is expected") != std::string::npos);
  }
}

TEST_CASE("a card whose numbers no solid has is a mistake that names the units it may be in",
          "[cards]") {
  const std::string by_hand =
      "*MATERIAL, NAME=PDMS\n*DENSITY\n9.65e-10,\n*ELASTIC\n2.2, 0.495\n";  // mm, t, s
  const CardTarget& target = card_target("abaqus");
  const CardCheck alone = check_card(by_hand, target, {}, nullptr);
  REQUIRE(alone.findings.size() == 2);  // the other: the units are not stated
  CHECK(alone.findings[1].name == "implausible");
  CHECK(alone.findings[1].text.find("the modulus of the card is 2.2 Pa") != std::string::npos);
  CHECK(alone.findings[1].text.find("in mm-t-s the modulus is 2.2 MPa and the density 965 kg/m3") !=
        std::string::npos);
  CHECK_FALSE(alone.agrees);
  CHECK(check_card(by_hand, target, {.units = "mm-t-s"}, nullptr).agrees);
  CHECK(check_card(by_hand, target, {.plausible = Plausible::kOff}, nullptr).agrees);
  // The modulus alone is plausible in both, the density in one.
  const CardCheck dense = check_card(replaced(by_hand, "2.2,", "2.2e6,"), target, {}, nullptr);
  CHECK_FALSE(dense.agrees);
  CHECK(dense.findings.back().text.find("the density of the card is") != std::string::npos);
  // Cards as written are plausible in all units.
  for (const CardTarget& one : card_targets()) {
    if (one.table_difference != nullptr) continue;
    CAPTURE(one.name);
    CHECK(check_card(card_text(one.name.c_str()), one, {}, nullptr).agrees);
  }
}
