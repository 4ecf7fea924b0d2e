#include "fit/reduce_terms.h"
#include "io/cards/read_card.h"
#include "io/cards/targets/card_targets.h"
#include "tests/io/cards/card_materials.h"
#include "tests/io/cli/card/card_command.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <utility>

using namespace viscard;
using namespace viscard::test;

TEST_CASE("viscard card writes, refuses to overwrite, and writes again with --force",
          "[cards][cli]") {
  CardCommand card;
  const std::string material = card.save(reference_material());
  const std::vector<std::string> words{material, "--for", "comsol", "--out", card.path("c.txt")};
  CHECK(card.run(words) == kDone);
  CHECK(std::filesystem::exists(card.path("c_relaxation.txt")));
  const std::string before = read_file(card.path("c.txt"));
  CHECK(card.run(words) == kFailed);
  CHECK(card.err.find("exists already; pass --force") != std::string::npos);
  CHECK(read_file(card.path("c.txt")) == before);
  std::vector<std::string> forced = words;
  forced.push_back("--force");
  CHECK(card.run(forced) == kDone);
}

TEST_CASE("viscard card explains every wrong use in one line", "[cards][cli]") {
  CardCommand card;
  const std::string material = card.save(reference_material());
  struct Row {
    std::vector<std::string> words;
    int status;
    const char* part;
  };
  const std::vector<Row> rows{
      {{material, "--for", "abacus"}, kBadWords, "did you mean 'abaqus'?"},
      {{material, "--for", "nastran"}, kBadWords, "frontistr"},
      {{material, "--for", "abaqus", "--units", "mm-kg"}, kBadWords, "mm-kg-ms"},
      {{material}, kBadWords, "--for TARGET is missing"},
      {{"--for", "abaqus"}, kBadWords, "no material given; usage: "},
      {{card.path("none.json"), "--for", "abaqus"}, kFailed, "cannot open"},
      {{material, "--for", "abaqus", "--terms", "1"}, kBadWords, "--approximate"},
      {{material, "--for", "abaqus", "--terms", "0", "--approximate"}, kBadWords, "1 to 100"},
      {{material, "--for", "abaqus", "--bound", "low"}, kBadWords, "lower"},
      {{material, "--for", "abaqus", "--bound", "lower"}, kFailed, "no intervals"},
      {{material, "--for", "abaqus", "--clamp-nu", "0.5"}, kBadWords, "(-1, 0.5)"},
      {{material, "--for", "lsdyna006"}, kFailed, "--approximate"},
      {{material, "--for", "json", "--deck", "creep", "--out", card.path("d")}, kFailed, "mfront"},
      {{material, "--for", "febio", "--deck", "creep"}, kBadWords, "--out FOLDER"},
      {{material, "--for", "abaqus", "--band", "1,10"}, kBadWords, "rayleigh"},
      {{material, "--for", "rayleigh", "--band", "10"}, kBadWords, "--band 10,1000"},
      {{material, "--for", "rayleigh", "--band", "10,1"}, kBadWords, "--band 10,1000"},
      {{"--prove", material, "--for", "abaqus"}, kBadWords, "--deck"},
      {{"--check", card.path("none.inp"), "--for", "abaqus"}, kFailed, "cannot open"},
      {{"--check", material, "--for", "abaqus"}, kFailed, "no *ELASTIC"},
      {{"--list", "--check", material}, kBadWords, "exclude"},
  };
  for (const Row& row : rows) {
    std::string line;
    for (const std::string& word : row.words) line += word + " ";
    CAPTURE(line);
    CHECK(card.run(row.words) == row.status);
    CAPTURE(card.err);
    CHECK(card.err.find(row.part) != std::string::npos);
    CHECK(card.err.find('\n') == std::string::npos);
    CHECK(card.out.empty());
  }
}

