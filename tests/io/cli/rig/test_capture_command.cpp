// viscard capture and viscard rig as a user calls them: series, resuming, refusals.
#include "io/basics/atomic_file.h"
#include "io/capture/capture_file.h"
#include "io/capture/sqlite_database.h"
#include "io/config/config_file.h"
#include "rig/emulator/demo_rig.h"
#include "rig/emulator/emulated_rig.h"
#include "rig/emulator/pty_port.h"
#include "tests/support/error_text.h"
#include "tests/support/run_command.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

namespace viscard {
namespace {

using test::contains;
using test::run_command;
using test::ScratchFolder;

std::string demo(const std::string& name) {
  return VISCARD_SOURCE_DIR "/data/demo/" + name;
}

constexpr const char* kShortTest = R"(
[approach]
speed = "0.2 mm/s"
baseline = "1 s"
[ramp]
depth = "0.13 mm"
duration = "1 s"
hold = "3 s"
[recovery]
hold = "2 s"
)";

// viscard capture --force with the demo's rig behind these ports.
test::CommandOutcome replace_over_ports(const ScratchFolder& folder,
                                        const std::filesystem::path& capture,
                                        const std::string& stage, const std::string& load_cell) {
  std::string rig = read_file(demo("01_rig.toml"));
  const auto put = [&rig](const std::string& from, const std::string& to) {
    rig.replace(rig.find(from), from.size(), to);
  };
  put("/dev/serial/by-id/stage", stage);
  put("/dev/serial/by-id/load_cell", load_cell);
  write_file(folder / "rig.toml", rig, false);
  return run_command({"capture", "--rig", folder / "rig.toml", "--test", demo("02_test.toml"),
                      "--specimen", demo("03_pdms_1to10.toml"), "--out", capture, "--force"});
}

std::vector<std::string> series_words(const ScratchFolder& folder) {
  const std::string test_file = folder / "test.toml";
  if (!std::filesystem::exists(test_file)) write_file(test_file, kShortTest, false);
  return {"capture",    "--emulate",
          "--speed",    "100",
          "--test",     test_file,
          "--specimen", demo("03_pdms_1to10.toml"),
          "--specimen", demo("04_pdms_1to13.toml"),
          "--out",      folder / "series"};
}

std::vector<std::string> with(std::vector<std::string> words, const std::string& word) {
  words.push_back(word);
  return words;
}

// A capture that a crash left unfinished.
void leave_interrupted(const std::filesystem::path& path) {
  CapturedRun about;
  about.rig.calibration.volts_per_newton = 0.7255;
  about.rig.calibration.capacity_N = 2.45;
  about.specimen.id = "left behind";
  about.specimen.modulus_guess_Pa = 1e6;
  about.specimen.contact.punch_radius_m = 2e-3;
  CaptureWriter writer(path, about);
  writer.append(LoadSample{.index = 0, .counts = 1.0});
}

}  // namespace

TEST_CASE("files beside a capture are not overwritten either", "[cli][capture]") {
  const ScratchFolder folder;
  write_file(folder / "run.truth.json", "precious", false);
  const auto refused = run_command(
      {"capture", "--emulate", "--speed", "100", "--out", (folder / "run.viscap").string()});
  CHECK(refused.status == kFailed);
  CHECK(contains(refused.err, "run.truth.json' exists already"));
  CHECK(read_file(folder / "run.truth.json") == "precious");
}

TEST_CASE("a series is resumed with the unfinished captures, and nothing is overwritten",
          "[cli][capture][pty]") {
  const ScratchFolder folder;
  std::filesystem::create_directories(folder / "series");
  const auto first = folder / "series/01_03_pdms_1to10.viscap";
  leave_interrupted(first);
  const std::string left = read_file(first);

  const auto refused = run_command(series_words(folder));
  CHECK(refused.status == kFailed);
  CHECK(contains(refused.err, "exists already"));

  const auto resumed = run_command(with(series_words(folder), "--resume"));
  INFO(resumed.err);
  REQUIRE(resumed.status == kDone);
  CHECK(read_file(first) == left);
  CHECK(read_capture(folder / "series/01_03_pdms_1to10.2.viscap").status == "finished");
  CHECK(read_capture(folder / "series/02_04_pdms_1to13.viscap").status == "finished");

  const auto again = run_command(with(with(series_words(folder), "--resume"), "--json"));
  CHECK(again.status == kDone);
  const auto json = nlohmann::json::parse(again.out);
  REQUIRE(json["runs"].size() == 2);
  for (const auto& run : json["runs"]) CHECK(run["status"] == "finished before");
}

