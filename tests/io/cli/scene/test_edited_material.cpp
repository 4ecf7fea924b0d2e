// Materials that were edited by hand, in whatever is computed with them; what a command prints when it is stopped.
#include "io/basics/atomic_file.h"
#include "io/cli/words/stop_on_signal.h"
#include "tests/support/run_command.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>

using namespace viscard;
using namespace viscard::test;
using Catch::Matchers::Contains;

TEST_CASE("an edited material is named by every command that computes with it", "[cli][scene]") {
  const ScratchFolder scratch;
  const std::string material = (scratch / "m.json").string();
  const CommandOutcome fit = run_command(
      {"fit", VISCARD_SOURCE_DIR "/data/demo/example_relaxation.csv", "--out", material});
  REQUIRE(fit.status == 0);
  write_file(scratch / "scene.toml", R"(tolerance = 1e-2
[geometry]
diameter = "40 um"
length = "120 um"
[materials]
pillar = { file = "m.json" }
[analysis]
kind = "static"
load = { pressure = "1 kPa", on = "top" }
)",
             false);
  write_file(
      scratch / "study.toml",
      "scene = \"scene.toml\"\n[[parameter]]\nkey = \"geometry.diameter\"\nvalues = [\"40 um\"]\n",
      false);
  const std::string scene = (scratch / "scene.toml").string(),
                    study = (scratch / "study.toml").string(),
                    store = (scratch / "store.sqlite").string();
  const std::vector<std::vector<std::string>> all = {
      {"simulate", scene},
      {"simulate", scene, "--json"},
      {"cost", scene, "--budget", "2s"},
      {"cost", scene, "--budget", "2s", "--json"},
      {"sweep", study, "--out", store, "--json"},
      {"plan", scene, "--json"},
      {"predict", material, "--test", "creep", "--stress", "1kPa", "--hold", "1s", "--json"},
      {"validate", material},
      {"validate", material, "--json"}};
  const char* const kWords = "edited since it was written";
  for (const auto& words : all) {
    CAPTURE(words);
    CHECK_THAT(run_command(words).out, !Contains(kWords));
  }
  std::string text = read_file(material);
  const std::size_t at = text.find("\"E0_Pa\":");
  REQUIRE(at != std::string::npos);
  text.insert(text.find_first_of("0123456789", at + 8), "1");
  write_file(material, text, true);
  std::filesystem::remove(store);
  for (const auto& words : all) {
    CAPTURE(words);
    CHECK_THAT(run_command(words).out, Contains(kWords));
  }
  // So does a table that is written, a joint fit and a card of a ratio.
  const std::string csv = (scratch / "p.csv").string(), joint = (scratch / "joint.json").string();
  REQUIRE(run_command({"predict", material, "--test", "creep", "--stress", "1kPa", "--hold", "1s",
                       "--csv", csv})
              .status == 0);
  CHECK_THAT(read_file(csv), Contains("\n# note: " + material + ": the file was edited"));
  std::vector<std::string> words = {"fit", "--joint", material};
  for (const double E_Pa : {8.801e6, 4.370e6}) {
    std::string table = "time_s,modulus_Pa\n";
    for (int k = 1; k <= 300; ++k) {
      const double t_s = 0.05 * k;
      const double value_Pa =
          E_Pa * (0.97 + 0.03 * std::exp(-t_s / 2.0) + 1e-4 * std::sin(7.0 * k));
      table += std::to_string(t_s) + "," + std::to_string(value_Pa) + "\n";
    }
    const std::string file = (scratch / (std::to_string(words.size()) + ".csv")).string();
    write_file(file, table, false);
    words.push_back(file);
  }
  words.insert(words.end(), {"--ratio", "10", "--ratio", "13", "--ratio", "20", "--out", joint});
  const CommandOutcome joined = run_command(words);
  INFO(joined.err);
  REQUIRE(joined.status == 0);
  CHECK_THAT(read_file(joint), Contains(kWords));
  CHECK_THAT(run_command({"card", joint, "--ratio", "12", "--for", "abaqus", "--units", "SI"}).out,
             Contains(kWords));
  const std::string page = (scratch / "page.html").string();
  run_command({"report", material, "--out", page});
  CHECK_THAT(read_file(page), Contains("<li>" + material + ": the file was edited"));
  // A card carries it, and what a card becomes again.
  const std::string card = (scratch / "card.inp").string(), back = (scratch / "back.json").string();
  REQUIRE(run_command({"card", material, "--for", "abaqus", "--units", "mm-t-s", "--out", card})
              .status == 0);
  REQUIRE(run_command({"card", card, "--import", back, "--for", "abaqus"}).status == 0);
  CHECK_THAT(read_file(back), Contains(kWords));
}

