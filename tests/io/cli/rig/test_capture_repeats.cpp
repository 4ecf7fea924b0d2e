// viscard capture --repeat: several touches on each specimen, and the three levels of their fit.
#include "io/basics/atomic_file.h"
#include "io/capture/capture_file.h"
#include "io/config/config_file.h"
#include "io/flow/capture_to_file.h"
#include "rig/emulator/emulated_touch.h"
#include "tests/io/capture/capture_samples.h"
#include "tests/io/cli/rig/outside_rig.h"
#include "tests/support/error_text.h"
#include "tests/support/run_command.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <thread>

namespace viscard {
namespace {

using test::contains;
using test::run_command;
using test::ScratchFolder;
using Strings = std::vector<std::string>;

constexpr const char* kShortTest = R"(
[approach]
speed = "0.2 mm/s"
limit = "1.3 mm"
baseline = "1 s"
[ramp]
depth = "0.13 mm"
duration = "1 s"
hold = "3 s"
[recovery]
hold = "2 s"
)";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  text.replace(text.find(from), from.size(), to);
  return text;
}

// A specimen of the demonstration under another id.
std::string specimen_file(const ScratchFolder& folder, const std::string& demo,
                          const std::string& id) {
  const std::string text = read_file(std::string(VISCARD_SOURCE_DIR "/data/demo/") + demo);
  const std::size_t begin = text.find("id = \"") + 6;
  const std::string old = text.substr(begin, text.find('"', begin) - begin);
  std::string file = folder / (id + ".toml");
  write_file(file, replaced(text, "\"" + old + "\"", "\"" + id + "\""), true);
  return file;
}

// The truth of the demonstration with scatter: of E0 between specimens, and between touches of the
// force and the place of the surface.
std::string truth_file(const ScratchFolder& folder, const std::string& demo,
                       const std::string& scatter) {
  const std::string text = read_file(std::string(VISCARD_SOURCE_DIR "/data/demo/") + demo);
  const std::size_t old = text.find("[scatter]");
  const std::string head = text.substr(0, std::min(old, text.find("[rig]")));
  std::string file = folder / (demo + scatter.substr(0, 3) + ".toml");
  write_file(file, head + "[scatter]\n" + scatter + "\n" + text.substr(text.find("[rig]")), true);
  return file;
}