TEST_CASE("capture --resume skips a single finished capture", "[cli][capture][pty]") {
  const ScratchFolder folder;
  const std::string out = folder / "run.viscap";
  const std::string test_file = folder / "test.toml";
  write_file(test_file, kShortTest, false);
  const std::vector<std::string> words{"capture", "--emulate", "--speed", "100", "--test",
                                       test_file, "--live",    "--out",   out,   "--resume"};
  const auto first = run_command(words);
  INFO(first.err);
  REQUIRE(first.status == kDone);
  CHECK(contains(first.out, "run.viscap: finished\n"));
  CHECK(contains(first.out, "force           ▁"));
  CHECK(contains(first.err, "live page: "));
  const std::string page = read_file(folder / "run.live.html");
  CHECK(contains(page, "<svg"));
  CHECK(contains(page, "over"));
  CHECK_FALSE(contains(page, "http-equiv='refresh'"));
  const auto again = run_command(words);
  CHECK(again.status == kDone);
  CHECK(contains(again.out, "run.viscap: finished before"));
}

TEST_CASE("capture --resume does not take the capture of another test or specimen for finished",
          "[cli][capture][pty]") {
  const ScratchFolder folder;
  const std::string out = folder / "run.viscap", test_file = folder / "test.toml",
                    specimen_file = folder / "specimen.toml";
  const std::string specimen = read_file(VISCARD_SOURCE_DIR "/data/demo/03_pdms_1to10.toml");
  write_file(test_file, kShortTest, false);
  write_file(specimen_file, specimen, false);
  const std::vector<std::string> words{"capture", "--emulate", "--speed",    "100",
                                       "--test",  test_file,   "--specimen", specimen_file,
                                       "--out",   out,         "--resume"};
  const auto first = run_command(words);
  INFO(first.err);
  REQUIRE(first.status == kDone);
  REQUIRE(contains(run_command(words).out, "run.viscap: finished before"));

  write_file(test_file, toml_from_test([&] {
               TestPlan plan = read_test(test_file);
               plan.depth_m *= 0.5;
               return plan;
             }()),
             true);
  const auto other_depth = run_command(words);
  CHECK(other_depth.status == kFailed);
  CHECK(contains(other_depth.err, "run.viscap is a finished capture of another test: "));
  CHECK(contains(other_depth.err, "depth"));
  write_file(test_file, kShortTest, true);

  Specimen thicker = read_specimen(specimen_file);
  thicker.contact.layer_thickness_m *= 1.25;
  write_file(specimen_file, toml_from_specimen(thicker), true);
  const auto other_layer = run_command(words);
  CHECK(other_layer.status == kFailed);
  CHECK(contains(other_layer.err, "of another specimen: "));
  write_file(specimen_file, specimen, true);

  // A reading that is not what was written.
  Database(out, Database::Access::kReadWrite)
      .execute("UPDATE load_samples SET counts = counts + 1 WHERE sample_index = 5");
  const auto damaged = run_command(words);
  INFO(damaged.err);
  CHECK(damaged.status == kDone);
  CHECK(read_capture(folder / "run.2.viscap").status == "finished");
}

TEST_CASE("a reading that was marked implausible is read as a glitch", "[cli][capture]") {
  const ScratchFolder folder;
  leave_interrupted(folder / "old.viscap");
  CapturedRun about = read_capture(folder / "old.viscap");
  {
    CaptureWriter writer(folder / "run.viscap", about);
    for (int i = 0; i < 4; ++i) writer.append(LoadSample{.index = i, .counts = 1.0 * i});
    writer.append(RunEvent{0.0, "implausible", "2", "it stands out"});
    writer.finish("finished");
  }
  const CapturedRun run = read_capture(folder / "run.viscap");
  REQUIRE(run.load_samples.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) CHECK(run.load_samples[i].is_glitch == (i == 2));
}

