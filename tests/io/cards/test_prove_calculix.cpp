#include "io/cards/card.h"
#include "io/cards/card_numbers.h"
#include "io/cards/one_element.h"
#include "io/cards/proof/card_proof.h"
#include "io/cards/proof/solvers.h"
#include "io/cards/targets/card_targets.h"
#include "models/material/hereditary.h"
#include "models/material/retardation_spectrum.h"
#include "tests/io/cards/card_materials.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>

using namespace viscard;
using namespace viscard::test;

namespace {

bool has_ccx() {
  static const bool found = std::system("command -v ccx >/dev/null 2>&1") == 0;
  if (!found) WARN("ccx is not installed; CalculiX is not run");
  return found;
}

CardProof prove_in_calculix(const std::string& card_text, const Material& material,
                            const UnitSystem& units, int steps_per_tau = 40) {
  const FoundSolver ccx = find_solver(solver_for("calculix", "calculix"), "");
  ReadCard read{.understood = card_target("calculix"), .units = units};
  read.name = "PDMS";
  read.material = material;
  return prove_card(card_text, read, material, ccx, steps_per_tau);
}

CardProof proof_of(const Material& material, const char* units, int steps_per_tau) {
  const Material ruled = with_bulk_rule(material, BulkRule::kConstantBulk);
  const Card card = write_card(ruled, card_target("calculix"), {.units = units});
  return prove_in_calculix(card.text, ruled, unit_system(units), steps_per_tau);
}

}  // namespace

TEST_CASE("the expected curve is the hereditary integral of ramp and hold", "[cards]") {
  const Material material = material_of_terms(4, 0.3);
  const ElementTest test = element_test(material, {.steps_per_tau = 10});
  HereditaryStress stress(young_series(material));
  stress.advance(test.ramp_s, 1.0);
  CHECK(exact_response(material, test, test.ramp_s) ==
        Approx(stress.stress_Pa() / material.E0_Pa).epsilon(1e-12));  // both exact
  stress.advance(5.0 * test.ramp_s, 1.0);
  CHECK(exact_response(material, test, 6.0 * test.ramp_s) ==
        Approx(stress.stress_Pa() / material.E0_Pa).epsilon(1e-12));
  // Creep ends at the long-term compliance, E0/E_inf.
  ElementTest creep = test;
  creep.kind = ElementTestKind::kCreep;
  CHECK(exact_response(material, creep, 1e6 * test.end_s()) ==
        Approx(material.E0_Pa / derived_moduli(material).E_inf_Pa).epsilon(1e-9));
}

TEST_CASE("CalculiX returns the exact relaxation and creep of the reference card", "[cards]") {
  if (!has_ccx()) return;
  const CardProof proof = proof_of(reference_material(), "mm-t-s", 40);
  CHECK(proof.relaxation.at_step <= 1e-4);  // first order in the step tau/40
  CHECK(proof.creep.at_step <= 2e-4);
  CHECK(proof.relaxation.remaining <= 3e-6);  // ccx prints seven digits
  CHECK(proof.creep.remaining <= 3e-6);
  CHECK(proof.holds());
  REQUIRE(proof.terms.size() == 2);
  CHECK(proof.end_s >= 24.03);  // ten times the longest time
  CHECK(proof.increments > 100);
}

TEST_CASE("CalculiX converges to the exact relaxation at first order in the step",
          "[cards][convergence]") {
  if (!has_ccx()) return;
  Material material = material_of_terms(2, 0.45);
  const double coarse = proof_of(material, "SI", 10).relaxation.at_step;
  const double fine = proof_of(material, "SI", 20).relaxation.at_step;
  const double order = std::log2(coarse / fine);
  CAPTURE(coarse, fine);
  CHECK(order == Approx(1.0).margin(0.15));
}

TEST_CASE("CalculiX accepts the overlay in different unit systems", "[cards]") {
  if (!has_ccx()) return;
  for (const char* units : {"SI", "mm-kg-ms", "um-kg-s"}) {  // Pa, GPa and ms, uN and um
    CAPTURE(units);
    const Material material = material_of_terms(3, 0.48);
    const CardProof proof = proof_of(material, units, 10);
    CAPTURE(proof.relaxation.worst_s, proof.relaxation.remaining, proof.creep.remaining);
    CHECK(proof.holds());
    // First order: 6e-3 of the sum of g at tau/40, four times that here, of a modulus fallen to
    // 0.4.
    CHECK(proof.relaxation.at_step <= 4.0 * 6e-3 * 0.6 / 0.4);
  }
}