Strings repeat_words(const ScratchFolder& folder, const Strings& more) {
  write_file(folder / "test.toml", kShortTest, true);
  Strings words{
      "capture",     "--emulate", "--speed", "500",   "--test",           folder / "test.toml",
      "--lift-wait", "0",         "--json",  "--out", folder / "campaign"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

nlohmann::json last_line(const test::CommandOutcome& outcome) {
  return nlohmann::json::parse(outcome.out);
}

}  // namespace

TEST_CASE("repeats go into one folder, are numbered on, and never overwrite",
          "[cli][capture][pty]") {
  const ScratchFolder folder;
  const Strings words = repeat_words(
      folder, {"--repeat", "2", "--specimen", specimen_file(folder, "03_pdms_1to10.toml", "a")});
  const auto first = run_command(words);
  INFO(first.err);
  REQUIRE(first.status == kDone);
  const auto json = last_line(first);
  REQUIRE(json["runs"].size() == 2);
  CHECK(json["runs"][1]["touch"] == 2);
  CHECK(json["runs"][1]["specimen"] == "a");
  CHECK(json["reason"] == "");
  CHECK(contains(first.err, "touch 2 of 2: "));
  CHECK(contains(first.err, "touch 1 of 2 is recorded; the punch stays lifted for 0 s"));
  const auto path = [&](const std::string& touch) {
    return folder / ("campaign/01_a_touch" + touch + ".viscap");
  };
  CHECK(read_capture(path("01")).status == "finished");
  CHECK(read_capture(path("02")).status == "finished");
  CHECK(read_capture(path("02")).specimen.id == "a");
  const std::string before = read_file(path("01"));

  const auto again = run_command(words);
  INFO(again.err);
  REQUIRE(again.status == kDone);
  CHECK(last_line(again)["runs"][0]["touch"] == 3);
  CHECK(read_file(path("01")) == before);
  CHECK(read_capture(path("04")).status == "finished");

  Strings resumed = words;
  resumed.insert(resumed.end(), {"--resume"});
  const auto nothing_left = run_command(resumed);
  REQUIRE(nothing_left.status == kDone);
  CHECK(last_line(nothing_left)["runs"][1]["status"] == "finished before");
}

TEST_CASE("a touch that fails ends the series, and --resume repeats it beside the record",
          "[cli][capture][pty]") {
  const ScratchFolder folder;
  // The approach ends 0.3 mm behind the surface. A seed whose second touch finds it further away:
  const std::string truth = truth_file(folder, "03_pdms_1to10.truth.toml", "surface = \"0.3 mm\"");
  EmulatedTruth drawn = read_truth(truth);
  const auto surface_mm = [&](int touch) {
    return 1e3 * truth_of_touch(drawn, "a", touch).surface_position_m;
  };
  for (drawn.seed = 1;
       surface_mm(1) > 1.2 || surface_mm(1) < 0.5 || surface_mm(2) < 1.5 || surface_mm(3) < 0.5;) {
    ++drawn.seed;
  }
  Strings words =
      repeat_words(folder, {"--repeat", "3", "--truth", truth, "--seed", std::to_string(drawn.seed),
                            "--specimen", specimen_file(folder, "03_pdms_1to10.toml", "a")});
  const auto broken = run_command(words);
  INFO(broken.err);
  CHECK(broken.status == kFailed);
  const auto json = last_line(broken);
  REQUIRE(json["runs"].size() == 2);
  CHECK(json["runs"][0]["status"] == "finished");
  CHECK(json["runs"][1]["status"] != "finished");
  CHECK(contains(json["reason"].get<std::string>(), "touch 2 of 3: "));
  CHECK(json["error"]["code"] == "device");
  CHECK(contains(broken.err,
                 "1 of 3 captures are recorded and kept; the same command with "
                 "--resume continues from here"));
  const auto left = folder / "campaign/01_a_touch02.viscap";
  const std::string record = read_file(left);

  // Another approach finds the surface.
  write_file(folder / "test.toml", replaced(kShortTest, "1.3 mm", "4 mm"), true);
  words.insert(words.end(), {"--resume"});
  const auto resumed = run_command(words);
  INFO(resumed.err);
  CHECK(resumed.status == kDone);
  CHECK(read_file(left) == record);
  CHECK(read_capture(folder / "campaign/01_a_touch02.2.viscap").status == "finished");
  CHECK(read_capture(folder / "campaign/01_a_touch03.viscap").status == "finished");
}

TEST_CASE("a touch that cannot begin leaves the result of those before it", "[cli][capture][pty]") {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder / "campaign");
  write_file(folder / "campaign/01_a_touch02.truth.json", "precious", false);
  const auto outcome =
      run_command(repeat_words(folder, {"--repeat", "2", "--resume", "--specimen",
                                        specimen_file(folder, "03_pdms_1to10.toml", "a")}));
  INFO(outcome.err);
  CHECK(outcome.status == kFailed);
  const auto json = last_line(outcome);
  REQUIRE(json["runs"].size() == 2);
  CHECK(json["runs"][0]["status"] == "finished");
  CHECK(json["runs"][1]["status"] == "not begun");
  CHECK(json["error"]["code"] == "exists");
  CHECK(read_file(folder / "campaign/01_a_touch02.truth.json") == "precious");
}

TEST_CASE("Ctrl-C while the punch is lifted ends the series and keeps the touches",
          "[cli][capture][pty]") {
  const ScratchFolder folder;
  write_file(folder / "test.toml", kShortTest, true);
  Program program({"capture", "--emulate", "--speed", "500", "--test", folder / "test.toml",
                   "--repeat", "2", "--lift-wait", "20 h", "--out", folder / "campaign"});
  while (!program.has_ended() && !contains(program.said(), "stays lifted for 72000 s")) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  program.send(SIGINT);
  const int status = program.wait();
  INFO(program.said());
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 1);
  CHECK(contains(program.said(), "stopped while the punch was lifted, before touch 2 of 2"));
  CHECK(contains(program.said(), "1 of 2 captures are recorded and kept"));
  CHECK(read_capture(folder / "campaign/01_specimen_touch01.viscap").status == "finished");
}