TEST_CASE("viscard card refuses by name every option that would change nothing", "[cards][cli]") {
  CardCommand card;
  const std::string material = card.save(reference_material()), law = card.path("law.json"),
                    linear = card.path("c.inp"), rubber = card.path("r.inp");
  write_file(law,
             R"({"schema": "viscard-hyperelastic/1", "law": "neo-hooke", "trustworthy": true,
"laws": [{"name": "neo-hooke", "parameters": [{"name": "C10_Pa", "value": 200000.0}], "terms": [],
"trustworthy": true, "flags": []}], "tests": [], "flags": []})",
             true);
  REQUIRE(card.run({material, "--for", "abaqus", "--out", linear}) == kDone);
  REQUIRE(card.run({law, "--for", "abaqus", "--out", rubber}) == kDone);
  struct Row {
    std::vector<std::string> words;
    const char* part;
  };
  for (const Row& row : std::vector<Row>{
           {{material, "--for", "abaqus", "--tolerance", "1e-3"},
            "--tolerance changes nothing here, it belongs to --check"},
           {{material, "--for", "abaqus", "--density", "1.1 g/cm3"},
            "--density is for laws of rubber"},
           {{material, "--check", linear, "--bulk-modulus", "2 GPa"},
            "--bulk-modulus is for laws of rubber"},
           {{law, "--check", rubber, "--bound", "lower"}, "--bound is for linear materials"},
           {{law, "--for", "abaqus", "--at-temperature", "37"},
            "--at-temperature is for linear materials"},
           {{law, "--for", "abaqus", "--extrapolate"}, "--extrapolate is for linear materials"},
           {{law, "--check", rubber, "--approximate"}, "--approximate changes nothing here"},
           {{material, "--check", linear, "--reproducible"},
            "belongs to writing a card, --deck, --import"},
           {{"--verify", linear, "--units", "SI"}, "--units changes nothing here"},
           {{material, "--for", "abaqus", "--material-name", "A"},
            "belongs to --check, --prove, --import"},
           {{"--check", linear, "--terms", "1"}, "--terms is for the comparison with a material"},
           {{"--check", linear, "--tolerance", "0.1"}, "none is named"},
           {{"--check", linear, "--ratio", "10"}, "none is named"},
           {{"--check", linear, "--at-temperature", "40"}, "none is named"},
           {{"--check", linear, "--bound", "lower"}, "none is named"},
           {{"--check", linear, "--clamp-nu", "0.4"}, "none is named"},
           {{"--check", linear, "--approximate"}, "none is named"},
           {{"--check", rubber, "--elastic-only", "long-term"}, "none is named"},
           {{"--prove", linear, "--bound", "lower"}, "none is named"},
           {{material, "--for", "abaqus", "--extrapolate"}, "without --ratio"},
           {{"--list", material}, "changes nothing here"},
           {{"--list", "--solver", "calculix"}, "--solver changes nothing here"},
           {{"--verify", linear, "--solver-path", "/x"}, "--solver-path changes nothing here"},
           {{material, "--for", "abaqus", "--long"}, "it belongs to --list"}}) {
    std::string line;
    for (const std::string& word : row.words) line += word + " ";
    CAPTURE(line);
    CHECK(card.run(row.words) == kBadWords);
    CHECK_THAT(card.err, Catch::Contains(row.part));
  }
}

TEST_CASE("viscard card --material-name chooses the material that is checked and imported",
          "[cards][cli]") {
  CardCommand card;
  const std::string sent = card.path("two.inp"), made = card.path("made.json");
  write_file(sent,
             "*Material, name=Foot\n*Elastic\n200., 0.3\n*Material, name=Gum\n"
             "*Hyperelastic, mooney-rivlin\n0.15, 0.02, 0.001\n",
             true);
  CHECK(card.run({"--check", sent, "--for", "abaqus", "--units", "mm-t-s"}) == kFailed);
  CHECK_THAT(card.out, Catch::Contains("choose one by --material-name"));
  CHECK(card.run({"--check", sent, "--for", "abaqus", "--units", "mm-t-s", "--material-name",
                  "Gum"}) == kDone);
  CHECK_THAT(card.out, Catch::Contains("mooney-rivlin"));
  CHECK(card.run({"--check", sent, "--for", "abaqus", "--units", "mm-t-s", "--material-name",
                  "Foot"}) == kDone);
  CHECK_THAT(card.out, Catch::Contains("E0 = 200000000 Pa") || Catch::Contains("2e+08"));
  CHECK(card.run({"--check", sent, "--for", "abaqus", "--material-name", "Sole"}) == kBadWords);
  CHECK_THAT(card.err, Catch::Contains("the file has Foot, Gum"));
  REQUIRE(card.run({sent, "--for", "abaqus", "--units", "mm-t-s", "--material-name", "Gum",
                    "--import", made}) == kDone);
  CHECK_THAT(card.out, Catch::Contains("a law of rubber, mooney-rivlin"));
}

