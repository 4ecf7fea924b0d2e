// Cards in OpenRadioss, by a stand-in for its three programs (stand_in_openradioss.py).
#include "io/cards/card.h"
#include "io/cards/card_numbers.h"
#include "io/cards/proof/card_proof.h"
#include "io/cards/proof/certificate.h"
#include "io/cards/proof/solvers.h"
#include "io/cards/targets/card_targets.h"
#include "tests/io/cards/card_materials.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

using namespace viscard;
using namespace viscard::test;
using Catch::Contains;

namespace {

namespace fs = std::filesystem;

bool is_python_missing() {
  if (std::system("command -v python3 >/dev/null 2>&1") == 0) return false;
  WARN("python3 is not installed; the stand-in is not run");
  return true;
}

// The three programs in a folder, as OpenRadioss has them in exec/.
FoundSolver stand_in_radioss(const ScratchFolder& folder) {
  const fs::path script = fs::path(VISCARD_GOLDEN_FOLDER).parent_path() / "stand_in_openradioss.py";
  for (const char* name : {"starter_linux64_gf", "engine_linux64_gf", "th_to_csv_linux64_gf"}) {
    fs::copy_file(script, folder.path() / name, fs::copy_options::overwrite_existing);
    fs::permissions(folder.path() / name, fs::perms::owner_all);
  }
  return find_solver(solver_for("", "openradioss"),
                     (folder.path() / "starter_linux64_gf").string());
}

Material two_terms() {
  Material material = reference_material();
  material.nu = 0.4;
  material.terms = {{0.2, 0.0, 2e-3}, {0.3, 0.0, 3e-3}};
  return material;
}

std::string radioss_card(const Material& material, const char* units = "mm-t-s") {
  return write_card(material, card_target("openradioss"), {.units = units}).text;
}

CardProof proof_of_text(const std::string& card, const Material& material,
                        const FoundSolver& solver) {
  return prove_card(card, read_card(card, card_target("openradioss"), ""), material, solver);
}

// The card with one word of it replaced, which must stand there.
std::string edited(std::string card, const std::string& from, const std::string& to) {
  const std::size_t at = card.find(from);
  REQUIRE(at != std::string::npos);
  return card.replace(at, from.size(), to);
}

}  // namespace

TEST_CASE("a right card holds in OpenRadioss' three programs, in any units", "[cards]") {
  if (is_python_missing()) return;
  const ScratchFolder folder;
  const FoundSolver solver = stand_in_radioss(folder);
  CHECK(solver.version == "Jan  1 2026");
  for (const char* units : {"mm-t-s", "um-kg-s"}) {
    const CardProof proof = proof_of_text(radioss_card(two_terms(), units), two_terms(), solver);
    CAPTURE(units, proof.relaxation.at_step, proof.relaxation.remaining, proof.relaxation.resolved,
            proof.creep.at_step, proof.creep.remaining, proof.creep.resolved);
    CHECK(proof.holds());
    // The lag of the answer, 2/omega, is of first order in the step and disappears.
    CHECK(proof.creep.at_step > 1e-3);
    CHECK(proof.relaxation.remaining < 2e-6);
    CHECK(proof.creep.remaining < 2e-6);
    CHECK(proof.creep.resolved < 1e-4);
    REQUIRE(proof.models.size() == 6);  // two of each: relaxation, creep, confined
    CHECK_THAT(proof.models[1].text, Contains("/TH/TITLE") && Contains("/TFILE\n"));
    CHECK_THAT(proof.models[2].text, Contains("/CLOAD/1") && Contains("/DAMP/1"));
  }
}

TEST_CASE("the certificate of a run in OpenRadioss says that only a stand-in was tested",
          "[cards]") {
  if (is_python_missing()) return;
  const ScratchFolder folder;
  const FoundSolver solver = stand_in_radioss(folder);
  const fs::path path = folder.path() / "card.rad";
  const std::string card = radioss_card(two_terms());
  std::ofstream(path) << card;
  const CertificateRequest request{path.string(), card, "", "openradioss"};
  const std::string text = certificate_text(request, chain_of(request), solver, CardProof{});
  CHECK_THAT(text, Contains("\"caution\": \"OpenRadioss itself has never run this test") &&
                       Contains("Jan  1 2026"));
  const FoundSolver other{solver_for("calculix", "calculix"), "", ""};
  CHECK_THAT(certificate_text(request, chain_of(request), other, CardProof{}),
             Contains("\"caution\": null"));
}