TEST_CASE("capture refuses options that cannot be combined", "[cli][capture]") {
  CHECK(run_command({"capture", "--emulate"}).status == kBadWords);
  CHECK(run_command({"capture", "--emulate", "--out", "x.viscap", "--resume", "--force"}).status ==
        kBadWords);
  CHECK(run_command({"capture", "--out", "x.viscap"}).status == kBadWords);
  CHECK(run_command({"capture", "--emulate", "--out", "x.viscap", "--speed", "501"}).status ==
        kBadWords);
  if (isatty(STDIN_FILENO) != 1) {
    const ScratchFolder folder;
    const auto outcome =
        run_command({"capture", "--rig", demo("01_rig.toml"), "--test", demo("02_test.toml"),
                     "--specimen", demo("03_pdms_1to10.toml"), "--specimen",
                     demo("04_pdms_1to13.toml"), "--out", folder / "series"});
    CHECK(outcome.status == kBadWords);
    CHECK(contains(outcome.err, "--yes"));
  }
}

TEST_CASE("capture names a port that does not exist", "[cli][capture]") {
  const ScratchFolder folder;
  const auto outcome =
      run_command({"capture", "--rig", demo("01_rig.toml"), "--test", demo("02_test.toml"),
                   "--specimen", demo("03_pdms_1to10.toml"), "--out", folder / "run.viscap"});
  CHECK(outcome.status == kFailed);
  CHECK(contains(outcome.err,
                 "01_rig.toml:14: port under [stage]: there is no port '/dev/serial/by-id/stage'"));
  CHECK_FALSE(std::filesystem::exists(folder / "run.viscap"));
}

TEST_CASE("every command of a rig names the file and line of a port that it cannot use",
          "[cli][rig]") {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"check"}, {"touch"}, {"jog", "--away", "1 mm"}, {"home"}}) {
    std::vector<std::string> line{"rig"};
    line.insert(line.end(), words.begin(), words.end());
    line.insert(line.end(), {"--rig", demo("01_rig.toml")});
    const auto outcome = run_command(line);
    CAPTURE(line, outcome.err);
    CHECK(outcome.status == kFailed);
    CHECK(contains(outcome.err, "01_rig.toml:14: port under [stage]: there is no port"));
  }
  const ScratchFolder folder;
  std::string rig = read_file(demo("01_rig.toml"));
  const std::string cell = "/dev/serial/by-id/load_cell";
  const auto at = static_cast<std::ptrdiff_t>(rig.find(cell));
  const auto line = 1 + std::count(rig.begin(), rig.begin() + at, '\n');
  rig.replace(rig.find(cell), cell.size(), "tcp://bench");
  write_file(folder / "rig.toml", rig, false);
  CHECK(contains(run_command({"rig", "check", "--rig", folder / "rig.toml"}).err,
                 "rig.toml:" + std::to_string(line) +
                     ": port under [load_cell] 'tcp://bench' needs a host and a number"));
}

TEST_CASE("a capture that is given as another kind of test is refused with the words that fit it",
          "[cli][capture]") {
  const ScratchFolder folder;
  const std::string capture = folder / "run.viscap";
  leave_interrupted(capture);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"relaxation=" + capture}, {capture, "--kind", "creep"}}) {
    std::vector<std::string> line{"fit"};
    line.insert(line.end(), words.begin(), words.end());
    const auto outcome = run_command(line);
    CAPTURE(line, outcome.err);
    CHECK(contains(outcome.err,
                   "write indentation=" + capture + ", or give the file without a kind"));
    CHECK_FALSE(contains(outcome.err, "omit --kind"));
  }
}