TEST_CASE("viscard card --list shows every target, in words and as JSON", "[cards][cli]") {
  CardCommand card;
  CHECK(card.run({"--list"}) == kDone);
  for (const CardTarget& target : card_targets()) {
    CHECK(card.out.find("\n" + target.name + " ") != std::string::npos);
  }
  CHECK(card.run({"--list", "--json"}) == kDone);
  const auto json = nlohmann::json::parse(card.out);
  CHECK(json.at("targets").size() == card_targets().size());
  CHECK(json.at("units").size() == 6);
}

TEST_CASE("viscard card --band names the band of a card for vibration, which is checked over it",
          "[cards][cli]") {
  CardCommand card;
  const std::string material = card.save(reference_material()), out = card.path("rayleigh.txt");
  REQUIRE(card.run({material, "--for", "rayleigh", "--band", "0.1,10", "--out", out}) == kDone);
  CHECK(card.out.find("(read back)") != std::string::npos);
  CHECK(card.err.find("harmonic approximated: E' differs") != std::string::npos);
  CHECK(card.run({material, "--for", "rayleigh", "--check", out}) == kDone);
  CHECK(card.out.find("the card agrees") != std::string::npos);
  CHECK(card.run({material, "--for", "rayleigh", "--check", out, "--json"}) == kDone);
  const auto json = nlohmann::json::parse(card.out);
  CHECK(json.at("material").is_null());
  CHECK(json.at("values").at(1) == nlohmann::json{{"name", "nu"}, {"value", 0.495}});
  CHECK(json.at("understood").at("branches").is_null());  // it has none
  CHECK_THAT(json.at("understood").at("conventions").get<std::string>(),
             Catch::Contains("C = alpha M + beta K"));
  CHECK(json.at("frequencies_Hz") == nlohmann::json{0.1, 10.0});
  CHECK(card.run({material, "--for", "rayleigh", "--check", out, "--band", "1,10"}) == kFailed);
  CHECK(card.out.find("mistake band-differs") != std::string::npos);
  REQUIRE(card.run({material, "--for", "rayleigh", "--band", "10,1000", "--json"}) == kDone);
  CHECK_THAT(nlohmann::json::parse(card.out).at("warnings").at(0).get<std::string>(),
             Catch::Contains("EXTRAPOLATED"));
  CHECK(card.run({material, "--for", "rayleigh", "--band", "10,1000"}) == kDone);
  CHECK_THAT(card.err, Catch::Contains("warning: band: 10 to 1000 Hz; EXTRAPOLATED"));
  CHECK(card.run({material, "--for", "rayleigh", "--band", "1,10"}) == kDone);
  CHECK(card.out.find("\n# band: 1 to 10 Hz") != std::string::npos);
}

TEST_CASE("viscard card --approximate reduces, and the error it states holds", "[cards][cli]") {
  CardCommand card;
  Material thirty = material_of_terms(30, 0.4);
  thirty.valid = {1e-3, 1e6, 0.0};
  const std::string material = card.save(thirty);
  CHECK(card.run({material, "--for", "febio"}) == kFailed);
  CHECK(card.err.find("at most 6") != std::string::npos);
  REQUIRE(card.run({material, "--for", "febio", "--approximate", "--json"}) == kDone);
  const auto json = nlohmann::json::parse(card.out);
  CHECK(json.at("n_terms") == 6);
  CHECK(json.at("card").get<std::string>().find("30 refitted to 6") != std::string::npos);
  CHECK(card.run({material, "--for", "abaqus", "--approximate", "--terms", "4"}) == kDone);
  CHECK(card.out.find("30 refitted to 4") != std::string::npos);
}

