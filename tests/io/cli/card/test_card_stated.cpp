#include "io/cards/header_name.h"
#include "io/cards/targets/card_targets.h"
#include "io/materials/hyperelastic_file.h"
#include "tests/io/cards/card_materials.h"
#include "tests/io/cli/card/card_command.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>

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

TEST_CASE("card --check compares a card of fewer terms with what its header states",
          "[cards][cli]") {
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

TEST_CASE("card --check knows clamped ratios, one modulus and a bound from the header",
          "[cards][cli]") {
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
  CHECK(card.run({"--check", elastic, file}) == kDone);
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

TEST_CASE("card --check prints the unit system in which csv and COMSOL numbers stand",
          "[cards][cli]") {
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

TEST_CASE("card --prove leaves a certificate beside the card that leads to the raw data",
          "[cards][cli]") {
  if (std::system("command -v ccx >/dev/null 2>&1") != 0) {
    WARN("ccx is not installed; CalculiX is not run");
    return;
  }
  CardCommand command;
  const std::string raw = command.path("run.csv"), card = command.path("c.inp");
  write_file(raw, "time_s,force_N\n0,0\n", true);
  Material material = reference_material();
  material.terms = {{0.3, 0.3, 0.5}};
  material.provenance.raw_files = {{raw, sha256_of_file(raw)}};
  const std::string file = command.save(material);
  REQUIRE(command.run({file, "--for", "calculix", "--units", "mm-t-s", "--out", card}) == kDone);
  CHECK(command.run({file, "--prove", card}) == kDone);
  CHECK_THAT(command.out, Contains("CalculiX 2.") && Contains("the card holds") &&
                              Contains("1 file of raw data have the sums"));
  const std::string path = card + ".calculix.proof.json";
  const auto certificate = nlohmann::json::parse(read_file(path));
  CHECK(certificate.at("holds") == true);
  CHECK(certificate.at("solver") == "CalculiX");
  CHECK(certificate.at("solver_version").get<std::string>().rfind("2.", 0) == 0);
  CHECK(certificate.at("models")[0].at("text").get<std::string>().find("*VISCO") !=
        std::string::npos);
  const auto& chain = certificate.at("chain");
  CHECK(chain.at("card_sha256") == sha256_of_file(card));
  CHECK(chain.at("material").at("sha256_now") == sha256_of_file(file));
  CHECK(chain.at("raw_files")[0].at("sha256_in_card") == sha256_of_file(raw));
  CHECK(chain.at("complete") == true);
  // Without a material file named, that of the header is found beside the card.
  CHECK(command.run({"--prove", card, "--force"}) == kDone);
  CHECK_THAT(command.out, Contains("1 file of raw data have the sums"));
  CHECK(command.run({"--verify", path}) == kDone);
  CHECK_THAT(command.out, Contains("every stated sum matches"));
  const std::string written = read_file(card);
  write_file(card, written + "** a line more\n", true);
  CHECK(command.run({"--verify", path}) == kFailed);
  CHECK_THAT(command.out, Contains("has been edited since viscard wrote it") &&
                              Contains("is not the card that the certificate is of"));
  write_file(card, written, true);
  write_file(path, read_file(path) + " ", true);
  CHECK(command.run({"--verify", path}) == kFailed);
  CHECK_THAT(command.out, Contains("the certificate has been edited"));
  // Never replaced unasked, before any solver runs; a changed file breaks the chain.
  CHECK(command.run({file, "--prove", card}) == kFailed);
  CHECK_THAT(command.err, Contains("exists already; pass --force"));
  write_file(raw, "time_s,force_N\n0,1\n", true);
  CHECK(command.run({file, "--prove", card, "--force"}) == kDone);
  CHECK_THAT(command.out, Contains("chain: not complete") && Contains("run.csv has changed"));
  CHECK(nlohmann::json::parse(read_file(path)).at("chain").at("complete") == false);
}

TEST_CASE("card --verify finds files of any name from the card of any target", "[cards][cli]") {
  CardCommand command;
  Material material = reference_material();
  material.terms.resize(1);
  material.provenance.raw_files.clear();
  const std::vector<std::string> names{
      "pr\u00fcfung.csv", "x--y---z.csv", "say \"a\".csv", "back\\slash.csv", "tab\there.csv",
      "line\nbreak.csv",  "50%.csv",      "a%41.csv",      "raw data 1.csv",  "a sha256 b.csv"};
  for (const std::string& name : names) {
    write_file(command.path(name), "of " + name, true);
    material.provenance.raw_files.push_back({name, sha256_of_file(command.path(name))});
  }
  const std::string file = command.save(material, "gr\u00fcn--\"m\".json");
  for (const CardTarget& target : card_targets()) {
    CAPTURE(target.name);
    const std::string path = command.path("named" + target.extension);
    REQUIRE(command.run({file, "--for", target.name, "--out", path, "--force"}) == kDone);
    const std::string card = read_file(path);
    CHECK(std::all_of(card.begin(), card.end(),
                      [](char c) { return c == '\n' || c == '\t' || (c >= ' ' && c <= '~'); }));
    CHECK_THAT(card, Contains("raw data pr%C3%BCfung.csv sha256 ") &&
                         Contains("raw data 50%.csv sha256 "));
    CHECK(command.run({"--verify", path}) == kDone);
    CHECK_THAT(command.out, Contains("every stated sum matches") && Contains("gr\u00fcn--"));
  }
}

TEST_CASE("a name in the header of a card is the name again when it is read", "[cards]") {
  std::mt19937 random(5);
  const std::string letters = "ab4C%-- \"\\\n\xc3\xbc";
  std::uniform_int_distribution<std::size_t> place(0, letters.size() - 1), length(0, 8);
  for (int i = 0; i < 5000; ++i) {
    std::string name;
    for (std::size_t n = length(random); n > 0; --n) name += letters[place(random)];
    CAPTURE(name, name_in_header(name));
    CHECK(name_from_header(name_in_header(name)) == name);
    CHECK(name_in_header(name).find("--") == std::string::npos);
  }
  for (const char* ordinary : {"data/run 1.csv", "../a-b_c.json", "50% strain.csv", "a(1)+b.csv"})
    CHECK(name_in_header(ordinary) == ordinary);
  // As older cards state names.
  for (const char* old : {"a%20b.csv", "x--y.csv", "pr??fung.csv"})
    CHECK(name_from_header(old) == old);
}

TEST_CASE("card --solver and --solver-path are explained when they do not fit", "[cards][cli]") {
  CardCommand command;
  const std::string file = command.save(reference_material()), card = command.path("c.inp");
  REQUIRE(command.run({file, "--for", "abaqus", "--out", card}) == kDone);
  CHECK(command.run({"--prove", card}) == kBadWords);
  CHECK_THAT(command.err, Contains("--solver sfepy"));
  CHECK(command.run({"--prove", card, "--solver", "abacus"}) == kBadWords);
  CHECK_THAT(command.err, Contains("there are calculix, febio"));
  CHECK(command.run({file, "--for", "abaqus", "--solver", "sfepy"}) == kBadWords);
  CHECK_THAT(command.err, Contains("belongs to --prove"));
  CHECK(command.run({"--prove", card, "--solver", "sfepy", "--solver-path", "/bin/true"}) ==
        kFailed);
  CHECK_THAT(command.err, Contains("does not answer as SfePy"));
}

TEST_CASE("card --import makes the material of a card, for another solver", "[cards][cli]") {
  CardCommand card;
  const Material material = wlf_material();
  const std::string file = card.save(material), sent = card.path("sent.inp"),
                    made = card.path("made.json"), again = card.path("again.inp");
  REQUIRE(card.run({file, "--for", "abaqus", "--units", "mm-t-s", "--out", sent}) == kDone);
  REQUIRE(card.run({sent, "--import", made}) == kDone);
  const Material read = read_material(made).material;
  CHECK(read.E0_Pa == Approx(material.E0_Pa).epsilon(1e-12));
  CHECK(read.rho_kg_m3 == Approx(material.rho_kg_m3).epsilon(1e-12));
  REQUIRE(read.terms.size() == 2);
  CHECK(read.terms[1].tau_s == Approx(2.403).epsilon(1e-12));
  REQUIRE(read.shift);
  CHECK(read.shift->C1 == Approx(8.86));
  REQUIRE(read.flags.size() == 1);
  CHECK(read.flags[0].name == "imported");
  CHECK(card.run({made, "--for", "comsol", "--out", again}) == kDone);
  CHECK(card.run({"--check", again, made}) == kDone);
  // A card without header needs its solver and its units.
  const std::string bare = card.path("bare.inp");
  write_file(bare,
             "*MATERIAL, NAME=R\n*ELASTIC, MODULI=INSTANTANEOUS\n1.5, 0.49\n*PLASTIC\n1., 0.\n",
             true);
  CHECK(card.run({bare, "--import", card.path("b.json")}) == kBadWords);
  CHECK_THAT(card.err, Contains("--for"));
  CHECK(card.run({bare, "--for", "abaqus", "--import", card.path("b.json")}) == kFailed);
  CHECK_THAT(card.err, Contains("in mm-t-s the modulus is 1.5 MPa (--units mm-t-s)"));
  REQUIRE(card.run({bare, "--for", "abaqus", "--units", "mm-t-s", "--import", card.path("b.json"),
                    "--json"}) == kDone);
  CHECK_THAT(card.err, Contains("'*PLASTIC'"));
  CHECK(nlohmann::json::parse(card.out).at("law") == "linear");
  CHECK(read_material(card.path("b.json")).material.flags.size() == 2);
  // A wrong card becomes no material.
  write_file(bare, "*MATERIAL, NAME=R\n*ELASTIC\n1,5, 0.49\n", true);
  CHECK(card.run({bare, "--for", "abaqus", "--units", "mm-t-s", "--import", card.path("c.json")}) ==
        kFailed);
  CHECK_THAT(card.err, Contains("the card is wrong") && Contains("decimal-comma"));
  CHECK_FALSE(std::filesystem::exists(card.path("c.json")));
}

TEST_CASE("card --import makes a law of rubber with its bulk modulus and density", "[cards][cli]") {
  CardCommand card;
  const std::string sent = card.path("sent.feb"), made = card.path("law.json"),
                    other = card.path("other.mac");
  write_file(sent,
             "<material id=\"1\" name=\"R\" type=\"uncoupled viscoelastic\">\n<g0>0.8</g0>\n"
             "<g1>0.2</g1><t1>3</t1>\n<k>500</k>\n<elastic type=\"Ogden\"><density>1.1e-9</density>"
             "<c1>0.6</c1><m1>2.5</m1></elastic>\n</material>\n",
             true);
  REQUIRE(card.run({sent, "--for", "febio", "--units", "mm-t-s", "--import", made}) == kDone);
  CHECK_THAT(card.out, Contains("a law of rubber, ogden-1"));
  // Neither of the two files is blamed if they are of different kinds.
  CHECK(card.run({"--check", sent, card.save(reference_material()), "--for", "febio"}) ==
        kBadWords);
  CHECK_THAT(card.err,
             Contains("is a card of a law of rubber") && Contains("is a linear material"));
  // c1 = 2 mu; the K and the density of the card stand in that of another solver.
  REQUIRE(card.run({made, "--for", "ansys", "--units", "mm-t-s", "--out", other}) == kDone);
  const std::string text = read_file(other);
  CHECK_THAT(text, Contains("MP,DENS,1,1.1e-09") && Contains("0.004"));
  REQUIRE(card.run({"--check", other, made, "--json"}) == kDone);
  const auto check = nlohmann::json::parse(card.out);
  CHECK(check.at("parameters")[0].at("value").get<double>() == Approx(3e5));
  CHECK(check.at("bulk_modulus_Pa").get<double>() == Approx(5e8));
  CHECK(check.at("terms")[0].at("g").get<double>() == Approx(0.2));
  // An implausible K is refused at this door, too.
  std::string soft = read_file(sent);
  soft.replace(soft.find("<k>500"), 6, "<k>5e14");
  write_file(sent, soft, true);
  CHECK(card.run({sent, "--for", "febio", "--units", "mm-t-s", "--import", card.path("x.json")}) ==
        kFailed);
  CHECK_THAT(card.err, Contains("bulk_modulus_Pa"));
}

TEST_CASE("an edited card is no card without mistake, and its material states the edit",
          "[cards][cli]") {
  CardCommand card;
  const std::string file = card.save(wlf_material()), sent = card.path("sent.inp"),
                    made = card.path("made.json");
  REQUIRE(card.run({file, "--for", "abaqus", "--units", "mm-t-s", "--out", sent}) == kDone);
  REQUIRE(card.run({"--check", sent}) == kDone);
  CHECK_THAT(card.out, Contains("no mistake found; name a material") && !Contains("card-edited"));
  std::string text = read_file(sent);
  const std::size_t at = text.rfind("2.403");
  REQUIRE(at != std::string::npos);
  text.replace(at, 5, "9.403");
  write_file(sent, text, true);
  card.run({"--check", sent});
  CHECK_THAT(card.out, Contains("card-edited: the card is not as viscard wrote it") &&
                           Contains("but the card was edited") &&
                           !Contains("no number of it differs"));
  REQUIRE(card.run({sent, "--import", made, "--json"}) == kDone);
  CHECK_THAT(card.err, Contains("card-edited"));
  const Material read = read_material(made).material;
  CHECK(std::count_if(read.flags.begin(), read.flags.end(),
                      [](const auto& flag) { return flag.name == "edited"; }) == 1);
  REQUIRE(read.provenance.raw_files.size() == 1);
  CHECK(read.provenance.raw_files[0].sha256 == sha256_of_file(sent));
}

TEST_CASE(
    "a card by viscard without its sum is noted when it is checked, and flagged when imported",
    "[cards][cli]") {
  CardCommand card;
  const auto without_sum = [](const std::string& path) {
    std::string text = read_file(path);
    const std::size_t at = text.rfind('\n', text.find("card sha256 "));
    REQUIRE(at != std::string::npos);
    return text.erase(at, text.find('\n', at + 1) - at);
  };
  const std::string file = card.save(reference_material()), sent = card.path("sent.inp"),
                    law = card.path("law.json"), made = card.path("made.json");
  const auto is_noted = Contains("card-unchecked: the header states no sum of the card");
  REQUIRE(card.run({file, "--for", "abaqus", "--units", "mm-t-s", "--out", sent}) == kDone);
  CHECK(card.run({"--check", sent}) == kDone);
  CHECK_THAT(card.out, !is_noted);
  std::string text = without_sum(sent);
  const std::size_t at = text.rfind("2.403");
  REQUIRE(at != std::string::npos);
  write_file(sent, text.replace(at, 5, "9.403"), true);
  CHECK(card.run({"--check", sent}) == kDone);
  CHECK_THAT(card.out, Contains("note ") && is_noted);
  REQUIRE(card.run({sent, "--import", made}) == kDone);
  CHECK_THAT(card.err, is_noted);
  const auto flags = read_material(made).material.flags;
  CHECK(std::any_of(flags.begin(), flags.end(),
                    [](const auto& flag) { return flag.name == "card-unchecked"; }));
  // The same of a law of rubber, whose cards state it again.
  write_file(law,
             R"({"schema": "viscard-hyperelastic/1", "law": "neo-hooke", "trustworthy": true,
"laws": [{"name": "neo-hooke", "parameters": [{"name": "C10_Pa", "value": 200000.0}], "terms": [],
"trustworthy": true, "flags": []}], "tests": [], "flags": []})",
             true);
  REQUIRE(card.run({law, "--for", "abaqus", "--units", "SI", "--out", sent, "--force"}) == kDone);
  CHECK(card.run({"--check", sent}) == kDone);
  CHECK_THAT(card.out, !is_noted);
  write_file(sent, without_sum(sent), true);
  CHECK(card.run({"--check", sent}) == kDone);
  CHECK_THAT(card.out, Contains("note ") && is_noted);
  REQUIRE(card.run({sent, "--import", made, "--force"}) == kDone);
  CHECK_THAT(card.err, is_noted);
  CHECK_FALSE(read_hyperelastic(made).card_doubt.empty());
  REQUIRE(card.run({made, "--for", "abaqus", "--units", "SI"}) == kDone);
  CHECK_THAT(card.out,
             Contains("note: of the card that it was read from: the header states no sum"));
  // A card of before sums existed is only noted.
  CHECK(card.run({"--check", VISCARD_SOURCE_DIR "/tests/compatibility/before/files/card.inp"}) ==
        kDone);
  CHECK_THAT(card.out, is_noted);
}