TEST_CASE("options of repeats that make no sense are refused", "[cli][capture]") {
  const auto err_of = [](const Strings& more) {
    Strings words{"capture", "--emulate", "--out", "nowhere"};
    words.insert(words.end(), more.begin(), more.end());
    const auto outcome = run_command(words);
    CHECK(outcome.status == kBadWords);
    return outcome.err;
  };
  CHECK(contains(err_of({"--repeat", "0"}), "--repeat is 0; it must be from 1 to 99"));
  CHECK(contains(err_of({"--repeat", "2", "--force"}), "replaces none: omit --force"));
  CHECK(contains(err_of({"--lift-wait", "60"}), "add --repeat N"));
  CHECK(contains(err_of({"--repeat", "2", "--lift-wait=-1"}), "--lift-wait is -1 s"));
  CHECK(contains(err_of({"--truth", "a", "--truth", "b"}), "one for all, or one for each"));
}

TEST_CASE("repeated captures of scattering specimens give the three levels in the joint fit",
          "[cli][capture][joint][pty]") {
  const ScratchFolder folder;
  const std::string scatter = "specimen = 0.05\nalignment = 0.02\nsurface = \"2 um\"";
  const std::string truth_10 = truth_file(folder, "03_pdms_1to10.truth.toml", scatter),
                    truth_20 = truth_file(folder, "05_pdms_1to20.truth.toml", scatter);
  const char* kDemo_10 = "03_pdms_1to10.toml";
  const char* kDemo_20 = "05_pdms_1to20.toml";
  const Strings capture_words = repeat_words(
      folder, {"--repeat", "3", "--specimen", specimen_file(folder, kDemo_10, "stiff-1"),
               "--specimen", specimen_file(folder, kDemo_10, "stiff-2"), "--specimen",
               specimen_file(folder, kDemo_20, "soft-1"), "--specimen",
               specimen_file(folder, kDemo_20, "soft-2"), "--truth", truth_10, "--truth", truth_10,
               "--truth", truth_20, "--truth", truth_20});
  // In 3 s neither the creep of the cell nor the speed of the stage is known well enough.
  write_file(folder / "test.toml", replaced(kShortTest, "hold = \"3 s\"", "hold = \"20 s\""), true);
  const auto captured = run_command(capture_words);
  INFO(captured.err);
  REQUIRE(captured.status == kDone);
  Strings words{"fit", "--joint", "--json", "--terms", "2"};
  std::vector<double> true_E0_Pa;
  const auto campaign = last_line(captured);  // outlives the loop
  for (const auto& run : campaign["runs"]) {
    const std::string file = run["file"];
    words.push_back(file);
    const auto truth = nlohmann::json::parse(
        read_file(std::filesystem::path(file).replace_extension(".truth.json")));
    CHECK(truth["alignment_scatter"] == 0.02);
    true_E0_Pa.push_back(truth["E0_Pa"].get<double>() * truth["contact_factor"].get<double>());
  }
  REQUIRE(true_E0_Pa.size() == 12);
  const auto fitted = run_command(words);
  INFO(fitted.err);
  REQUIRE(fitted.status == kDone);
  const auto json = nlohmann::json::parse(fitted.out);
  CHECK(json["law"]["n_specimens"] == 4);
  for (std::size_t i = 0; i < true_E0_Pa.size(); ++i) {
    // E0 within 1 %, half of what a touch scatters.
    CHECK(json["specimens"][i]["E0_Pa"].get<double>() == Approx(true_E0_Pa[i]).epsilon(0.01));
  }
  const auto& E0 = json["scatter"]["ln_E0"];
  CHECK(E0["touch"]["degrees_of_freedom"] == 8);
  CHECK(E0["touch"]["interval_95"][0].get<double>() < 0.02);
  CHECK(E0["touch"]["interval_95"][1].get<double>() > 0.02);
  CHECK(E0["touch"]["deviation"].get<double>() > 0.005);
  CHECK(E0["specimen"]["degrees_of_freedom"] == 2);
  CHECK(E0["specimen"]["interval_95"][1].get<double>() > 0.05);
  CHECK(E0["ratio"]["deviation"].is_null());  // a straight law through two ratios

  const std::string page = folder / "page.html";
  Strings report{"report", "--out", page, "--reproducible"};
  report.insert(report.end(), words.begin() + 5, words.end());
  const auto reported = run_command(report);
  INFO(reported.err);
  const std::string html = read_file(page);
  CHECK(contains(html, "stiff-1, touch 3"));
  CHECK(contains(html, "touches on one specimen"));
  CHECK(contains(html, "10 : 1 (2 specimens)"));
}

