// What is written with --strip-paths.
#include "io/basics/atomic_file.h"
#include "io/basics/written_path.h"
#include "tests/support/run_command.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>

using namespace viscard;
using namespace viscard::test;
using Catch::Matchers::Contains;

TEST_CASE("with --strip-paths no file states a folder of this computer", "[cli]") {
  const ScratchFolder scratch;
  const std::string folder = (scratch / "home/miller").string();
  std::filesystem::create_directories(folder);
  const std::string table = folder + "/curve.csv", material = folder + "/m.json",
                    card = folder + "/card.inp", page = folder + "/page.html";
  write_file(table, read_file(VISCARD_SOURCE_DIR "/data/demo/example_relaxation.csv"), false);
  const auto run = [](std::vector<std::string> words) {
    words.emplace_back("--strip-paths");
    const CommandOutcome outcome = run_command(words);
    CAPTURE(words, outcome.err);
    REQUIRE(outcome.status == 0);
    return outcome;
  };
  const CommandOutcome fit = run({"fit", table, "--out", material, "--json"});
  CHECK_THAT(fit.out, !Contains("miller"));
  run({"card", material, "--for", "abaqus", "--units", "mm-t-s", "--out", card});
  run({"report", table, "--out", page});
  for (const std::string& file : {material, card, page}) {
    CAPTURE(file);
    CHECK_THAT(read_file(file), !Contains("miller"));
  }
  CHECK_THAT(read_file(material), Contains("curve.csv"));
  run_command({"fit", table, "--out", material, "--force"});  // and without it, as before
  CHECK_THAT(read_file(material), Contains("miller"));
}

TEST_CASE("cards and laws of rubber of materials with folders are stripped, too", "[cli]") {
  const ScratchFolder scratch;
  const std::string folder = (scratch / "home/miller").string();
  std::filesystem::create_directories(folder);
  const std::string table = folder + "/uniaxial.csv", law = folder + "/law.json",
                    card = folder + "/card.inp";
  write_file(table, read_file(VISCARD_SOURCE_DIR "/data/reference/treloar_uniaxial.csv"), false);
  const CommandOutcome fit =
      run_command({"fit", "uniaxial=" + table, "--model", "yeoh", "--out", law, "--strip-paths"});
  CAPTURE(fit.err);
  CHECK_THAT(read_file(law), !Contains("miller"));
  run_command({"fit", "uniaxial=" + table, "--model", "yeoh", "--out", law, "--force"});
  const CommandOutcome written =
      run_command({"card", law, "--for", "abaqus", "--units", "mm-t-s", "--bulk-modulus", "1 GPa",
                   "--accept-flags", "--out", card, "--strip-paths"});
  CAPTURE(written.err);
  CHECK_THAT(read_file(card), !Contains("miller"));
}

TEST_CASE("only absolute paths are cut, in words too", "[cli]") {
  strip_written_paths(true);
  CHECK(written_path("/home/a/b.csv") == "b.csv");
  CHECK(written_path("/home/a/") == "a");
  CHECK(written_path("/") == "/");
  CHECK(written_path("data/b.csv") == "data/b.csv");
  CHECK(written_word("--out=/home/a/b.json") == "--out=b.json");
  CHECK(written_word("modulus_Pa=1e6*E/2") == "modulus_Pa=1e6*E/2");
  strip_written_paths(false);
  CHECK(written_path("/home/a/b.csv") == "/home/a/b.csv");
}
