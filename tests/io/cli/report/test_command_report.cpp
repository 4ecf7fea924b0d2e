#include "io/capture/capture_file.h"
#include "io/cli/report/report_commands.h"
#include "io/config/config_file.h"
#include "io/flow/read_report.h"
#include "io/materials/material_file.h"
#include "tests/io/plots/markup.h"
#include "tests/support/error_text.h"
#include "tests/support/in_memory_run.h"
#include "tests/support/run_command.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

namespace viscard {
namespace {

using test::contains;
using test::run_command;

std::string contents_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

void write_text(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

// A capture of the demo's 1:10 specimen, made in memory with a short hold.
void write_run(const std::string& path, const EmulatedTruth& truth) {
  TestPlan plan;
  plan.hold_s = 20.0;
  plan.recovery_s = 10.0;
  CapturedRun run = test::in_memory_run(truth, plan);
  run.specimen.id = "PDMS <1:10>";
  run.specimen.mixing_ratio = 10.0;
  run.specimen.modulus_guess_Pa = 2e6;
  CaptureWriter writer(path, run);
  for (const StageReport& report : run.stage_reports) writer.append(report);
  for (const LoadSample& sample : run.load_samples) writer.append(sample);
  for (const CommandedMove& move : run.moves) writer.append(move);
  for (const RunEvent& event : run.events) writer.append(event);
  writer.finish("finished");
}

std::string write_material(const test::ScratchFolder& folder) {
  Material material;
  material.name = "PDMS";
  material.E0_Pa = 1.8e6;
  material.nu = 0.33;
  material.terms = {{0.1, 0.1, 0.5}};
  std::string path = (folder / "pdms.json").string();
  write_text(path, json_from_material(material));
  return path;
}

}  // namespace

TEST_CASE("a test at large strain is refused by a report with the way to its law",
          "[cli][report]") {
  const test::ScratchFolder folder;
  const std::string page = folder / "page.html";
  const auto err_of = [&](const std::string& word) {
    const auto outcome = run_command({"report", word, "--out", page});
    CHECK(outcome.status == kBadWords);
    return outcome.err;
  };
  CHECK_THAT(err_of("uniaxial=u.csv"),
             Catch::Contains("uniaxial=u.csv is a test at large strain, not a linear one") &&
                 Catch::Contains("viscard fit uniaxial=u.csv --out law.json") &&
                 !Catch::Contains("did you mean"));
  CHECK_THAT(err_of("uniaxal=u.csv"),
             Catch::Contains("'uniaxal' is no kind of test") && !Catch::Contains("uniaxial"));
  ReportRequest nothing;
  CHECK_THROWS_WITH(sort_inputs(nothing),
                    "no files given; give a capture, a table or a material "
                    "file");
}

TEST_CASE("a page has the logo of its file of options", "[cli][report]") {
  const test::ScratchFolder folder;
  const std::string material = write_material(folder), page = (folder / "page.html").string();
  const std::string logo = (folder / "logo.svg").string(),
                    words = (folder / "house.options").string();
  const auto report = [&](const std::string& picture) {
    write_text(logo, picture);
    write_text(words, "--title=House\n--logo=" + logo + "\n");
    return run_command({"report", material, "@" + words, "--out", page, "--force"});
  };
  const auto made = report("<svg xmlns='http://www.w3.org/2000/svg'/>");
  INFO(made.err);
  REQUIRE(made.status == 0);
  // RFC 4648 of the text above, by another program.
  CHECK(contains(contents_of(page),
                 "<img class=\"logo\" alt=\"\" src=\"data:image/svg+xml;base64,"
                 "PHN2ZyB4bWxucz0naHR0cDovL3d3dy53My5vcmcvMjAwMC9zdmcnLz4=\">"));
  CHECK(contains(contents_of(page), "<h1>House</h1>"));
  REQUIRE(report("\x89PNG\r\n\x1a\n" + std::string(10, '\0')).status == 0);
  CHECK(contains(contents_of(page), "data:image/png;base64,iVBORw0KGgoA"));
  const std::string before = contents_of(page);
  for (const std::string& wrong : {std::string("no picture"), std::string(),
                                   "<svg" + std::string(std::size_t{2} << 20, ' ')}) {
    const auto refused = report(wrong);
    CHECK(refused.status == 1);
    CHECK(contains(refused.err, logo));
    CHECK(contents_of(page) == before);
  }
}

TEST_CASE("a capture becomes a page with fit, truth, pillar and cards", "[cli][report]") {
  const test::ScratchFolder folder;
  const std::string capture = (folder / "run.viscap").string();
  const std::string page = (folder / "page.html").string();
  const std::string truth_file = VISCARD_SOURCE_DIR "/data/demo/03_pdms_1to10.truth.toml";
  const EmulatedTruth truth = test::demo_truth(10, 3);
  write_run(capture, truth);
  const auto outcome = run_command({"report", capture, "--truth", truth_file, "--out", page,
                                    "--pictures", (folder / "pictures").string(), "--json"});
  CAPTURE(outcome.err);
  REQUIRE(outcome.status == kDone);
  const nlohmann::json json = nlohmann::json::parse(outcome.out);
  REQUIRE(json["specimens"].size() == 1);
  CHECK(json["specimens"][0]["E0_Pa"].get<double>() == Approx(truth.material.E0_Pa).epsilon(0.01));
  CHECK(json["specimens"][0]["files"].size() == 2);
  CHECK(json["pictures"].size() == json["figures"].get<std::size_t>());
  for (const auto& picture : json["pictures"]) {
    CHECK(test::first_fault(contents_of(picture.get<std::string>())) == "");
  }
  const std::string html = contents_of(page);
  CHECK(test::first_fault(html) == "");
  const std::string text = test::text_of(html);
  for (const char* part : {"PDMS <1:10>", "Truth and estimate", "The fitted material in a pillar",
                           "*VISCOELASTIC", "TB,PRONY", "SHA-256"}) {
    CAPTURE(part);
    CHECK(contains(text, part));
  }
}

TEST_CASE("a material file alone makes a page, and its capture joins it", "[cli][report]") {
  const test::ScratchFolder folder;
  const std::string capture = (folder / "run.viscap").string();
  const std::string fitted = (folder / "run.json").string();
  const std::string page = (folder / "page.html").string();
  CHECK(run_command({"report", write_material(folder), "--out", page}).status == kDone);
  CHECK(contains(test::text_of(contents_of(page)), "Known from its material file only"));

  write_run(capture, test::demo_truth(10, 4));
  REQUIRE(run_command({"fit", capture, "--out", fitted}).status == kDone);
  const auto outcome = run_command({"report", capture, fitted, "--out", page, "--force", "--json"});
  CAPTURE(outcome.err);
  REQUIRE(outcome.status == kDone);
  const nlohmann::json json = nlohmann::json::parse(outcome.out);
  REQUIRE(json["specimens"].size() == 1);
  CHECK(json["specimens"][0]["files"].size() == 2);
  CHECK(json["specimens"][0]["notes"].empty());
}

TEST_CASE("the page reports that a material file was fitted with other options", "[cli][report]") {
  const test::ScratchFolder folder;
  const std::string capture = (folder / "run.viscap").string();
  const std::string fitted = (folder / "run.json").string();
  write_run(capture, test::demo_truth(10, 5));
  REQUIRE(run_command({"fit", capture, "--terms", "1", "--out", fitted}).status != kBadWords);
  const auto outcome =
      run_command({"report", capture, fitted, "--out", (folder / "page.html").string(), "--json"});
  const nlohmann::json json = nlohmann::json::parse(outcome.out);
  REQUIRE(json["specimens"].size() == 1);
  REQUIRE(json["specimens"][0]["notes"].size() == 1);
  CHECK(contains(json["specimens"][0]["notes"][0].get<std::string>(), "other options"));
}

TEST_CASE("a table is fitted for the page", "[cli][report]") {
  const test::ScratchFolder folder;
  const std::string table = (folder / "relaxation.csv").string();
  std::string text = "time_s,modulus_Pa\n";
  for (int i = 0; i < 200; ++i) {
    const double t = 0.01 * std::pow(10.0, i / 50.0);
    const double noise = 1.0 + 1e-3 * std::sin(12.9898 * i * i);
    text += std::to_string(t) + "," +
            std::to_string((1e6 + 2e5 * std::exp(-t / 0.3) + 1e5 * std::exp(-t / 20)) * noise) +
            "\n";
  }
  write_text(table, text);
  const std::string page = (folder / "page.html").string();
  const auto outcome = run_command({"report", table, "--out", page});
  CAPTURE(outcome.err);
  REQUIRE(outcome.status == kDone);
  CHECK(contains(test::text_of(contents_of(page)), "relaxation modulus"));
}

TEST_CASE("reproducible pages are the same bytes twice", "[cli][report]") {
  const test::ScratchFolder folder;
  const std::string material = write_material(folder), page = (folder / "page.html").string();
  const std::vector<std::string> words{"report",  material, "--reproducible",
                                       "--force", "--out",  page};
  REQUIRE(run_command(words).status == kDone);
  const std::string first = contents_of(page);
  REQUIRE(run_command(words).status == kDone);
  CHECK(contents_of(page) == first);
}

TEST_CASE("a wrong command line of report gives one clear line", "[cli][report]") {
  const test::ScratchFolder folder;
  const std::string material = write_material(folder), page = (folder / "page.html").string();
  const auto fails = [&](std::vector<std::string> words, int status, const std::string& part) {
    words.insert(words.begin(), "report");
    const auto outcome = run_command(words);
    CAPTURE(words, outcome.err);
    CHECK(outcome.status == status);
    CHECK(contains(outcome.err, part));
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    CHECK(outcome.out.empty());
    CHECK_FALSE(std::filesystem::exists(page));
  };
  fails({"--out", page}, kBadWords, "no files given; usage: ");
  fails({material}, kBadWords, "--out report.html");
  fails({material, "--out", page, "--card", "abacus"}, kBadWords, "abaqus");
  fails({material, "--out", page, "--units", "furlong"}, kBadWords, "mm-t-s");
  fails({material, "--out", page, "--truth", material}, kBadWords, "1 truth file for 0 captures");
  fails({material, "--out", page, "--titel", "x"}, kBadWords, "--title");
  fails({(folder / "absent.viscap").string(), "--out", page}, kFailed, "No such file");
  fails({(folder / ".").string(), "--out", page}, kFailed, "is a folder");
  write_text((folder / "broken.json").string(), "{ \"E0_Pa\": ");
  fails({(folder / "broken.json").string(), "--out", page}, kFailed, "broken.json");
  write_text((folder / "text.csv").string(), "a,b\nc,d\n");
  fails({(folder / "text.csv").string(), "--out", page}, kFailed, "text.csv");
}

TEST_CASE("an existing page is kept unless --force is given", "[cli][report]") {
  const test::ScratchFolder folder;
  const std::string page = (folder / "page.html").string();
  write_text(page, "mine");
  const std::string material = write_material(folder);
  const auto refused = run_command({"report", material, "--out", page});
  CHECK(refused.status == kFailed);
  CHECK(contains(refused.err, "--force"));
  CHECK(contents_of(page) == "mine");
  CHECK(run_command({"report", material, "--out", page, "--force"}).status == kDone);
  CHECK(contents_of(page) != "mine");
}

TEST_CASE("a table becomes a page without a pillar", "[cli][report]") {
  const test::ScratchFolder folder;
  const std::string page = (folder / "page.html").string();
  const std::string table = VISCARD_SOURCE_DIR "/data/demo/example_relaxation.csv";
  const auto outcome = run_command({"report", table, "--out", page, "--json"});
  CAPTURE(outcome.err);
  REQUIRE(outcome.status == kDone);
  CHECK_FALSE(nlohmann::json::parse(outcome.out)["specimens"][0].contains("pillar"));
  const std::string text = test::text_of(contents_of(page));
  CHECK_FALSE(contains(text, "pillar"));
  CHECK(contains(text, "Material cards"));
}

namespace {

// Stands for the commands that a demo runs: keeps their words, and writes what they would.
struct FakeCommands {
  std::vector<Words> ran;
  std::string failing;  // its result is begun, and it fails