TEST_CASE("viscard card --check exits 0 for a right card and 1 for a wrong one", "[cards][cli]") {
  CardCommand card;
  const std::string material = card.save(reference_material());
  const std::string path = card.path("c.feb");
  REQUIRE(card.run({material, "--for", "febio", "--units", "mm-t-s", "--out", path}) == kDone);
  CHECK(card.run({"--check", path, "--for", "febio", material}) == kDone);
  CHECK(card.out.find("agrees") != std::string::npos);
  std::string text = read_file(path);
  text.replace(text.find("<g0>0.977934</g0>"), 17, "");
  write_file(path, text, true);
  CHECK(card.run({"--check", path, "--for", "febio", material, "--json"}) == kFailed);
  const auto json = nlohmann::json::parse(card.out);
  CHECK(json.at("agrees") == false);
  bool is_named = false;
  for (const auto& finding : json.at("findings")) is_named |= finding.at("name") == "g0-left-at-1";
  CHECK(is_named);
}

TEST_CASE(
    "viscard card --check states no values of a card that describes no solid, and its verdict",
    "[cards][cli]") {
  CardCommand card;
  const std::string path = card.path("sent.inp");
  const auto checked = [&](const std::string& first_g) {
    write_file(path,
               "*MATERIAL, NAME=A\n*ELASTIC, MODULI=INSTANTANEOUS\n1.88e6, 0.495\n"
               "*VISCOELASTIC, TIME=PRONY\n" +
                   first_g + ", " + first_g + ", 0.2\n0.2, 0.2, 1.0\n",
               true);
    card.run({"--check", path, "--for", "abaqus"});
    const std::string text = card.out;
    card.run({"--check", path, "--for", "abaqus", "--json"});
    const auto json = nlohmann::json::parse(card.out);
    CHECK(text.find(json.at("verdict").get<std::string>()) != std::string::npos);
    CHECK((text.find("E0 =") != std::string::npos) == json.at("material").is_object());
    return json;
  };
  const auto wrong = checked("0.9");
  CHECK(wrong.at("verdict") == "the card is wrong");
  CHECK(wrong.at("material").is_null());
  const auto right = checked("0.3");
  CHECK(right.at("verdict") == "no mistake found");
  CHECK(right.at("material").at("rho_kg_m3") == 0.0);
}

TEST_CASE("viscard card --bound writes both ends of the intervals", "[cards][cli]") {
  CardCommand card;
  Material material = reference_material();
  MaterialUncertainty uncertainty;
  uncertainty.E0_Pa_95 = {1.8e6, 1.96e6};
  uncertainty.E_inf_Pa_95 = {1.75e6, 1.9e6};
  uncertainty.terms = {{1e3, 0.1, {1e4, 2e4}, {0.005, 0.01}, {0.1, 0.3}},
                       {1e3, 0.1, {2e4, 3e4}, {0.01, 0.02}, {2.0, 3.0}}};
  material.uncertainty = uncertainty;
  const auto moduli = [&](const char* bound) {
    REQUIRE(card.run({card.save(material), "--for", "abaqus", "--bound", bound, "--json"}) ==
            kDone);
    const auto json = nlohmann::json::parse(card.out);
    return std::pair(json.at("E0_Pa").get<double>(), json.at("E_inf_Pa").get<double>());
  };
  // Both ends to rounding: the card is written with all digits.
  const auto [E0_low, E_inf_low] = moduli("lower");
  CHECK(E0_low == Approx(1.8e6).epsilon(1e-12));
  CHECK(E_inf_low == Approx(1.75e6).epsilon(1e-12));
  const auto [E0_high, E_inf_high] = moduli("upper");
  CHECK(E0_high == Approx(1.96e6).epsilon(1e-12));
  CHECK(E_inf_high == Approx(1.9e6).epsilon(1e-12));
  // Terms keep their part of what relaxes.
  const std::string text = nlohmann::json::parse(card.out).at("card").get<std::string>();
  const double part = material.terms[0].g / (material.terms[0].g + material.terms[1].g);
  const ReadCard read = read_card(text, card_target("abaqus"), "");
  const double g_1 = read.material.terms[0].g, g_2 = read.material.terms[1].g;
  CHECK(g_1 / (g_1 + g_2) == Approx(part).epsilon(1e-12));

  // Ends that cross leave the shares as fitted; the systematic part widens both.
  material.uncertainty->E_inf_Pa_95 = {1.85e6, 1.87e6};
  material.uncertainty->systematic_relative = 0.01;
  const auto [E0, E_inf] = moduli("lower");
  const double half = std::hypot(material.E0_Pa - 1.8e6, 1.959963984540054 * 0.01 * material.E0_Pa);
  CHECK(E0 == Approx(material.E0_Pa - half).epsilon(1e-12));
  CHECK(E_inf == Approx(E0 * (1.0 - material.terms[0].g - material.terms[1].g)).epsilon(1e-12));
}