namespace {

// The rig of the demonstration, homed before and after, and a test without an unloading in contact.
Strings homed_words(const ScratchFolder& folder, const Strings& more) {
  write_file(folder / "rig.toml",
             replaced(read_file(VISCARD_SOURCE_DIR "/data/demo/01_rig.toml"), "home = false",
                      "home = true "),
             true);
  Strings words = repeat_words(folder, {"--rig", folder / "rig.toml", "--repeat", "2"});
  write_file(folder / "test.toml", R"(
protocol = "levels"
[approach]
speed = "0.2 mm/s"
baseline = "1 s"
[[levels]]
depth = "0.13 mm"
duration = "1 s"
hold = "3 s"
)",
             true);
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

std::string last_value(const CapturedRun& run, const std::string& event) {
  std::string value;
  for (const RunEvent& one : run.events) {
    if (one.name == event) value = one.value;
  }
  return value;
}

int phases_named(const CapturedRun& run, const std::string& phase) {
  int n = 0;
  for (const RunEvent& one : run.events) n += one.name == "phase" && one.value == phase ? 1 : 0;
  return n;
}

}  // namespace

TEST_CASE("repeats home the stage once at the end, and both captures state what that has shown",
          "[cli][capture][pty]") {
  const ScratchFolder folder;
  const auto series = run_command(homed_words(folder, {}));
  INFO(series.err);
  REQUIRE(series.status == kDone);
  const auto json = last_line(series);
  REQUIRE(json["runs"].size() == 2);
  std::vector<CapturedRun> runs;
  for (const auto& run : json["runs"]) {
    CHECK(run["depth_is"] == "compared");
    CHECK(run["doubts"].empty());
    runs.push_back(read_capture(run["file"].get<std::string>()));
    CHECK(last_value(runs.back(), "depth") == "compared");
  }
  CHECK(phases_named(runs[0], "home") == 0);
  CHECK(phases_named(runs[1], "home") == 1);
}

TEST_CASE("a stage without a comparison is homed before the first touch of a series only",
          "[cli][capture][pty]") {
  const ScratchFolder folder;
  const Strings words = homed_words(folder, {});
  write_file(folder / "rig.toml",
             replaced(read_file(folder / "rig.toml"), "driver = \"grbl\"",
                      "driver = \"zaber\"\nmicrostep = \"0.3125 um\""),
             true);
  const auto series = run_command(words);
  INFO(series.err);
  REQUIRE(series.status == kDone);
  std::vector<int> n_homings;
  const auto json = last_line(series);
  for (const auto& run : json["runs"]) {
    CHECK(run["depth_is"] == "counted");
    n_homings.push_back(0);
    read_raw_bytes(run["file"].get<std::string>(), [&](const RawBytes& raw) {
      if (raw.is_sent && raw.device == Device::kStage && contains(raw.bytes, " home")) {
        ++n_homings.back();
      }
    });
  }
  CHECK(n_homings == std::vector<int>{1, 0});
}