TEST_CASE("a material whose sum was taken away is noted, and is not if it was typed", "[cli]") {
  const ScratchFolder scratch;
  const std::string material = (scratch / "m.json").string();
  REQUIRE(run_command(
              {"fit", VISCARD_SOURCE_DIR "/data/demo/example_relaxation.csv", "--out", material})
              .status == 0);
  const std::vector<std::string> words = {"predict",  material, "--test", "creep",
                                          "--stress", "1kPa",   "--hold", "1s"};
  const auto is_noted = Contains("m.json: has no sum of its contents");
  CHECK_THAT(run_command(words).err, !is_noted);
  std::string text = read_file(material);
  const std::size_t at = text.find("\"body_sha256\"");
  REQUIRE(at != std::string::npos);
  const std::size_t comma = text.rfind(',', at), end = text.find('\n', at);
  text.erase(comma, end - comma);
  write_file(material, text, true);
  CHECK_THAT(run_command(words).err, is_noted);
  text.replace(text.find("\"created_by\": \"viscard"), 23, "\"created_by\": \"typed");
  write_file(material, text, true);
  CHECK_THAT(run_command(words).err, !is_noted);
}

TEST_CASE(
    "a joint fit or a law of rubber whose sum was taken away is noted, and a typed law is not",
    "[cli]") {
  const ScratchFolder scratch;
  const std::string law = (scratch / "law.json").string(),
                    joint = (scratch / "joint.json").string();
  write_file(scratch / "u.csv",
             "stretch,stress_Pa\n1,0\n1.1,110000\n1.2,203000\n1.4,356000\n1.6,484000\n"
             "1.8,597000\n2,700000\n",
             false);
  REQUIRE(run_command({"fit", "uniaxial=" + (scratch / "u.csv").string(), "--model", "neo-hooke",
                       "--out", law})
              .status == 0);
  std::vector<std::string> fit = {"fit", "--joint", "--ratio", "10",    "--ratio",
                                  "13",  "--ratio", "20",      "--out", joint};
  for (const double E_Pa : {1.9e6, 1.4e6, 0.9e6}) {
    std::string table = "time_s,modulus_Pa\n";
    for (int k = 1; k <= 300; ++k) {
      const double t_s = 0.05 * k;
      table +=
          std::to_string(t_s) + "," +
          std::to_string(E_Pa * (0.97 + 0.03 * std::exp(-t_s / 2.0) + 1e-4 * std::sin(7.0 * k))) +
          "\n";
    }
    fit.push_back((scratch / (std::to_string(E_Pa) + ".csv")).string());
    write_file(fit.back(), table, false);
  }
  REQUIRE(run_command(fit).status == 0);
  const auto is_noted = Contains("has no sum of its contents");
  const auto card_of = [](const std::string& file, const std::vector<std::string>& more) {
    std::vector<std::string> words = {"card", file, "--for", "abaqus", "--units", "SI"};
    words.insert(words.end(), more.begin(), more.end());
    const CommandOutcome card = run_command(words);
    INFO(card.err);
    CHECK(card.status == 0);
    return card.err;
  };
  for (const auto& [file, more] : {std::pair{law, std::vector<std::string>{}},
                                   std::pair{joint, std::vector<std::string>{"--ratio", "12"}}}) {
    CAPTURE(file);
    CHECK_THAT(card_of(file, more), !is_noted);
    std::string text = read_file(file);
    const std::size_t at = text.find("\"body_sha256\"");
    REQUIRE(at != std::string::npos);
    const std::size_t comma = text.rfind(',', at);
    text.erase(comma, text.find('\n', at) - comma);
    write_file(file, text, true);
    CHECK_THAT(card_of(file, more), is_noted);
  }
  write_file(law,
             R"({"schema": "viscard-hyperelastic/1", "law": "neo-hooke", "trustworthy": true,
"laws": [{"name": "neo-hooke", "parameters": [{"name": "C10_Pa", "value": 200000.0}],
"trustworthy": true, "flags": []}], "tests": [], "flags": []})",
             true);
  CHECK_THAT(card_of(law, {}), !is_noted);
}

TEST_CASE("a command that is stopped prints how to go on before it ends", "[cli]") {
  std::array<int, 2> pipe_ends{};
  REQUIRE(::pipe(pipe_ends.data()) == 0);
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    ::dup2(pipe_ends[1], STDERR_FILENO);
    const WordsOnSignal words("the same command goes on");
    ::raise(SIGINT);
    ::_exit(0);
  }
  ::close(pipe_ends[1]);
  int status = 0;
  ::waitpid(child, &status, 0);
  std::array<char, 256> buffer{};
  const ssize_t n = ::read(pipe_ends[0], buffer.data(), buffer.size());
  ::close(pipe_ends[0]);
  CHECK(WIFSIGNALED(status));
  CHECK(WTERMSIG(status) == SIGINT);
  CHECK_THAT(std::string(buffer.data(), static_cast<std::size_t>(std::max<ssize_t>(0, n))),
             Contains("viscard: the same command goes on"));
}