TEST_CASE("CalculiX accepts nine terms over three decades", "[cards][slow]") {
  if (!has_ccx()) return;
  const CardProof proof = proof_of(material_of_terms(9, 0.495), "mm-t-s", 10);
  CHECK(proof.relaxation.at_step <= 4.0 * 6e-3 * 0.6 / 0.4);
  CHECK(proof.holds());
  CHECK(proof.end_s > 1.0);
}

TEST_CASE("a proof loads terms nine decades apart, and finds a wrong slow one", "[cards]") {
  if (!has_ccx()) return;
  Material material = reference_material();
  material.nu = 0.45;
  material.terms = {{0.2, 0.0, 1e-4}, {0.3, 0.0, 1e5}};
  const CardProof right = proof_of(material, "mm-t-s", 10);
  CAPTURE(right.relaxation.remaining, right.relaxation.resolved, right.creep.remaining);
  CHECK(right.holds());
  CHECK(right.end_s >= 1e6);
  REQUIRE(right.terms.size() == 2);
  CHECK(right.terms[0].is_exercised);
  CHECK(right.terms[1].is_exercised);
  Material wrong = material;
  wrong.terms[1].tau_s *= 10.0;
  const Card card = write_card(wrong, card_target("calculix"), {.units = "mm-t-s"});
  const CardProof refused = prove_in_calculix(card.text, material, unit_system("mm-t-s"), 10);
  CHECK_FALSE(refused.agrees());
  CHECK_FALSE(refused.divergence);
}

TEST_CASE("a term too small to be seen is reported as not exercised", "[cards]") {
  if (!has_ccx()) return;
  Material material = reference_material();
  material.terms.push_back({1e-7, 1e-7, 0.7});
  const CardProof proof = proof_of(material, "mm-t-s", 10);
  CHECK(proof.agrees());
  CHECK_FALSE(proof.holds());
  REQUIRE(proof.terms.size() == 3);
  CHECK(proof.terms[0].is_exercised);
  CHECK(proof.terms[1].is_exercised);
  CHECK_FALSE(proof.terms[2].is_exercised);
}

TEST_CASE("a card that CalculiX would leave elastic fails the proof", "[cards]") {
  if (!has_ccx()) return;
  const Material material = with_bulk_rule(reference_material(), BulkRule::kConstantBulk);
  const Card card = write_card(material, card_target("abaqus"), {.units = "mm-t-s"});
  const CardProof proof = prove_in_calculix(card.text, material, unit_system("mm-t-s"), 10);
  // E_inf of the rising load is 1/(1 - sum g) - 1 = 2.26e-2 too small, less what still relaxes.
  CHECK(proof.relaxation.at_step > 0.01);
  CHECK_FALSE(proof.holds());
}

TEST_CASE("strong relaxation is proven by an error proportional to the step", "[cards]") {
  if (!has_ccx()) return;
  Material material = reference_material();
  material.terms = {{0.95, 0.95, 2.0}};
  const CardProof right = proof_of(material, "mm-t-s", 40);
  CAPTURE(right.relaxation.at_step, right.relaxation.remaining, right.creep.remaining);
  CHECK(right.relaxation.at_step > 1e-3);  // at tau/40 the error alone proves nothing
  CHECK(right.holds());
  Material wrong = material;
  wrong.terms[0].tau_s *= 1.01;
  const Card card = write_card(with_bulk_rule(wrong, BulkRule::kConstantBulk),
                               card_target("calculix"), {.units = "mm-t-s"});
  const CardProof refused = prove_in_calculix(
      card.text, with_bulk_rule(material, BulkRule::kConstantBulk), unit_system("mm-t-s"));
  CHECK_FALSE(refused.holds());
}

TEST_CASE("a card that makes ccx diverge is blamed if the right card does not", "[cards]") {
  if (!has_ccx()) return;
  const Material material = with_bulk_rule(reference_material(), BulkRule::kConstantBulk);
  std::string text = write_card(material, card_target("calculix"), {.units = "mm-kg-ms"}).text;
  const std::size_t at = text.find("LAW=NORTON\n") + 11;
  text.replace(at, text.find(',', at) - at, "1e12");  // 3e9 times the right rate
  const CardProof proof = prove_in_calculix(text, material, unit_system("mm-kg-ms"), 10);
  REQUIRE(proof.divergence);
  CHECK(proof.divergence->test == "relaxation");
  CHECK(proof.divergence->is_card_blamed);
  CHECK_FALSE(proof.holds());
}

TEST_CASE("ccx errors come back in one line", "[cards]") {
  if (!has_ccx()) return;
  CHECK_THROWS_WITH(prove_in_calculix("*MATERIAL, NAME=A\n*ELASTIC\nnonsense\n",
                                      reference_material(), unit_system("SI"), 4),
                    Catch::Contains("ccx"));
}