  int operator()(const Words& words, Streams& /*streams*/) {
    ran.push_back(words);
    const auto after = [&](const std::string& option) {
      const auto found = std::find(words.begin(), words.end(), option);
      return found == words.end() ? std::string() : *(found + 1);
    };
    const std::string out = words[0] == "validate" ? after("--csv") : after("--out");
    if (words[0] == "fit") {
      Material material;
      material.E0_Pa = 1.8e6;
      material.nu = 0.4;
      material.terms = {{0.1, 0.1, 0.5}};
      write_text(out, json_from_material(material));
    } else {
      write_text(out, words[0] == "capture" ? contents_of(after("--truth")) : words[0]);
    }
    return !failing.empty() && out.find(failing) != std::string::npos ? kFailed : kDone;
  }
  std::size_t count(const std::string& command) const {
    return static_cast<std::size_t>(std::count_if(
        ran.begin(), ran.end(), [&](const Words& words) { return words[0] == command; }));
  }
};

// What the demo prints on stderr.
std::string demo_of(FakeCommands& commands, const Words& words) {
  std::ostringstream out, err;
  Streams streams{out, err};
  commands.ran.clear();
  run_demo(words, streams, std::ref(commands));
  return err.str();
}

}  // namespace

TEST_CASE("a demo keeps what finished steps made of the same inputs, and nothing else", "[cli]") {
  namespace fs = std::filesystem;
  const test::ScratchFolder folder;
  const fs::path data = folder / "data", truth = data / "03_pdms_1to10.truth.toml";
  fs::copy(VISCARD_SOURCE_DIR "/data/demo", data, fs::copy_options::recursive);
  const Words words{"--out", folder / "demo", "--data", data};
  FakeCommands commands;

  commands.failing = "pdms_1to13.viscap";  // as an interrupted capture does
  CHECK_THROWS_WITH(demo_of(commands, words), Catch::Contains("keeps what is finished"));
  CHECK(commands.count("capture") == 2);
  commands.failing.clear();
  demo_of(commands, words);
  CHECK(commands.count("capture") == 2);  // again the second, and the third
  CHECK(commands.count("fit") == 2);
  CHECK(contains(demo_of(commands, words), "25 results were up to date"));
  CHECK(commands.ran.empty());

  // Other contents count, and not the times of the files.
  const auto before = fs::last_write_time(truth);
  write_text(truth, contents_of(truth) + "\n# another specimen\n");
  fs::last_write_time(truth, before - std::chrono::hours(24));
  demo_of(commands, words);
  CHECK(commands.count("capture") == 1);
  CHECK(commands.count("report") == 1);
  CHECK(commands.ran.front()[0] == "capture");
  write_text(folder / "demo/pdms_1to20.csv", "edited");
  demo_of(commands, words);
  REQUIRE(commands.ran.size() == 1);
  CHECK(commands.ran[0][0] == "export");
}

TEST_CASE("a demo does not replace a file that is of no demo", "[cli]") {
  const test::ScratchFolder folder;
  std::filesystem::create_directories(folder / "mine");
  const std::string mine = folder / "mine/pdms_1to10.json";
  write_text(mine, "precious");
  FakeCommands commands;
  CHECK_THROWS_WITH(demo_of(commands, {"--out", folder / "mine"}),
                    Catch::Contains("pdms_1to10.json is not of an earlier demo"));
  CHECK(contents_of(mine) == "precious");
  demo_of(commands, {"--out", folder / "mine", "--force"});
  CHECK(contents_of(mine) != "precious");
}

}  // namespace viscard
