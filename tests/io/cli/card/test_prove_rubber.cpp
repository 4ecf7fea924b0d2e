// viscard card --prove of cards of rubber on the command line.
#include "tests/io/cli/fit/table_folder.h"
#include "tests/support/run_command.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <fstream>
#include <sstream>

using namespace viscard::test;
using Catch::Contains;

namespace {

std::string text_in(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

// The file of a Mooney-Rivlin rubber that was fitted up to a stretch of 2.
std::string fitted_mooney(const TableFolder& folder) {
  std::ostringstream table;
  table.precision(12);
  table << "stretch,nominal_stress_Pa\n";
  for (int i = 1; i <= 40; ++i) {
    const double s = 1.0 + 0.025 * i;
    table << s << "," << 2.0 * (s - 1.0 / (s * s)) * (1.5e5 + 4e4 / s) << "\n";
  }
  std::string out = folder.file("rubber.json");
  REQUIRE(run_command({"fit", "uniaxial=" + folder.write("pull.csv", table.str()), "--model",
                       "mooney-rivlin", "--out", out})
              .status == 0);
  return out;
}

}  // namespace

TEST_CASE("card --prove runs a card of rubber in CalculiX, and its certificate says what held",
          "[cli]") {
  const TableFolder folder;
  const std::string law = fitted_mooney(folder), card = folder.file("rubber.inp");
  REQUIRE(
      run_command({"card", law, "--for", "calculix", "--units", "mm-t-s", "--out", card}).status ==
      0);
  const auto run = run_command({"card", law, "--prove", card});
  INFO(run.err);
  CHECK(run.status == 0);
  CHECK_THAT(run.out, Contains("CalculiX") && Contains("uniaxial     to a stretch of 2, ") &&
                          Contains("the card holds") && Contains("bulk modulus = "));
  const auto proof = nlohmann::json::parse(text_in(card + ".calculix.proof.json"));
  CHECK(proof["holds"] == true);
  CHECK(proof["ran_text"] == true);
  CHECK(proof["cubes"].size() == 4);
  CHECK(proof["numbers_hold"] == true);
  CHECK(proof["chain"]["complete"] == true);
  CHECK(proof["cubes"][0]["error"].get<double>() < 3e-6);
  CHECK(proof["chain"]["raw_files"][0]["file"].get<std::string>().find("pull.csv") !=
        std::string::npos);
  CHECK_THAT(proof["models"][0]["text"].get<std::string>(), Contains("*HYPERELASTIC"));
  // Every step of the chain is noticed: the table, the law, the card, the certificate.
  const std::string certificate = card + ".calculix.proof.json";
  CHECK(run_command({"card", "--verify", card}).status == 0);
  CHECK(run_command({"card", "--verify", certificate}).status == 0);
  for (const auto& [path, words] : std::vector<std::pair<std::string, std::string>>{
           {folder.file("pull.csv"), "pull.csv has changed"},
           {law, "rubber.json has changed"},
           {card, "the card has been edited"},
           {certificate, "the certificate has been edited"}}) {
    CAPTURE(path);
    const std::string right = text_in(path);
    std::string edited = right;
    const std::size_t digit = edited.find_last_of("123456789");
    edited[digit] = edited[digit] == '9' ? '8' : static_cast<char>(edited[digit] + 1);
    std::ofstream(path) << edited;
    const auto broken = run_command({"card", "--verify", certificate});
    CHECK(broken.status == 1);
    CHECK_THAT(broken.out, Contains(words));
    CHECK(run_command({"card", "--verify", card}).status == (path == certificate ? 0 : 1));
    std::ofstream(path) << right;
  }
  // The same certificate is not replaced, and a wrong card does not hold.
  CHECK_THAT(run_command({"card", law, "--prove", card}).err, Contains("exists"));
  std::string text = text_in(card);
  const std::size_t at = text.find("MOONEY-RIVLIN\n") + 14;
  text.replace(at, text.find(',', at) - at, "0.151");
  const auto wrong = run_command({"card", law, "--prove", folder.write("wrong.inp", text)});
  CHECK(wrong.status == 1);
  CHECK_THAT(wrong.out, Contains("the card does not hold"));
}

TEST_CASE("card --prove of a card of rubber without its solver says which one runs the numbers",
          "[cli]") {
  const TableFolder folder;
  const std::string law = fitted_mooney(folder), card = folder.file("rubber.inp");
  REQUIRE(run_command({"card", law, "--for", "abaqus", "--out", card}).status == 0);
  const auto error_of = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"card", law, "--prove", card};
    words.insert(words.end(), more.begin(), more.end());
    const auto run = run_command(words);
    CHECK(run.status == 2);
    return run.err;
  };
  CHECK_THAT(error_of({}), Contains("no solver that reads cards of rubber for abaqus") &&
                               Contains("--solver sfepy"));
  CHECK_THAT(error_of({"--solver", "calculix"}),
             Contains("--solver calculix does not read cards of rubber for abaqus"));
  CHECK_THAT(error_of({"--solver", "febio"}),
             Contains("--solver febio does not read cards of rubber for abaqus"));
  CHECK_THAT(error_of({"--solver", "frontistr"}),
             Contains("--solver frontistr runs no cards of rubber"));
}

TEST_CASE("card --check and --prove of a linear card against a law of rubber name both", "[cli]") {
  const TableFolder folder;
  const std::string law = fitted_mooney(folder), card = folder.file("linear.inp");
  const std::string linear = VISCARD_SOURCE_DIR "/data/materials/pdms_1to10_seed.json";
  REQUIRE(run_command({"card", linear, "--for", "abaqus", "--out", card}).status == 0);
  for (const char* option : {"--check", "--prove"}) {
    const auto run = run_command({"card", law, option, card});
    CHECK(run.status == 2);
    CHECK_THAT(run.err, Contains("is a card of a linear material (abaqus)") &&
                            Contains("is a law of rubber"));
  }
}
