// viscard cost --rig and viscard fit --want: which test to make, and what to measure next.
#include "io/basics/atomic_file.h"
#include "io/capture/capture_file.h"
#include "io/config/config_file.h"
#include "io/config/performance_file.h"
#include "io/flow/planning/plan_tests.h"
#include "tests/support/in_memory_run.h"
#include "tests/support/run_command.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <fstream>
#include <string>
#include <vector>

using namespace viscard;
using namespace viscard::test;

namespace {

std::string demo_file(const std::string& name) {
  return std::string(VISCARD_SOURCE_DIR) + "/data/demo/" + name;
}

std::vector<std::string> cost_words(const std::vector<std::string>& more) {
  std::vector<std::string> words{
      "cost",      "--rig", demo_file("01_rig.toml"), "--specimen", demo_file("03_pdms_1to10.toml"),
      "--at-most", "75s"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

}  // namespace

TEST_CASE("a wish is a quantity and a tolerance", "[io]") {
  const WantedQuantity g_2 = wanted_from_text("g_2=5%");
  CHECK(g_2.name == "g_2");
  CHECK(g_2.tolerance == Approx(0.05));
  CHECK(wanted_from_text("E0=0.01").tolerance == Approx(0.01));
  for (const char* text : {"E0", "=5%", "E0=", "E0=0%", "E0=200%", "E0=5 mm"}) {
    CAPTURE(text);
    CHECK_THROWS_AS(wanted_from_text(text), std::invalid_argument);
  }
}

TEST_CASE("budgets of a scene, and no time at all, are refused for tests at a rig", "[cli]") {
  const CommandOutcome budget = run_command(cost_words({"--want", "E0=1%", "--budget", "5s"}));
  CHECK(budget.status == kBadWords);
  CHECK_THAT(budget.err, Catch::Contains("--budget is for a scene"));
  CHECK(run_command(cost_words({"--want", "E0=1%", "--cpu-budget", "5s"})).status == kBadWords);
  for (const char* time : {"0s", "-1s"}) {
    const CommandOutcome none = run_command({"cost", "--rig", demo_file("01_rig.toml"),
                                             "--specimen", demo_file("03_pdms_1to10.toml"),
                                             "--want", "E0=1%", std::string("--at-most=") + time});
    CHECK(none.status == kBadWords);
    CHECK_THAT(none.err, Catch::Contains("--at-most must be positive"));
  }
}

TEST_CASE("the performance of a rig is read from its file and is no part of a capture", "[io]") {
  const RigPerformance performance = read_performance(demo_file("01_rig.toml"));
  CHECK(performance.noise_N == Approx(0.05e-3 * 9.80665));
  CHECK(performance.gain_drift_1_s == 1e-6);
  CHECK(performance.step_m == Approx(0.3125e-6));
  CHECK(toml_from_rig(read_rig(demo_file("01_rig.toml"))).find("performance") == std::string::npos);
  const std::string rig =
      "[calibration]\nvolts_per_newton = 0.7\ncapacity = \"250 gf\"\n[frame]\nstiffness = 1e4\n";
  CHECK(performance_from_toml(rig, "rig.toml").noise_N == 0.0);
  CHECK_THROWS_WITH(rig_from_toml(rig + "[performance]\nnoize = 1\n", "rig.toml"),
                    Catch::Contains("rig.toml:7") && Catch::Contains("noise"));
}

TEST_CASE("viscard cost --rig writes the test to use, which reads back", "[cli]") {
  const ScratchFolder folder;
  const std::string out = (folder / "cost").string();
  const CommandOutcome outcome =
      run_command(cost_words({"--want", "E0=1%", "--want", "g_2=20%", "--test",
                              demo_file("02_test.toml"), "--json", "--out", out}));
  CAPTURE(outcome.err);
  REQUIRE(outcome.status == 0);
  const auto study = nlohmann::json::parse(outcome.out);
  CHECK(study["inputs"].size() == 3);
  CHECK(study["wanted"][0]["beyond_reach"].get<bool>());  // 2 % of the frame is more than 5 % of E0
  CHECK_FALSE(study["wanted"][1]["beyond_reach"].get<bool>());
  REQUIRE(study["recommended"].is_number());
  const auto& row = study["rows"][study["recommended"].get<std::size_t>()];
  CHECK(row["time_s"].get<double>() <= 75.0);
  CHECK(row["errors"][1]["half_width_95"].get<double>() <= 0.20);
  const TestPlan plan = read_test(out + "/test.toml");
  CHECK(plan.hold_s == row["hold_s"].get<double>());
  CHECK(plan.depth_m == Approx(row["depth_m"].get<double>()));
  CHECK(plan.approach_speed_m_s == read_test(demo_file("02_test.toml")).approach_speed_m_s);
  for (const char* name : {"cost.csv", "cost.json", "cost.svg"}) {
    CHECK(std::ifstream(out + "/" + name).good());
  }
}

TEST_CASE("results of a scene have the errors of the moduli that they follow", "[cli]") {
  const ScratchFolder folder;
  const std::string scene = (folder / "scene.toml").string();
  write_file(scene,
             "tolerance = 1e-2\n[geometry]\ndiameter = \"40 um\"\nlength = \"120 um\"\n"
             "[materials]\npillar = { E = \"1.8 MPa\", nu = 0.33 }\n"
             "[analysis]\nkind = \"static\"\nload = { pressure = \"10 kPa\", on = \"top\" }\n",
             false);
  const CommandOutcome outcome = run_command(cost_words(
      {"--scene", scene, "--want", "top_displacement=50%", "--want", "E0=50%", "--json"}));
  CAPTURE(outcome.err);
  REQUIRE(outcome.status == 0);
  const auto study = nlohmann::json::parse(outcome.out);
  // A static load presses on E0, and the displacement is inversely proportional to it.
  for (const auto& row : study["rows"]) {
    const double E0 = row["errors"][1]["half_width_95"].get<double>();
    CHECK(row["errors"][0]["half_width_95"].get<double>() == Approx(E0).epsilon(0.02));
  }
  const CommandOutcome unknown =
      run_command(cost_words({"--scene", scene, "--want", "voltage=5%"}));
  CHECK(unknown.err.find("top_displacement") != std::string::npos);
}

TEST_CASE("viscard cost --rig refuses what it cannot use, and reports why", "[cli]") {
  CHECK(run_command(cost_words({})).status == 2);
  CHECK(run_command(cost_words({"--want", "E0"})).status == 2);
  const CommandOutcome idle = run_command({"cost", "no.toml", "--want", "E0=1%"});
  CHECK(idle.status == 2);
  CHECK_THAT(idle.err, Catch::Contains("--want has no effect without --rig"));
  CHECK(run_command({"cost", "--rig", demo_file("01_rig.toml"), "--want", "E0=1%"}).status == 2);
  const CommandOutcome unknown = run_command(cost_words({"--want", "Young=1%"}));
  CHECK(unknown.status != 0);
  CHECK(unknown.err.find("known are E0") != std::string::npos);
  CHECK_THAT(run_command(cost_words({"--want", "voltage=5%"})).err,
             Catch::Contains("needs the scene as well"));
  const std::string sensor = VISCARD_SOURCE_DIR "/data/scenes/pillar_sensor.toml";
  CHECK_THAT(run_command(cost_words({"--scene", sensor, "--want", "E0=1%"})).err,
             Catch::Contains("pillar_sensor.toml has no effect"));
  // Nothing is written if no test fits into the time.
  const ScratchFolder none;
  const CommandOutcome brief = run_command({"cost", "--rig", demo_file("01_rig.toml"), "--specimen",
                                            demo_file("03_pdms_1to10.toml"), "--want", "E0=1%",
                                            "--at-most", "1s", "--out", none / "o"});
  CHECK(brief.status == 1);
  CHECK_THAT(brief.err, Catch::Contains("no test fits into 1 s; the shortest takes"));
  CHECK_FALSE(std::filesystem::exists(none / "o"));
  // Without the noise of the rig nothing can be said.
  const ScratchFolder folder;
  std::string rig = read_file(demo_file("01_rig.toml"));
  rig.replace(rig.find("noise ="), 1, "#");
  const std::string quiet = (folder / "rig.toml").string();
  write_file(quiet, rig, false);
  const CommandOutcome silent = run_command(
      {"cost", "--rig", quiet, "--specimen", demo_file("03_pdms_1to10.toml"), "--want", "E0=1%"});
  CHECK(silent.status == 1);
  CHECK(silent.err.find("[performance]") != std::string::npos);
}

// An advice is worth what happens to the person who takes it.
TEST_CASE("the time that viscard cost --rig names as the shortest is enough", "[cli]") {
  struct Setting {
    const char* handling;  // of the rig; whole and broken seconds, and more than a thousand
    const char* specimen;
  };
  const auto setting =
      GENERATE(Setting{"0 s", "03_pdms_1to10.toml"}, Setting{"7.313 s", "05_pdms_1to20.toml"},
               Setting{"1234.56 s", "04_pdms_1to13.toml"});
  CAPTURE(setting.handling, setting.specimen);
  const ScratchFolder folder;
  std::string rig = read_file(demo_file("01_rig.toml"));
  const std::string handling = "handling = \"0 s\"";
  REQUIRE(rig.find(handling) != std::string::npos);
  rig.replace(rig.find(handling), handling.size(),
              std::string("handling = \"") + setting.handling + "\"");
  const std::string file = (folder / "rig.toml").string();
  write_file(file, rig, false);
  const auto within = [&](const std::string& time) {
    return run_command({"cost", "--rig", file, "--specimen", demo_file(setting.specimen), "--want",
                        "g_2=20%", "--at-most", time, "--json"});
  };
  const CommandOutcome brief = within("1s");
  REQUIRE(brief.status == 1);
  const std::string before = "the shortest takes ";
  const std::size_t begin = brief.err.find(before);
  REQUIRE(begin != std::string::npos);
  const std::size_t time = begin + before.size();
  const std::string advised = brief.err.substr(time, brief.err.find(" at the rig", time) - time);
  CAPTURE(advised);
  const CommandOutcome allowed = within(advised);
  CAPTURE(allowed.err);
  REQUIRE(allowed.status == 0);
  const auto study = nlohmann::json::parse(allowed.out);
  REQUIRE(study["recommended"].is_number());
  const auto& row = study["rows"][study["recommended"].get<std::size_t>()];
  const double advised_s = std::stod(advised);
  CHECK(row["time_s"].get<double>() <= advised_s);
  CHECK(row["time_s"].get<double>() > advised_s - 1.0);  // and no more than is needed
}

TEST_CASE("viscard fit --want reports what to measure next", "[cli]") {
  const ScratchFolder folder;
  const std::string file = (folder / "run.viscap").string();
  {
    const CapturedRun run = in_memory_run(demo_truth(10, 7), {});
    CaptureWriter writer(file, run);
    for (const LoadSample& sample : run.load_samples) writer.append(sample);
    for (const CommandedMove& move : run.moves) writer.append(move);
    writer.finish("finished");
  }
  const CommandOutcome printed = run_command({"fit", file, "--want", "E0=1%"});
  CAPTURE(printed.err);
  CHECK(printed.out.find(
            "next: most for a minute at the rig gives knowing the frame's stiffness to 1 %") !=
        std::string::npos);
  const CommandOutcome outcome = run_command({"fit", file, "--want", "E0=1%", "--json"});
  const auto fit = nlohmann::json::parse(outcome.out);
  const auto& best = fit["next"]["measurements"][0];
  CHECK(best["half_width_95_after"].get<double>() ==
        Approx(0.5 * best["half_width_95"].get<double>()).epsilon(0.01));
  CHECK(run_command({"fit", file, "--want", "E0"}).status == 2);
  CHECK(run_command({"fit", demo_file("example_relaxation.csv"), "--want", "E0=1%"}).status == 2);
}
