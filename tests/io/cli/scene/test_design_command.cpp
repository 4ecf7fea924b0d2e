#include "tests/io/scenes/scene_text.h"
#include "tests/support/run_command.h"

#include <nlohmann/json.hpp>

using namespace viscard;
using namespace viscard::test;

TEST_CASE("the design of the thesis' sensor is told with its limits", "[cli][design]") {
  const CommandOutcome outcome = run_command(
      {"design", "--diameter", "40 um", "--spacing", "60 um", "--length", "120 um", "--json"});
  REQUIRE(outcome.status == 0);
  const auto design = nlohmann::json::parse(outcome.out);
  CHECK(design["admissible"].get<bool>());
  // Square lattice: 4/pi 2.5^2; buckling at K = 1: 149.4 um; matting at gamma = .02: 434.4 um.
  CHECK(design["stress_concentration"].get<double>() == Approx(7.958).epsilon(1e-4));
  for (const auto& limit : design["limits"]) {
    if (limit["name"] == "buckling")
      CHECK(limit["limit"].get<double>() == Approx(149.4e-6).epsilon(1e-3));
    if (limit["name"] == "matting")
      CHECK(limit["limit"].get<double>() == Approx(434.4e-6).epsilon(1e-3));
  }
}

TEST_CASE("a design that cannot be is refused in one line", "[cli][design]") {
  struct Case {
    std::vector<std::string> words;
    const char* what;
  };
  const auto c = GENERATE(
      Case{{"--end-factor", "3"}, "end"}, Case{{"--end-factor", "0"}, "end"},
      Case{{"--diameter", "-1 um"}, "diameter"}, Case{{"--diameter", "40 kg"}, "--diameter"},
      Case{{"--poisson", "0.6"}, "Poisson"}, Case{{"--lattice", "sqare"}, "did you mean 'square'"},
      Case{{"--modulus", "0"}, "modulus"}, Case{{"--nonsense", "1"}, "nonsense"});
  CAPTURE(c.words[0], c.words[1]);
  std::vector<std::string> words = {"design"};
  words.insert(words.end(), c.words.begin(), c.words.end());
  const CommandOutcome outcome = run_command(words);
  CAPTURE(outcome.err);
  CHECK(outcome.status == 2);
  CHECK(outcome.out.empty());
  CHECK(outcome.err.find(c.what) != std::string::npos);
}
