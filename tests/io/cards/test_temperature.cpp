#include "io/cards/card.h"
#include "io/cards/check_card.h"
#include "io/cards/deck.h"
#include "io/cards/read_card.h"
#include "io/cards/targets/card_targets.h"
#include "tests/io/cards/card_materials.h"

#include <catch2/catch.hpp>

using namespace viscard;
using namespace viscard::test;
using Catch::Contains;

namespace {

Material shifted_material(ShiftLaw law) {
  Material material = reference_material();
  material.T_ref_C = 23.0;
  material.shift = TemperatureShift{
      .law = law, .T_ref_C = 23.0, .C1 = 8.86, .C2_K = 101.6, .activation_J_mol = 5.2e4};
  return material;
}

std::string temperature_mapping(const Card& card) {
  for (const FidelityItem& item : card.fidelity) {
    if (item.item == "temperature") return to_word(item.mapping);
  }
  return "";
}

}  // namespace

TEST_CASE("every card that has a place for a WLF shift contains it, and it reads back", "[cards]") {
  for (const CardTarget& target : card_targets()) {
    if (target.max_terms == 1 || target.name == "csv") continue;
    CAPTURE(target.name);
    const Material material = shifted_material(ShiftLaw::kWlf);
    if (!target.takes_wlf) {
      CHECK_THROWS_WITH(write_card(material, target),
                        Contains("WLF shift (C1 = 8.86") && Contains("--at-temperature"));
    }
    const Card card = write_card(material, target, {.may_approximate = true});
    // Where the solver would assume 0 degrees, one of the first lines says what to set.
    const std::size_t found = card.text.find("SET THE TEMPERATURE of the model: ");
    CHECK((found != std::string::npos) == (target.takes_wlf && !target.set_temperature.empty()));
    if (found != std::string::npos) CHECK(found < card.text.find("units: "));
    CHECK(temperature_mapping(card) == (target.takes_wlf ? "exact" : "approximated"));
    const ReadCard read = read_card(card.text, target, "");
    REQUIRE(read.material.shift.has_value() == target.takes_wlf);
    if (!target.takes_wlf) continue;
    CHECK(read.material.shift->C1 == 8.86);
    CHECK(read.material.shift->C2_K == 101.6);
    CHECK(read.material.shift->T_ref_C == 23.0);
  }
}

TEST_CASE("the WLF lines are those of the manuals", "[cards]") {
  const auto text_of = [](const char* target) {
    return write_card(shifted_material(ShiftLaw::kWlf), card_target(target)).text;
  };
  CHECK_THAT(text_of("abaqus"), Contains("\n*TRS, DEFINITION=WLF\n23, 8.86, 101.6\n"));
  CHECK_THAT(text_of("ansys"), Contains("\nTB,SHIFT,1,1,3,WLF\nTBDATA,1,23,8.86,101.6\n"));
  CHECK_THAT(text_of("frontistr"), Contains("\n!TRS, DEFINITION=WLF\n 23, 8.86, 101.6\n"));
  CHECK_THAT(text_of("comsol"), Contains("PDMS_C2 101.6[K]"));
}

TEST_CASE("an Arrhenius shift is written where the solver has one and refused elsewhere",
          "[cards]") {
  const Material material = shifted_material(ShiftLaw::kArrhenius);
  for (const CardTarget& target : card_targets()) {
    if (target.max_terms == 1 || target.name == "csv") continue;
    CAPTURE(target.name);
    if (!target.takes_arrhenius) {
      CHECK_THROWS_WITH(write_card(material, target),
                        Contains("Arrhenius shift (52000 J/mol") && Contains("--at-temperature"));
      const Card card = write_card(material, target, {.may_approximate = true});
      CHECK(temperature_mapping(card) == "approximated");
      CHECK_THAT(card.text, Contains("the card holds at 23 C only"));
      continue;
    }
    const Card card = write_card(material, target);
    CHECK(temperature_mapping(card) == "exact");
    const ReadCard read = read_card(card.text, target, "");
    REQUIRE(read.material.shift);
    CHECK(read.material.shift->law == ShiftLaw::kArrhenius);
    // Ten columns of LS-DYNA keep seven digits.
    CHECK(read.material.shift->activation_J_mol == Approx(5.2e4).epsilon(1e-7));
    CHECK(read.material.shift->T_ref_C == Approx(23.0).epsilon(1e-6));
    const CardCheck check = check_card(card.text, target, {}, &material);
    CHECK(check.agrees);
    Material other = material;
    other.shift->activation_J_mol = 6e4;
    CHECK_FALSE(check_card(card.text, target, {}, &other).agrees);
  }
}

