// All commands from an emulated rig to the page, as a user types them, with a short test.
#include "io/basics/atomic_file.h"
#include "io/materials/material_file.h"
#include "tests/flow/flow_support.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>

using namespace viscard;
using namespace viscard::test;

namespace {

constexpr const char* kShortTest = R"(
name = "short relaxation test"
[approach]
speed = "0.05 mm/s"
baseline = "3 s"
[ramp]
depth = "0.13 mm"
duration = "1 s"
hold = "15 s"
[recovery]
hold = "8 s"
)";

std::string must_run(const std::vector<std::string>& words) {
  const CommandRun run = run_words(words);
  INFO(words[0] << ": " << run.err);
  REQUIRE(run.status == 0);
  return run.out;
}

}  // namespace

TEST_CASE("a capture becomes a card, a validated pillar and a page", "[flow][pty]") {
  const ScratchFolder folder;
  const std::string test_file = folder / "test.toml";
  write_file(test_file, kShortTest, false);
  const std::string capture = folder / "run.viscap";
  const std::string table = folder / "run.csv";
  const std::string material = folder / "material.json";
  const std::string page = folder / "report.html";

  must_run({"capture", "--emulate", "--test", test_file, "--specimen",
            demo_file("03_pdms_1to10.toml"), "--speed", "50", "--out", capture});
  must_run({"export", capture, "--out", table});
  const std::string fit_json = must_run({"fit", capture, "--out", material, "--json"});
  for (const char* target : {"abaqus", "ansys", "febio", "json"}) {
    // A hold of 15 s is short, so the fit may flag its slowest term. The card is written in any
    // case.
    must_run({"card", material, "--for", target, "--units", "mm-t-s", "--accept-flags", "--out",
              folder / (std::string("card.") + target)});
  }
  const std::string validation = must_run({"validate", material, "--json"});
  must_run({"report", capture, "--out", page});

  const auto fit = nlohmann::json::parse(fit_json);
  // The built-in emulated specimen is 1:10 with E0 = 1.88 MPa.
  CHECK(fit["E0_Pa"].get<double>() == Approx(1.88e6).epsilon(0.02));
  CHECK(fit["n_samples"].get<int>() > 80 * 15);
  const auto checked = nlohmann::json::parse(validation);
  CHECK(checked.is_object());
  const std::string csv = read_file(table);
  CHECK(std::count(csv.begin(), csv.end(), '\n') > 80 * 15);
  CHECK(read_file(folder / "card.abaqus").find("MODULI=INSTANTANEOUS") != std::string::npos);
  CHECK(read_file(page).find("<svg") != std::string::npos);
}

TEST_CASE("no file is overwritten without --force", "[flow][pty]") {
  const ScratchFolder folder;
  const std::string capture = folder / "run.viscap";
  write_file(capture, "somebody's data", false);
  const CommandRun run =
      run_words({"capture", "--emulate", "--test", demo_file("02_test.toml"), "--specimen",
                 demo_file("03_pdms_1to10.toml"), "--speed", "50", "--out", capture});
  CHECK(run.status == 1);
  CHECK(run.err.find("--force") != std::string::npos);
  CHECK(std::count(run.err.begin(), run.err.end(), '\n') == 1);
  CHECK(read_file(capture) == "somebody's data");
}
