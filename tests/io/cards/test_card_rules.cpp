#include "io/cards/card.h"
#include "io/cards/deck.h"
#include "io/cards/targets/card_targets.h"
#include "tests/io/cards/card_materials.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace viscard;
using namespace viscard::test;

TEST_CASE("the header states what fewer terms and the bulk rule cost together", "[cards]") {
  const Material original = material_of_terms(6, 0.2);
  Material fewer = original;  // as if refitted badly: two terms lost
  fewer.terms.resize(4);
  const Card card = write_card(fewer, card_target("openradioss"),
                               {.may_approximate = true,
                                .done_before = {{"terms", Mapping::kApproximated, "6 to 4"}},
                                .original = original});
  const auto total = std::find_if(card.fidelity.begin(), card.fidelity.end(),
                                  [](const FidelityItem& item) { return item.item == "total"; });
  REQUIRE(total != card.fidelity.end());
  // Independent: E(t) of both by hand from the written terms, at the end of the window.
  const double E_inf = original.E0_Pa * (1.0 - 0.6);
  const double written_E_inf = derived_moduli(card.written).E_inf_Pa;
  CHECK(card.largest_difference >= std::abs(written_E_inf / E_inf - 1.0) * 0.99);
  CHECK(card.text.find("total: approximated") != std::string::npos);
}

TEST_CASE("a CalculiX card states the step error of its material", "[cards]") {
  Material material = reference_material();
  material.terms = {{0.95, 0.95, 2.0}};
  const std::string text =
      write_card(material, card_target("calculix"), {.may_approximate = true}).text;
  // g x/2 (t/tau) exp(-t/tau)/(1 - g (1 - exp(-t/tau))) with x = 1/40 is largest at t = 2.52 tau:
  // 0.011875 * 2.52 * 0.08046/(0.05 + 0.95 * 0.08046) = 1.90e-2
  CHECK(text.find("E(t) after a jump is off by up to 1.9e-02") != std::string::npos);
}

TEST_CASE("FEBio's uncoupled card states k at its top level", "[cards]") {
  const std::string text =
      write_card(reference_material(), card_target("febio-uncoupled"), {.units = "mm-t-s"}).text;
  CHECK(text.find("<k>") < text.find("<elastic"));
  CHECK(text.find("<k>") == text.rfind("<k>"));
}

TEST_CASE("a material without density is refused where the solver needs one", "[cards]") {
  Material material = reference_material();
  material.rho_kg_m3 = 0.0;
  for (const char* target : {"openradioss", "lsdyna"}) {
    CHECK_THROWS_WITH(write_card(material, card_target(target)),
                      Catch::Contains("gives no density") && Catch::Contains("rho_kg_m3"));
  }
  const Card comsol = write_card(material, card_target("comsol"));
  const Deck deck = one_element_deck(comsol, card_deck("comsol"), unit_system("SI"),
                                     ElementTestKind::kRelaxation);
  CHECK(deck.files[0].text.find("_rho") == std::string::npos);
}