TEST_CASE("steps lost in a series are a doubt of each of its runs, and a flag of their fits",
          "[cli][capture][pty]") {
  const ScratchFolder folder;
  const auto series = run_command(homed_words(folder, {"--fault", "lost-steps"}));
  INFO(series.err);
  REQUIRE(series.status == kDone);
  const auto json = last_line(series);
  REQUIRE(json["runs"].size() == 2);
  for (const auto& run : json["runs"]) {
    CAPTURE(run.dump());
    CHECK(run["is_doubtful"] == true);
    CHECK(run["count_off_m"].get<double>() > 30e-6);  // of both runs
    CHECK(contains(run["doubts"].dump(), "has lost steps while it pressed"));
    const auto fit = run_command({"fit", run["file"].get<std::string>(), "--json"});
    INFO(fit.err);
    REQUIRE(fit.status == kDone);
    CHECK(contains(last_line(fit)["flags"].dump(), "lost-steps"));
  }
  CHECK(contains(json["runs"][0]["doubts"].dump(), "homed after 2 runs"));
}

TEST_CASE("a capture of a series that has gone does not keep the others from what homing has shown",
          "[cli][capture][pty]") {
  const ScratchFolder folder;
  const bool loses_steps = GENERATE(true, false);
  CAPTURE(loses_steps);
  Strings words = homed_words(folder, {});
  std::replace(words.begin(), words.end(), std::string("2"), std::string("3"));  // touches
  if (loses_steps) words.insert(words.end(), {"--fault", "lost-steps"});
  const auto capture = [&](const char* touch) {
    return folder / (std::string("campaign/01_specimen_touch") + touch + ".viscap");
  };
  std::atomic<bool> is_over{false};
  std::thread remover([&] {  // as soon as the second touch has begun
    while (!is_over && !std::filesystem::exists(capture("02"))) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    std::filesystem::remove(capture("01"));
  });
  const auto series = run_command(words);
  is_over = true;
  remover.join();
  INFO(series.err);
  CHECK(series.status == kFailed);
  const std::string missing = loses_steps ? "the doubt that the stage has lost steps is missing"
                                          : "that the count of steps was compared is missing";
  CHECK(contains(series.err, "01_specimen_touch01.viscap"));
  CHECK(contains(series.err, missing));
  CHECK(series.err.find(missing) == series.err.rfind(missing));
  CHECK_FALSE(contains(series.err, "--resume"));  // there is nothing to repeat
  const auto json = last_line(series);
  REQUIRE(json["runs"].size() == 3);
  for (const auto& run : json["runs"]) {
    CHECK(run["status"] == "finished");
    CHECK(run["is_doubtful"] == loses_steps);
    CHECK(run["depth_is"] == (loses_steps ? "counted" : "compared"));
  }
  CHECK(json["reason"] == "");
  CHECK(json["error"]["code"] == "file");
  CHECK(json["runs"][0]["error"]["code"] == "file");
  CHECK_FALSE(json["runs"][1].contains("error"));
  const CapturedRun second = read_capture(capture("02"));
  CHECK(last_value(second, "depth") == (loses_steps ? "counted" : "compared"));
  CHECK(last_value(second, "doubt") == (loses_steps ? "lost_steps" : ""));
}

TEST_CASE("steps that were lost are a doubt in every capture that can be changed",
          "[cli][capture]") {
  const ScratchFolder folder;
  const std::string held = folder / "held.viscap", free = folder / "free.viscap",
                    gone = folder / "gone.viscap";
  CaptureWriter writer(held, test::demo_run());
  {
    CaptureWriter finished(free, test::demo_run());
    finished.append(RunEvent{12.5, "finished", "", "The run is complete"});
    finished.finish("finished");
  }
  RunOutcome of_held, of_gone, of_free, last;
  last.count = CountCheck{26e-6, 83.2, 1.6e-6};
  const auto unchanged = share_count({{held, &of_held}, {gone, &of_gone}, {free, &of_free}}, last);
  REQUIRE(unchanged.size() == 2);
  CHECK(unchanged[0].path == held);
  CHECK(contains(unchanged[0].why, "held.viscap: is being written"));
  CHECK(unchanged[1].path == gone);
  CHECK(contains(unchanged[1].why, "gone.viscap"));
  CHECK(contains(unchanged[1].why, "leave that one out of fits"));
  CHECK(last_value(read_capture(free), "doubt") == "lost_steps");
  for (const RunOutcome* outcome : {&of_held, &of_gone, &of_free}) {
    CHECK(outcome->doubts.size() == 1);
    CHECK(outcome->count.has_value());
  }
}

}  // namespace viscard
