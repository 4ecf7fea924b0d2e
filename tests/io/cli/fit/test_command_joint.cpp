#include "io/materials/material_file.h"
#include "tests/support/run_command.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <sstream>

using namespace viscard;
using namespace viscard::test;
using Catch::Contains;

namespace {

// The file reads back to the same law; what --json prints is the file without its sum, the version and the inputs.
void check_read_back(const std::string& joint, const std::string& printed) {
  std::ifstream file(joint);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  CHECK(json_from_ratio_fit(read_ratio_fit(joint)) == text);
  nlohmann::json object = nlohmann::json::parse(printed);
  CHECK(object.erase("version") == 1);
  CHECK(object.erase("inputs") == 1);
  CHECK(object.erase("input_files") == 1);
  nlohmann::json written = nlohmann::json::parse(text);
  CHECK(written.erase("body_sha256") == 1);  // the sum of the file; what is printed has other keys
  CHECK(object == written);
}

// Relaxation tables of a material with E0 = 20 MPa/ratio, g = .2, tau = 3 s, and a second term at one
// ratio if asked for; specimens differ by a few per cent, touches on one specimen by 1 %.
struct Tables {
  std::vector<std::string> files, ratios, specimen_ids;
};
Tables write_tables(const ScratchFolder& folder, int specimens = 2, int touches = 1,
                    double second_term_at = 0.0) {
  std::mt19937_64 dice(1);
  std::normal_distribution<double> normal;
  Tables out;
  for (const double ratio : {10.0, 13.0, 20.0}) {
    const double g_2 = ratio == second_term_at ? 0.2 : 0.0;
    double specimen_Pa = 0.0;
    for (int k = 0; k < specimens * touches; ++k) {
      if (k % touches == 0) specimen_Pa = 20e6 / ratio * std::exp(0.03 * normal(dice));
      const double E0_Pa = specimen_Pa * (touches > 1 ? std::exp(0.01 * normal(dice)) : 1.0);
      const std::string file =
          (folder.path() / (std::to_string(out.files.size()) + ".csv")).string();
      std::ofstream table(file);
      table << "time_s,modulus_Pa\n";
      for (int i = 0; i <= 150; ++i) {
        const double t_s = 0.02 * std::pow(10.0, 4.0 * i / 150.0);
        const double relaxed = 0.2 * std::exp(-t_s / 3.0) + g_2 * std::exp(-t_s / 0.2);
        table << t_s << "," << E0_Pa * (0.8 - g_2 + relaxed + 1e-3 * normal(dice)) << "\n";
      }
      out.files.push_back(file);
      out.ratios.insert(out.ratios.end(), {"--ratio", std::to_string(ratio)});
      out.specimen_ids.insert(
          out.specimen_ids.end(),
          {"--specimen-id", std::to_string(ratio) + "-" + std::to_string(k / touches)});
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
    check_read_back(joint, ran.out);
  }
}

TEST_CASE("repeats of a specimen are named on the command line or in a column of the table",
          "[cli][joint]") {
  const ScratchFolder folder;
  const Tables tables = write_tables(folder, 3, 2);
  REQUIRE(tables.files.size() == 18);
  const std::vector<std::string> words = joined({"fit", "--joint"}, {tables.files, tables.ratios});
  SECTION("by --specimen-id, once for each file") {
    const std::string joint = (folder.path() / "joint.json").string();
    const CommandOutcome ran =
        run_command(joined(words, {tables.specimen_ids, {"--out", joint, "--json"}}));
    INFO(ran.err);
    REQUIRE(ran.status == kDone);
    const auto json = nlohmann::json::parse(ran.out);
    CHECK(json["specimens"].size() == 18);
    CHECK(json["specimens"][3]["specimen"] == 2);
    CHECK(json["specimens"][3]["touch"] == 2);
    CHECK(json["law"]["n_specimens"] == 9);
    CHECK(json["law"]["between_touches"]["ln_E0"].get<double>() > 0.0);
    const auto& E0 = json["scatter"]["ln_E0"];
    CHECK(E0["touch"]["degrees_of_freedom"] == 9);
    CHECK(E0["specimen"]["degrees_of_freedom"] == 6);
    // The tables' touches scatter by 1 %: nine degrees of freedom leave 24 %; three of them.
    CHECK(E0["touch"]["deviation"].get<double>() == Approx(0.01).epsilon(0.72));
    CHECK(E0["touch"]["interval_95"][0].get<double>() < 0.01);
    CHECK(E0["touch"]["interval_95"][1].get<double>() > 0.01);
    CHECK(json["scatter"]["sum_g"]["mean"].get<double>() == Approx(0.2).epsilon(0.01));
    check_read_back(joint, ran.out);
    const CommandOutcome text = run_command(joined(words, {tables.specimen_ids}));
    CHECK_THAT(text.out, Contains("18 records of 9 specimens at 3 mixing ratios"));
    CHECK_THAT(text.out, Contains("scatter of E0") && Contains("touch, on one specimen") &&
                             Contains("(9 d.f.)"));
  }
  SECTION("by a column of the table") {
    for (std::size_t i = 0; i < tables.files.size(); ++i) {
      std::ifstream in(tables.files[i]);
      std::ostringstream out;
      std::string line;
      for (bool is_first = true; std::getline(in, line); is_first = false) {
        out << line << "," << (is_first ? "specimen" : tables.specimen_ids[2 * i + 1]) << "\n";
      }
      std::ofstream(tables.files[i]) << out.str();
    }
    const CommandOutcome ran = run_command(joined(words, {{"--json"}}));
    INFO(ran.err);
    REQUIRE(ran.status == kDone);
    CHECK(nlohmann::json::parse(ran.out)["law"]["n_specimens"] == 9);
  }
  SECTION("not at all: each is a specimen of its own, and the touches are not identified") {
    const CommandOutcome ran = run_command(joined(words, {{"--json"}}));
    REQUIRE(ran.status == kDone);
    const auto json = nlohmann::json::parse(ran.out);
    CHECK(json["law"]["n_specimens"] == 18);
    CHECK(json["scatter"]["ln_E0"]["touch"]["deviation"].is_null());
    CHECK(json["scatter"]["ln_E0"]["touch"]["note"] == "every specimen was touched once");
    CHECK(run_command(words).out.find("not identified: every specimen was touched once") !=
          std::string::npos);
  }
  SECTION("only for some") {
    std::vector<std::string> ids = tables.specimen_ids;
    ids[9].clear();
    const CommandOutcome ran = run_command(joined(words, {ids}));
    CHECK(ran.status == kBadWords);
    CHECK_THAT(ran.err, Contains("--specimen-id is empty"));
  }
  SECTION("with two ratios") {
    std::vector<std::string> ids = tables.specimen_ids;
    ids[13] = ids[1];
    const CommandOutcome ran = run_command(joined(words, {ids}));
    CHECK(ran.status == kFailed);
    CHECK_THAT(ran.err, Contains("has mixing ratio 10 in") && Contains("a specimen has one ratio"));
  }
}

TEST_CASE("a table and the material fitted to it are one record", "[cli][joint]") {
  const ScratchFolder folder;
  Tables tables = write_tables(folder);
  const std::string material = (folder.path() / "again.json").string();
  REQUIRE(run_command({"fit", tables.files[0], "--ratio", "10", "--out", material}).status ==
          kDone);
  tables.files.push_back(material);
  tables.ratios.insert(tables.ratios.end(), {"--ratio", "10"});
  const CommandOutcome ran = run_command(joined({"fit", "--joint"}, {tables.files, tables.ratios}));
  CHECK(ran.status == kFailed);
  CHECK_THAT(ran.err, Contains("come from the same record") && Contains("Remove one of the two"));
}

TEST_CASE("with --own-terms each ratio keeps its number of terms, and cards of measured ratios",
          "[cli][joint]") {
  const ScratchFolder folder;
  const Tables tables = write_tables(folder, 2, 1, /*second_term_at=*/13.0);
  const std::vector<std::string> words = joined({"fit", "--joint"}, {tables.files, tables.ratios});
  const std::string joint = (folder.path() / "joint.json").string();
  const CommandOutcome ran =
      run_command(joined(words, {{"--own-terms", "--out", joint, "--json"}}));
  INFO(ran.err);
  REQUIRE(ran.status == kDone);
  const auto json = nlohmann::json::parse(ran.out);
  CHECK(json["law"]["own_terms"] == nlohmann::json({1, 2, 1}));
  CHECK(json["materials"][1]["terms"].size() == 2);
  check_read_back(joint, ran.out);
  CHECK(run_command({"card", joint, "--ratio", "13", "--for", "json"}).status == kDone);
  const CommandOutcome between = run_command({"card", joint, "--ratio", "12", "--for", "json"});
  CHECK(between.status == kFailed);
  CHECK_THAT(between.err, Contains("ratio 12 was not measured") && Contains("--own-terms"));
  CHECK_THAT(run_command(joined(words, {{"--own-terms", "--terms", "1"}})).err,
             Contains("omit it or --own-terms"));
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
  CHECK_THAT(err_of({"fit", tables.files[0], "--own-terms"}),
             Contains("--own-terms needs --joint"));
  CHECK_THAT(err_of(joined({"fit", "--joint"}, {tables.files, {"--specimen-id", "a"}})),
             Contains("give one for each file"));
  // Of a fit, the joint one takes series and covariance alone.
  for (const std::vector<std::string>& idle : {std::vector<std::string>{"--bootstrap", "50"},
                                               {"--profiles"},
                                               {"--spectrum"},
                                               {"--diagnose"}}) {
    CHECK_THAT(err_of(joined({"fit", "--joint"}, {tables.files, tables.ratios, idle})),
               Contains(idle.front() + " is for single tests"));
  }
  CHECK_THAT(err_of(joined({"fit", "--joint"}, {tables.files, tables.ratios, {"--area", "2 mm2"}})),
             Contains("--area is for tables with a load"));
  const std::string materials = VISCARD_SOURCE_DIR "/data/materials/pdms_1to";
  CHECK_THAT(err_of({"fit", "--joint", materials + "10_seed.json", materials + "13_seed.json",
                     "--terms", "2"}),
             Contains("--terms is for records"));
}

TEST_CASE("flags of how a record was made and read stand in the joint fit", "[cli][joint]") {
  const ScratchFolder folder;
  Tables tables = write_tables(folder);
  const std::string material = (folder.path() / "m.json").string();
  REQUIRE(run_command({"fit", tables.files[0], "--out", material}).status == kDone);
  std::ifstream in(material);
  auto json = nlohmann::ordered_json::parse(in);
  for (const char* const name : {"touch-unknown", "tau-beyond-window"})
    json["flags"].push_back({{"name", name}, {"term", 0}, {"text", "why"}});
  std::ofstream(material) << json.dump();
  tables.files[0] = material;
  const CommandOutcome ran =
      run_command(joined({"fit", "--joint", "--json"}, {tables.files, tables.ratios}));
  INFO(ran.err);
  REQUIRE(ran.status == kDone);
  const auto fit = nlohmann::json::parse(ran.out);
  for (const auto& flags : {fit["flags"], fit["common"]["flags"]}) {
    CHECK_THAT(flags.dump(), Contains("touch-unknown") && Contains(material + ": why"));
    CHECK_THAT(flags.dump(), !Contains("tau-beyond-window"));
  }
}