TEST_CASE("a capture with --force replaces captures and empty files, and nothing else",
          "[cli][capture][pty]") {
  const ScratchFolder folder;
  const std::filesystem::path material = folder / "material", empty = folder / "empty.viscap",
                              misnamed = folder / "table.viscap";
  write_file(material, "{\"E0_Pa\": 1e6}\n", false);
  write_file(misnamed, "time_s,force_N\n0,1\n", false);
  write_file(empty, "", false);
  write_file(folder / "test.toml", kShortTest, false);
  const auto replaced = [&](const std::filesystem::path& file) {
    return run_command({"capture", "--emulate", "--speed", "200", "--test", folder / "test.toml",
                        "--out", file, "--force"});
  };
  for (const std::filesystem::path& file : {material, misnamed}) {
    const std::string before = read_file(file);
    const auto outcome = replaced(file);
    CAPTURE(file, outcome.err);
    CHECK(outcome.status == kFailed);
    CHECK(contains(outcome.err, "is no capture, so --force does not replace it"));
    CHECK(read_file(file) == before);
  }
  CHECK(replaced(empty).status == kDone);
  CHECK(replaced(empty).status == kDone);
}

TEST_CASE("a run that never begins leaves the capture that --force would have replaced",
          "[cli][capture][pty]") {
  const ScratchFolder folder;
  const std::filesystem::path capture = folder / "run.viscap";
  leave_interrupted(capture);
  const std::string before = read_file(capture);
  const PtyPort stage, load_cell;  // plugged in, and silent
  const auto outcome = replace_over_ports(folder, capture, stage.path(), load_cell.path());
  CAPTURE(outcome.err);
  CHECK(outcome.status == kFailed);
  CHECK(contains(outcome.err, "nothing came from the load cell"));
  CHECK(read_file(capture) == before);
  CHECK(read_capture(capture).specimen.id == "left behind");
  CHECK_FALSE(std::filesystem::exists(capture.string() + ".previous"));
}

TEST_CASE("a run refused because the punch presses leaves the capture that --force would replace",
          "[cli][capture][pty]") {
  const ScratchFolder folder;
  const std::filesystem::path capture = folder / "run.viscap";
  leave_interrupted(capture);
  const std::string before = read_file(capture);
  EmulatedRigOptions options;
  options.truth = demo_truth(10.0, 7);
  options.truth.surface_position_m = -0.3e-3;
  options.truth.overload_N = 100.0;
  options.config = demo_rig();
  options.is_on_wall_clock = true;  // its ports are opened as those of a real rig
  const EmulatedRig emulated(options);
  const auto outcome = replace_over_ports(folder, capture, emulated.config().stage.port,
                                          emulated.config().load_cell.port);
  CAPTURE(outcome.err);
  CHECK(outcome.status == kFailed);
  CHECK(contains(outcome.err, "the record that --force was to replace is kept"));
  CHECK(contains(outcome.err, "lifted"));
  CHECK(read_file(capture) == before);
  CHECK_FALSE(std::filesystem::exists(capture.string() + ".previous"));
}

