#include "io/cards/targets/card_targets.h"
#include "tests/io/cards/card_materials.h"
#include "tests/io/cli/card/card_command.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>

using namespace viscard;
using namespace viscard::test;
using Catch::Contains;

namespace {

Material wlf_material() {
  Material material = reference_material();
  material.T_ref_C = 23.0;
  material.shift =
      TemperatureShift{.law = ShiftLaw::kWlf, .T_ref_C = 23.0, .C1 = 8.86, .C2_K = 101.6};
  return material;
}

bool has_finding(const nlohmann::json& check, const char* name) {
  for (const auto& finding : check.at("findings")) {
    if (finding.at("name") == name) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("a card of one temperature has the times that the shift gives there", "[cards][cli]") {
  CardCommand card;
  const Material material = wlf_material();
  const std::string file = card.save(material), path = card.path("warm.feb");
  // Refused, with the way out, instead of written without the shift.
  CHECK(card.run({file, "--for", "febio", "--out", path}) == kFailed);
  CHECK_THAT(card.err, Contains("WLF shift") && Contains("--at-temperature") && Contains("23"));
  CHECK_FALSE(std::filesystem::exists(path));
  REQUIRE(card.run({file, "--for", "febio", "--at-temperature", "40", "--out", path}) == kDone);
  // log10 a_T = -8.86 * 17/(101.6 + 17) = -1.2699831...; tau_1 = 0.1945 s * 0.0537053
  CHECK_THAT(read_file(path), Contains("the card holds at 40 C only"));
  CHECK(card.run({"--check", path, file, "--json"}) == kDone);
  const auto check = nlohmann::json::parse(card.out);
  CHECK(check.at("material").at("terms")[0].at("tau_s").get<double>() ==
        Approx(0.1945 * std::pow(10.0, -8.86 * 17.0 / 118.6)).epsilon(1e-9));
  CHECK(has_finding(check, "as-stated"));
  // At the reference temperature the card holds as it is, and the shift is mentioned.
  const std::string plain = card.path("plain.feb");
  REQUIRE(card.run({file, "--for", "febio", "--approximate", "--out", plain}) == kDone);
  CHECK(card.run({"--check", plain, file, "--json"}) == kDone);
  CHECK(has_finding(nlohmann::json::parse(card.out), "shift-not-held"));
  CHECK(card.run({card.save(reference_material()), "--for", "febio", "--at-temperature", "40"}) ==
        kFailed);
  CHECK_THAT(card.err, Contains("no temperature shift"));
}

TEST_CASE("--check compares a card of fewer terms with what its header states", "[cards][cli]") {
  CardCommand card;
  Material thirty = material_of_terms(30, 0.4);
  thirty.valid = {1e-3, 1e6, 0.0};
  const std::string file = card.save(thirty), path = card.path("six.feb");
  REQUIRE(card.run({file, "--for", "febio", "--approximate", "--out", path}) == kDone);
  CHECK(card.run({"--check", path, file}) == kDone);
  CHECK_THAT(card.out, Contains("as-stated") && Contains("30 refitted to 6") && Contains("agrees"));
  std::string text = read_file(path);  // a wrong number is found all the same
  text.replace(text.find("<t1>") + 4, 1, text[text.find("<t1>") + 4] == '9' ? "1" : "9");
  write_file(path, text, true);
  CHECK(card.run({"--check", path, file}) == kFailed);
}

TEST_CASE("--check knows clamped ratios, one modulus and a bound from the header", "[cards][cli]") {
  CardCommand card;
  Material material = reference_material();
  material.nu = 0.5;
  const std::string file = card.save(material), path = card.path("c.k");
  REQUIRE(card.run({file, "--for", "lsdyna", "--clamp-nu", "0.4995", "--out", path}) == kDone);
  CHECK(card.run({"--check", path, file}) == kDone);
  CHECK_THAT(card.out, Contains("nu clamped from 0.5 to 0.4995"));
  const std::string elastic = card.path("e.inp");
  REQUIRE(card.run({card.save(reference_material()), "--for", "abaqus", "--elastic-only",
                    "long-term", "--out", elastic}) == kDone);
  CHECK(card.run({"--check", elastic, file.c_str()}) == kDone);
}

TEST_CASE("cards by viscard name their target, so --check needs no --for", "[cards][cli]") {
  CardCommand card;
  Material material = reference_material();
  material.name = "gel for FEBio viscoelastic for COMSOL";  // a name that misleads
  material.terms.resize(1);
  const std::string file = card.save(material);
  for (const CardTarget& target : card_targets()) {
    CAPTURE(target.name);
    const std::string path = card.path("x" + target.extension);
    REQUIRE(card.run({file, "--for", target.name, "--out", path, "--force"}) == kDone);
    CHECK(card.run({"--check", path, file, "--json"}) == kDone);
    CHECK(nlohmann::json::parse(card.out).at("target") == target.name);
  }
  write_file(card.path("hand.inp"), "*MATERIAL, NAME=A\n*ELASTIC\n1, 0.3\n", true);
  CHECK(card.run({"--check", card.path("hand.inp")}) == kBadWords);
  CHECK_THAT(card.err, Contains("--for TARGET"));
}

TEST_CASE("--check prints the unit system in which csv and COMSOL numbers stand", "[cards][cli]") {
  CardCommand card;
  const std::string file = card.save(reference_material());
  for (const char* target : {"csv", "comsol", "json"}) {
    CAPTURE(target);
    const std::string path = card.path(std::string("u.") + target);
    REQUIRE(card.run({file, "--for", target, "--units", "mm-t-s", "--out", path}) == kDone);
    CHECK(card.run({"--check", path, file}) == kDone);
    CHECK_THAT(card.out, Contains("units mm-t-s"));
  }
}
