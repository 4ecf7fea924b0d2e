#include "io/cards/card.h"
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
    const Card card = write_card(shifted_material(ShiftLaw::kWlf), target);
    CHECK(temperature_mapping(card) == (target.takes_wlf ? "exact" : "dropped"));
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

TEST_CASE("an Arrhenius shift is not written as another law, and the header states that",
          "[cards]") {
  const Card card = write_card(shifted_material(ShiftLaw::kArrhenius), card_target("abaqus"));
  CHECK(temperature_mapping(card) == "dropped");
  CHECK_THAT(card.text, Contains("temperature: dropped, Arrhenius, 52000 J/mol at 23 C"));
  CHECK_THAT(card.text, !Contains("*TRS"));
}