TEST_CASE("cards with a rate, a bulk modulus or units off do not hold in OpenRadioss", "[cards]") {
  if (is_python_missing()) return;
  const ScratchFolder folder;
  const FoundSolver solver = stand_in_radioss(folder);
  Material fast = two_terms();
  fast.terms[1].tau_s /= 10.0;
  CHECK_FALSE(proof_of_text(radioss_card(fast), two_terms(), solver).agrees());
  // K doubled, as a card by a person who divides by 1 - 2 nu wrongly; G stays.
  const Material material = two_terms();
  const DerivedModuli moduli = derived_moduli(material);
  Material stiff = material;
  stiff.nu = (6.0 * moduli.K0_Pa - 2.0 * moduli.G0_Pa) / (12.0 * moduli.K0_Pa + 2.0 * moduli.G0_Pa);
  stiff.E0_Pa = 2.0 * moduli.G0_Pa * (1.0 + stiff.nu);
  CHECK_FALSE(proof_of_text(radioss_card(stiff), material, solver).agrees());
  // The card says grams where its numbers are of kilograms: nothing but /UNIT is wrong.
  const std::string card = radioss_card(material, "SI");
  const std::string grams = edited(card, "                  kg   ", "                   g   ");
  const ReadCard read = read_card(card, card_target("openradioss"), "");
  CHECK_FALSE(prove_card(grams, read, material, solver).agrees());
}

TEST_CASE("OpenRadioss proves nothing of a term that is too weak or too short", "[cards]") {
  if (is_python_missing()) return;
  const ScratchFolder folder;
  const FoundSolver solver = stand_in_radioss(folder);
  Material material = two_terms();
  material.terms[0].g = 1e-5;
  const CardProof proof = proof_of_text(radioss_card(material), material, solver);
  CHECK(proof.agrees());
  REQUIRE(proof.terms.size() == 2);
  CHECK_FALSE(proof.terms[0].is_exercised);
  CHECK(proof.terms[1].is_exercised);
  CHECK_FALSE(proof.holds());
  // Six decades would need 2e10 cycles: the ramp is longer, and the test has as many as are allowed.
  material.terms = {{0.2, 0.0, 1e-6}, {0.3, 0.0, 1.0}};
  ElementTestOptions options = openradioss_test();
  options.most_ramps = openradioss_most_ramps(material);
  const ElementTest test = element_test(material, options);
  CHECK(test.end_s() >= 10.0);
  CHECK(test.end_s() <= options.most_ramps * test.ramp_s);
  CHECK(test.ramp_s > 100.0 * material.terms[0].tau_s);
  CHECK(element_test(two_terms(), options).ramp_s == Approx(1e-3));
}

TEST_CASE("a run of OpenRadioss that stops is no proof, and is not blamed on a right card",
          "[cards]") {
  if (is_python_missing()) return;
  const ScratchFolder folder;
  const FoundSolver solver = stand_in_radioss(folder);
  const std::string card = radioss_card(two_terms());
  // Variables of Python reach a solver; most others do not.
  ::setenv("PYTHON_STAND_IN_STOPS_AFTER", "40", 1);
  CHECK_THROWS_WITH(proof_of_text(card, two_terms(), solver), Contains("OpenRadioss stopped at"));
  ::setenv("PYTHON_STAND_IN_SAYS", "  ** RUN KILLED : ENERGY ERROR LIMIT REACHED", 1);
  const CardProof proof = proof_of_text(card, two_terms(), solver);
  ::unsetenv("PYTHON_STAND_IN_STOPS_AFTER");
  ::unsetenv("PYTHON_STAND_IN_SAYS");
  REQUIRE(proof.divergence);
  CHECK_FALSE(proof.divergence->is_card_blamed);
  CHECK_FALSE(proof.holds());
}

TEST_CASE("a card for OpenRadioss that names no units is refused, with what to add", "[cards]") {
  if (is_python_missing()) return;
  const ScratchFolder folder;
  const FoundSolver solver = stand_in_radioss(folder);
  const std::string card = edited(radioss_card(two_terms()), "/MAT/LAW40/1/1", "/MAT/LAW40/1");
  CHECK_THROWS_WITH(proof_of_text(card, two_terms(), solver), Contains("/MAT/LAW40/1/1 after"));
  CHECK_THROWS_WITH(find_solver(solver.solver, "/bin/true"),
                    Contains("does not answer as OpenRadioss") && Contains("RAD_CFG_PATH"));
}