TEST_CASE("the Arrhenius lines are those of the manuals", "[cards]") {
  const auto text_of = [](const char* target) {
    return write_card(shifted_material(ShiftLaw::kArrhenius), card_target(target)).text;
  };
  CHECK_THAT(text_of("abaqus"), Contains("\n*TRS, DEFINITION=ARRHENIUS\n23, 52000\n** The model "
                                         "needs: *PHYSICAL CONSTANTS, ABSOLUTE ZERO=-273.15, "
                                         "UNIVERSAL GAS CONSTANT=8.314462618\n"));
  // E_a/R = 52000/8.314462618 = 6254.162 K, absolute zero in C
  CHECK_THAT(text_of("frontistr"),
             Contains("\n!TRS, DEFINITION=ARRHENIUS\n 23, 6254.1624") && Contains(", -273.15\n"));
  CHECK_THAT(text_of("comsol"), Contains("PDMS_Q 52000[J/mol]"));
  CHECK_THAT(text_of("lsdyna"), Contains("    296.15") && Contains("6254.16"));  // K
  // Both lines that speak of its temperatures count in K.
  CHECK_THAT(text_of("lsdyna"), Contains("temperatures in the card in K") && Contains(", in K (0"));
  CHECK_THAT(text_of("lsdyna"), Contains("time is multiplied by\n$ exp(-A (1/T - 1/TREF))"));
  CHECK_THAT(text_of("abaqus"), Contains("temperatures in the card in C"));
}

TEST_CASE("LS-DYNA takes no WLF shift, because its manual leaves the sign open", "[cards]") {
  CHECK_THROWS_WITH(write_card(shifted_material(ShiftLaw::kWlf), card_target("lsdyna")),
                    Contains("opposite sign"));
}

TEST_CASE("card --check mentions a shift that a card cannot hold", "[cards]") {
  const Material material = shifted_material(ShiftLaw::kWlf);
  const CardTarget& target = card_target("febio");
  const Card card = write_card(material, target, {.may_approximate = true});
  const CardCheck check = check_card(card.text, target, {}, &material);
  CHECK(check.agrees);
  REQUIRE_FALSE(check.findings.empty());
  CHECK(check.findings.front().name == "shift-not-held");
  CHECK_THAT(check.findings.front().text, Contains("holds at 23 C only"));
}

TEST_CASE("one-element models with a shift start at its reference temperature", "[cards]") {
  const auto deck_text = [](const char* target, ShiftLaw law) {
    const Card card = write_card(shifted_material(law), card_target(target));
    std::string text;
    for (const DeckFile& file :
         one_element_deck(card, card_deck(target), unit_system("SI"), ElementTestKind::kRelaxation)
             .files) {
      text += file.text;
    }
    return text;
  };
  CHECK_THAT(deck_text("abaqus", ShiftLaw::kWlf),
             Contains("\n*INITIAL CONDITIONS, TYPE=TEMPERATURE\nNALL, 23\n"));
  CHECK_THAT(deck_text("abaqus", ShiftLaw::kArrhenius), Contains("\n*PHYSICAL CONSTANTS, "));
  CHECK_THAT(deck_text("ansys", ShiftLaw::kWlf), Contains("\nTUNIF,23\n"));
  CHECK_THAT(deck_text("frontistr", ShiftLaw::kWlf),
             Contains("\n!INITIAL CONDITION, TYPE=TEMPERATURE\n NALL, 23\n") &&
                 Contains("\n!TEMPERATURE, GRPID=2\n NALL, 23\n") && Contains(" LOAD, 2\n"));
  CHECK_THAT(deck_text("lsdyna", ShiftLaw::kArrhenius), Contains("\n*LOAD_THERMAL_CONSTANT\n"));
  // COMSOL's times are the card's times the shift factor at the parameter "temperature".
  const std::string wlf = deck_text("comsol", ShiftLaw::kWlf);
  CHECK_THAT(wlf, Contains("set(\"temperature\", prefix + \"_Tref\")") &&
                      Contains("prefix + \"_tau1*aT\"") && Contains("\"10^(-\" + prefix + \"_C1*"));
  CHECK_THAT(deck_text("comsol", ShiftLaw::kArrhenius), Contains("_Q/R_const*(1/temperature-1/"));
}
