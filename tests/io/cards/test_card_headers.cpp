// Headers of cards are checked as their numbers are; second elements, bands, reductions beyond use.
#include "io/cards/card.h"
#include "io/cards/card_sum.h"
#include "io/cards/check_card.h"
#include "io/cards/hyperelastic/read_rubber.h"
#include "io/cards/proof/card_chain.h"
#include "io/cards/targets/card_targets.h"
#include "tests/io/cards/card_materials.h"

#include <catch2/catch.hpp>

#include <cctype>

using namespace viscard;
using namespace viscard::test;
using Catch::Contains;

namespace {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  INFO("looking for: " << from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

// The names of all findings, a mistake with "!"; or the text of the error.
std::string findings_of(const std::string& text, const CardTarget& target, const Material* material,
                        const CheckOptions& options = {}) {
  try {
    std::string names;
    for (const CardFinding& finding : check_card(text, target, options, material).findings) {
      names += (names.empty() ? "" : " ") + finding.name + (finding.is_mistake ? "!" : "");
    }
    return names;
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

Material material_for(const CardTarget& target) {
  Material material = reference_material();
  material.T_ref_C = 23.0;
  if (target.max_terms == 1) material.terms.resize(1);
  return material;
}

bool is_letter_or_digit(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0;
}

}  // namespace

TEST_CASE("an edit of any line of a header is seen", "[cards]") {
  for (const CardTarget& target : card_targets()) {
    const Material material = material_for(target);
    const std::string text =
        write_card(material, target, {.units = "mm-t-s", .is_reproducible = true}).text;
    std::size_t from = target.comment.empty() ? text.find('\n', text.find("\"header\"")) + 1 : 0;
    int lines = 0;
    for (std::size_t end = 0; from < text.size(); from = end + 1) {
      end = text.find('\n', from);
      const std::string line = text.substr(from, end - from);
      if (target.comment.empty() ? line.find('"') == std::string::npos
                                 : line.rfind(target.comment + " ", 0) != 0) {
        continue;
      }
      std::size_t last = end;
      while (last > from && !is_letter_or_digit(text[last])) --last;
      if (last == from) continue;
      std::string edited = text;
      edited[last] = text[last] == '7' ? '8' : std::isdigit(text[last]) != 0 ? '7' : 'x';
      CAPTURE(target.name, line, edited.substr(from, end - from));
      CHECK_FALSE(findings_of(edited, target, &material).empty());
      ++lines;
    }
    CHECK(lines > 8);
  }
}

TEST_CASE("a header that contradicts the card or the material is a mistake", "[cards]") {
  const CardTarget& target = card_target("abaqus");
  const Material material = material_for(target);
  const std::string text = write_card(material, target, {.units = "mm-t-s"}).text;
  CHECK(findings_of(text, target, &material).empty());
  CHECK(findings_of(text, target, nullptr).empty());
  for (const auto& [from, to] : {std::pair{"at 23 C", "at 32 C"},
                                 {" for Abaqus", " for ANSYS"},
                                 {"branches relative", "branches absolute"},
                                 {"strain up to 0.05", "strain up to 0.5"},
                                 {"E_inf (long-term) = 1.8385", "E_inf (long-term) = 1.9385"},
                                 {"K0 = 62.66666667", "K0 = 26.66666667"}}) {
    CAPTURE(from);
    CHECK(findings_of(replaced(text, from, to), target, &material) == "header-differs!");
  }
  // What follows from the numbers of the card needs no material.
  for (const auto& [from, to] : {std::pair{" for Abaqus", " for ANSYS"},
                                 {"branches relative", "branches absolute"},
                                 {"K0 = 62.66666667", "K0 = 26.66666667"}}) {
    CAPTURE(from);
    CHECK(findings_of(replaced(text, from, to), target, nullptr) == "header-differs!");
  }
  // Two lines that contradict each other.
  const std::string second = "** units: SI (m, kg, s, N, Pa, kg/m3)\n";
  const std::size_t below = text.find("** conventions: ");
  CHECK_THAT(findings_of(std::string(text).insert(below, second), target, &material),
             Contains("header-differs!"));
  const std::size_t valid = text.find("** valid: ");
  const std::string without = std::string(text).erase(valid, text.find('\n', valid) + 1 - valid);
  CHECK(findings_of(without, target, &material) == "header-incomplete");
  // Cards of other versions have other words; the sum shows the edit all the same.
  CHECK(findings_of(replaced(replaced(text, "viscard 0", "viscard 9"), "at 23 C", "at 32 C"),
                    target, &material) == "card-edited");
}

TEST_CASE("a second element that contradicts the first is a mistake", "[cards]") {
  for (const char* name : {"mujoco", "sofa", "physx"}) {
    const CardTarget& target = card_target(name);
    const Material material = material_for(target);
    const std::string text = write_card(material, target, {.units = "SI"}).text;
    const char* open = name == std::string("mujoco") ? "<elasticity"
                       : name == std::string("sofa") ? "<TetrahedronViscoelasticity"
                                                     : "def Material";
    const std::size_t at = text.find(open);
    REQUIRE(at != std::string::npos);
    std::string second = text.substr(at);
    const std::size_t digit = second.find_first_of("123456789", second.find('0'));
    second[digit] = second[digit] == '9' ? '1' : '9';
    CAPTURE(name, second);
    CHECK_THAT(findings_of(text + second, target, &material), Contains("second-element!"));
  }
}

TEST_CASE("a card for another band than --band is a mistake", "[cards]") {
  for (const char* name : {"rayleigh", "mujoco", "abaqus-table"}) {
    const CardTarget& target = card_target(name);
    const Material material = material_for(target);
    const FrequencyBand band{0.1, 10.0};
    const std::string text = write_card(material, target, {.units = "SI", .band = band}).text;
    CAPTURE(name);
    CHECK(findings_of(text, target, &material, {.band = band}).empty());
    CHECK(findings_of(text, target, &material, {.band = FrequencyBand{0.1, 20.0}}) ==
          "band-differs!");
  }
}

TEST_CASE("one modulus for a band over which the material relaxes altogether is refused",
          "[cards]") {
  Material material = material_for(card_target("rayleigh"));
  material.terms = {{0.999, 0.999, 1.0}};
  material.valid = {};
  CardOptions options{.units = "SI", .band = FrequencyBand{1e-3, 1e3}};
  for (const char* name : {"rayleigh", "mujoco", "physx"}) {
    CAPTURE(name);
    CHECK_THROWS_WITH(
        write_card(material, card_target(name), options),
        Contains("grows 962 times") && Contains("up to 99.8 % wrong") && Contains("--approximate"));
  }
  options.may_approximate = true;
  CHECK_THAT(write_card(material, card_target("rayleigh"), options).text,
             Contains("by up to 1.0e+00 over the band, where it grows 962 times"));
  // Half of the modulus relaxes: written, with its error.
  material.terms = {{0.5, 0.5, 1.0}};
  options.may_approximate = false;
  CHECK_THAT(write_card(material, card_target("rayleigh"), options).text,
             Contains("by up to 3.3e-01 over the band, where it grows 2 times"));
}

TEST_CASE("a card beyond the measured times comes with a warning", "[cards]") {
  const Material material = material_for(card_target("rayleigh"));  // 12.5 ms to 60 s
  CHECK(write_card(material, card_target("rayleigh"), {}).warnings.empty());
  const Card card =
      write_card(material, card_target("rayleigh"), {.band = FrequencyBand{10.0, 1e3}});
  REQUIRE(card.warnings.size() == 1);
  CHECK_THAT(card.warnings[0], Contains("EXTRAPOLATED: the measured times"));
}

TEST_CASE("the temperature that a header asks for is in the unit of the card", "[cards]") {
  Material material = reference_material();
  material.shift = TemperatureShift{.law = ShiftLaw::kArrhenius, .T_ref_C = 23.0};
  material.shift->activation_J_mol = 50000.0;
  material.T_ref_C = 23.0;
  CHECK_THAT(write_card(material, card_target("lsdyna"), {}).text,
             Contains("296.15 K for the times below"));
  CHECK_THAT(write_card(material, card_target("abaqus"), {}).text,
             Contains("23 C for the times below"));
}

TEST_CASE("names that are lines of a header leave the header of every card as it is", "[cards]") {
  const std::string digits(64, 'a');
  const CardOptions options{.units = "mm-t-s",
                            .is_reproducible = true,
                            .material_sha256 = digits,
                            .material_file = "card sha256 m.json"};
  for (const CardTarget& target : card_targets()) {
    Material material = material_for(target);
    for (const std::string& name :
         {"card sha256 " + digits, std::string("units: SI (E0 (instantaneous) = 7)"),
          std::string("viscard card: yeoh for abaqus")}) {
      CAPTURE(target.name, name);
      material.name = name;
      material.provenance.raw_files = {{name + ".csv", digits}};
      const Card card = write_card(material, target, options);
      CHECK(card.text.find(name + " for " + target.code) != std::string::npos);
      CHECK(card.text.find(std::string(64, '0')) == std::string::npos);
      CHECK(stated_card_sum(card.text) == card_sum(card.text));
      CHECK_FALSE(is_card_edited(card.text));
      for (const CompanionFile& companion : card.companions)
        CHECK_FALSE(is_card_edited(companion.text));
      CHECK(stated_unit_system(card.text) == "mm-t-s");
      CHECK(stated_rubber_target(card.text).empty());
      CHECK(findings_of(card.text, target, &material).empty());
      const CardChain chain = chain_of("", card.text, "");
      CHECK(chain.stated_sum == chain.found_sum);
      REQUIRE(chain.raw_files.size() == 1);
      CHECK(chain.raw_files[0].path == name + ".csv");
      CHECK(chain.material.stated == digits);
    }
  }
}

TEST_CASE("no flipped bit of a card leaves its sum right", "[cards]") {
  const CardTarget& target = card_target("abaqus");
  const std::string text =
      write_card(material_for(target), target, {.units = "mm-t-s", .is_reproducible = true}).text;
  REQUIRE(stated_card_sum(text) == card_sum(text));
  std::size_t n_unnoticed = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string flipped = text;
    flipped[i] = static_cast<char>(flipped[i] ^ 1);
    n_unnoticed += stated_card_sum(flipped) == card_sum(flipped) ? 1 : 0;
  }
  CHECK(n_unnoticed == 0);
}
