#include "io/materials/material_file.h"
#include "tests/support/run_command.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

using namespace viscard;
using namespace viscard::test;
using Catch::Contains;

namespace {

// Six relaxation tables of a material with E0 = 20 MPa/ratio, g = .2, tau = 3 s; specimens differ
// by a few per cent.
struct Tables {
  std::vector<std::string> files, ratios;
};
Tables write_tables(const ScratchFolder& folder) {
  std::mt19937_64 dice(1);
  std::normal_distribution<double> normal;
  Tables out;
  for (const double ratio : {10.0, 13.0, 20.0}) {
    for (int k = 0; k < 2; ++k) {
      const double E0_Pa = 20e6 / ratio * std::exp(0.03 * normal(dice));
      const std::string file =
          (folder.path() / (std::to_string(out.files.size()) + ".csv")).string();
      std::ofstream table(file);
      table << "time_s,modulus_Pa\n";
      for (int i = 0; i <= 150; ++i) {
        const double t_s = 0.02 * std::pow(10.0, 4.0 * i / 150.0);
        table << t_s << "," << E0_Pa * (0.8 + 0.2 * std::exp(-t_s / 3.0) + 1e-3 * normal(dice))
              << "\n";
      }
      out.files.push_back(file);
      out.ratios.insert(out.ratios.end(), {"--ratio", std::to_string(ratio)});
    }
  }
  return out;
}

std::vector<std::string> joined(std::vector<std::string> words,
                                const std::vector<std::vector<std::string>>& more) {
  for (const auto& one : more) words.insert(words.end(), one.begin(), one.end());
  return words;
}

}  // namespace

TEST_CASE("a record given twice to a joint fit or a report is refused", "[cli][joint]") {
  const ScratchFolder folder;
  Tables tables = write_tables(folder);
  const std::string copy = (folder.path() / "copy.csv").string();
  std::filesystem::copy_file(tables.files[3], copy);
  const std::string again = GENERATE(std::string(), std::string("2.csv"), std::string("copy.csv"));
  CAPTURE(again);
  if (!again.empty()) {
    tables.files.push_back((folder.path() / again).string());
    tables.ratios.insert(tables.ratios.end(), {"--ratio", "13"});
  }
  const CommandOutcome fit = run_command(joined({"fit", "--joint"}, {tables.files, tables.ratios}));
  const std::string page = (folder.path() / "page.html").string();
  const CommandOutcome report = run_command(joined({"report"}, {tables.files, {"--out", page}}));
  if (again.empty()) {
    CHECK(fit.status == kDone);
    CHECK(report.status != kFailed);
    return;
  }
  const char* why = again == "2.csv" ? "2.csv is given twice" : "copy.csv has the same contents as";
  for (const CommandOutcome& outcome : {fit, report}) {
    CHECK(outcome.status == kFailed);
    CHECK_THAT(outcome.err, Contains(why) && Contains("counts once. Remove one of the two"));
  }
  CHECK_FALSE(std::filesystem::exists(page));
}

TEST_CASE(
    "tables of six specimens become a joint file, which gives cards for any ratio between them",
    "[cli][joint]") {
  const ScratchFolder folder;
  const Tables tables = write_tables(folder);
  const std::string joint = (folder.path() / "joint.json").string();
  const CommandOutcome ran = run_command(
      joined({"fit", "--joint"}, {tables.files, tables.ratios, {"--out", joint, "--json"}}));
  INFO(ran.err);
  REQUIRE(ran.status == kDone);
  const auto json = nlohmann::json::parse(ran.out);
  CHECK(json["schema"] == "viscard-joint/1");
  CHECK(json["materials"].size() == 3);
  CHECK(json["specimens"].size() == 6);

  SECTION("a ratio never measured, with its interval in the header") {
    const CommandOutcome card =
        run_command({"card", joint, "--ratio", "12.5", "--for", "json", "--units", "SI", "--json"});
    REQUIRE(card.status == kDone);
    // Spread .03 over six specimens: .012; three of these.
    CHECK(nlohmann::json::parse(card.out)["E0_Pa"].get<double>() ==
          Approx(20e6 / 12.5).epsilon(0.04));
    const CommandOutcome abaqus =
        run_command({"card", joint, "--ratio", "12.5", "--for", "abaqus"});
    REQUIRE(abaqus.status == kDone);
    CHECK_THAT(abaqus.out, Contains("** mixing ratio 12.5: interpolated by the law"));
    CHECK_THAT(abaqus.out, Contains("** 95 % intervals: E0 ["));
  }
  SECTION("the ends of the interval bracket the mean") {
    const auto E0_of = [&](const std::vector<std::string>& more) {
      const CommandOutcome card =
          run_command(joined({"card", joint, "--ratio", "15", "--for", "json", "--json"}, {more}));
      REQUIRE(card.status == kDone);
      return nlohmann::json::parse(card.out)["E0_Pa"].get<double>();
    };
    CHECK(E0_of({"--bound", "lower"}) < E0_of({}));
    CHECK(E0_of({"--bound", "upper"}) > E0_of({}));
  }
  SECTION("outside the measured range only when asked, and flagged in the header") {
    const std::vector<std::string> words{"card", joint, "--ratio", "25", "--for", "abaqus"};
    const CommandOutcome refused = run_command(words);
    CHECK(refused.status == kFailed);
    CHECK_THAT(refused.err, Contains("--extrapolate"));
    const CommandOutcome card = run_command(joined(words, {{"--extrapolate"}}));
    CHECK(card.status == kDone);
    CHECK_THAT(card.out, Contains("EXTRAPOLATED") && Contains("flag extrapolated-ratio"));
  }
  SECTION("a joint file needs a ratio") {
    const CommandOutcome none = run_command({"card", joint, "--for", "abaqus"});
    CHECK(none.status == kBadWords);
    CHECK_THAT(none.err, Contains("--ratio R (10, 13, 20 were measured"));
  }
  SECTION("the file reads back to the same law") {
    const RatioFit fit = read_ratio_fit(joint);
    CHECK(json_from_ratio_fit(fit) == ran.out);
  }
}

TEST_CASE("a wrong command line of a joint fit gives one clear line", "[cli][joint]") {
  const ScratchFolder folder;
  const Tables tables = write_tables(folder);
  const auto err_of = [](const std::vector<std::string>& words) {
    const CommandOutcome ran = run_command(words);
    CHECK(ran.status != kDone);
    CHECK(std::count(ran.err.begin(), ran.err.end(), '\n') == 1);
    return ran.err;
  };
  CHECK_THAT(err_of(joined({"fit", "--joint"}, {tables.files, {"--ratio", "10"}})),
             Contains("one for each file"));
  CHECK_THAT(err_of(joined({"fit", "--joint"}, {tables.files})), Contains("has no mixing ratio"));
  CHECK_THAT(err_of(joined({"fit", "--joint"}, {tables.files, tables.ratios, {"--share", "nu"}})),
             Contains("--share nu is not known"));
  CHECK_THAT(err_of({"fit", tables.files[0], "--share", "tau"}), Contains("--joint"));
}