TEST_CASE("a capture that --force replaces keeps its rights", "[cli][capture][pty]") {
  const ScratchFolder folder;
  const std::filesystem::path capture = folder / "run.viscap";
  leave_interrupted(capture);
  const auto is_private = [&] {
    using std::filesystem::perms;
    return (std::filesystem::status(capture).permissions() & perms::all) ==
           (perms::owner_read | perms::owner_write);
  };
  std::filesystem::permissions(
      capture, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  REQUIRE(is_private());
  write_file(folder / "test.toml", kShortTest, false);
  REQUIRE(run_command({"capture", "--emulate", "--speed", "100", "--test", folder / "test.toml",
                       "--out", capture, "--force"})
              .status == kDone);
  CHECK(read_capture(capture).status == "finished");
  CHECK(is_private());
  { CaptureWriter direct(capture, CapturedRun(read_capture(capture)), {.overwrite = true}); }
  CHECK(is_private());
}

TEST_CASE("a doubt of a run is a flag of the fit", "[cli][capture][pty]") {
  const ScratchFolder folder;
  const std::string file = folder / "run.viscap";
  write_file(folder / "test.toml", kShortTest, false);
  REQUIRE(run_command({"capture", "--emulate", "--speed", "100", "--test", folder / "test.toml",
                       "--out", file})
              .status == kDone);
  const auto has_flag = [&] {
    // The event that is written below has no checksum, so that the result is not trusted.
    const auto fit = run_command({"fit", file, "--json", "--unverified"});
    CAPTURE(fit.err);
    REQUIRE_FALSE(fit.out.empty());
    const auto flags = nlohmann::json::parse(fit.out)["flags"].dump();
    return contains(flags, "line-noise") && contains(flags, "3 lines could not be read");
  };
  CHECK_FALSE(has_flag());
  Database(file, Database::Access::kReadWrite)
      .execute(
          "INSERT INTO events (host_time_s, name, value, text) VALUES (1.0, 'doubt', "
          "'line_noise', '3 lines could not be read')");
  CHECK(has_flag());
}

TEST_CASE("a damaged capture is never taken for a table", "[cli][capture]") {
  const ScratchFolder folder;
  const std::string file = folder / "run.viscap";
  write_file(file, "garbled, and no longer what it was\n", false);
  const auto weights = run_command(
      {"calibrate", "--data", file, "--rig", demo("01_rig.toml"), "--out", folder / "c.toml"});
  CHECK(weights.status == kFailed);
  CHECK(contains(weights.err, "not a table of weights"));
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"fit", file},
        {"report", file, "--out", folder / "r.html"},
        {"calibrate", "--compliance", "--data", file, "--out", folder / "f.toml"}}) {
    const auto outcome = run_command(words);
    CAPTURE(words[0], outcome.err);
    CHECK(outcome.status == kFailed);
    CHECK(contains(outcome.err, "run.viscap"));
    CHECK(contains(outcome.err, "capture"));
  }
}

TEST_CASE("options of rig check are refused by the other subcommands", "[cli][rig]") {
  const auto outcome = run_command({"rig", "overshoot", "--rig", "none.toml"});
  CHECK(outcome.status == kBadWords);
  CHECK(contains(outcome.err, "--rig is for viscard rig list, check, touch, jog, lift, home"));
  const auto listed = run_command({"rig", "list", "--seconds", "1"});
  CHECK(listed.status == kBadWords);
  CHECK(contains(listed.err, "--seconds is for viscard rig check or touch"));
}

TEST_CASE("rig home has no speed and no limit of its own", "[cli][rig]") {
  for (const std::vector<std::string>& option :
       {std::vector<std::string>{"--speed", "1 mm/s"}, {"--limit", "0.5 N"}}) {
    const auto outcome = run_command({"rig", "home", "--emulate", option[0], option[1]});
    CHECK(outcome.status == kBadWords);
    CHECK(contains(outcome.err, option[0] + " is for rig jog and rig lift"));
  }
}

TEST_CASE("rig list and rig check report what they find and what is wrong", "[cli][rig][pty]") {
  CHECK(run_command({"rig", "list"}).status == kDone);
  CHECK(nlohmann::json::parse(run_command({"rig", "list", "--json"}).out)["ports"].is_array());
  CHECK(run_command({"rig"}).status == kBadWords);
  CHECK(run_command({"rig", "check"}).status == kBadWords);
  CHECK(run_command({"rig", "check", "--emulate", "--seconds", "0"}).status == kBadWords);
  const auto missing = run_command({"rig", "check", "--rig", demo("01_rig.toml")});
  CHECK(missing.status == kFailed);
  CHECK(contains(missing.err, "there is no port"));
  const auto found = run_command({"rig", "check", "--emulate", "--seconds", "1", "--json"});
  CHECK(found.status == kDone);
  const auto json = nlohmann::json::parse(found.out);
  CHECK(json["stage"]["identity"] == "Grbl 1.1h");
  CHECK(json["load_cell"]["rate_Hz"].get<double>() == Approx(80.0).epsilon(0.1));  // 80 readings
}

}  // namespace viscard