TEST_CASE("viscard card --deck writes a model that holds the card and the expected curve",
          "[cards][cli]") {
  CardCommand card;
  Material material = reference_material();
  for (const char* target : {"abaqus", "ansys", "lsdyna", "febio", "febio-uncoupled", "mfront",
                             "calculix", "openradioss", "comsol", "moose", "frontistr"}) {
    for (const char* kind : {"relaxation", "creep"}) {
      CAPTURE(target, kind);
      const std::string folder = card.path(std::string(target) + kind);
      REQUIRE(card.run({card.save(material), "--for", target, "--deck", kind, "--out", folder,
                        "--json"}) == kDone);
      const auto files = nlohmann::json::parse(card.out).at("files");
      CHECK(files.size() >= 2);
      const std::string curve = read_file(files.back().get<std::string>());
      CHECK(curve.find("time_s,") != std::string::npos);
      bool holds_card = false;  // its first relaxation time, rate or Norton law
      for (const auto& file : files) {
        const std::string text = read_file(file.get<std::string>());
        for (const char* number : {"0.1945", "5.1413", "LAW=NORTON"}) {
          holds_card |= text.find(number) != std::string::npos;
        }
      }
      CHECK(holds_card);
    }
  }
}

TEST_CASE("viscard card --prove names the terms that it exercised", "[cards][cli]") {
  if (std::system("command -v ccx >/dev/null 2>&1") != 0) {
    WARN("ccx is not installed; CalculiX is not run");
    return;
  }
  CardCommand command;
  Material material = reference_material();
  material.terms.push_back({1e-7, 1e-7, 0.7});  // too small to be seen
  const std::string file = command.save(material), card = command.path("c.inp");
  REQUIRE(command.run({file, "--for", "calculix", "--units", "mm-t-s", "--out", card}) == kDone);
  CHECK(command.run({file, "--prove", card, "--for", "calculix", "--json"}) == kFailed);
  const auto json = nlohmann::json::parse(command.out);
  CHECK(json.at("holds") == false);
  CHECK(json.at("relaxation").at("vanishes_with_step") == true);
  REQUIRE(json.at("terms").size() == 3);
  CHECK(json.at("terms")[0].at("exercised") == true);
  CHECK(json.at("terms")[2].at("exercised") == false);
  CHECK(json.at("divergence").is_null());
}

TEST_CASE("viscard card --help has an example, and --reproducible repeats itself", "[cards][cli]") {
  CardCommand card;
  CHECK(card.run({"--help"}) == kDone);
  CHECK(card.out.find("Example: viscard card ") != std::string::npos);
  const std::string material = card.save(reference_material());
  CHECK(card.run({material, "--for", "mfront", "--reproducible"}) == kDone);
  const std::string first = card.out;
  CHECK(card.run({"--reproducible", "--for", "mfront", material}) == kDone);
  CHECK(card.out == first);
}
