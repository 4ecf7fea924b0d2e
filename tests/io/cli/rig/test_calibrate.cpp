#include "io/basics/atomic_file.h"
#include "io/capture/integrity_notes.h"
#include "io/cli/rig/rig_commands.h"
#include "io/config/config_file.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <sstream>

namespace viscard {
namespace {

using Catch::Matchers::Contains;
using Json = nlohmann::json;
using test::ScratchFolder;

struct Calibrated {
  int status = 0;
  std::string out, err;
};

Calibrated calibrate(const std::vector<std::string>& words) {
  std::ostringstream out, err;
  Streams streams{out, err, false};
  Calibrated result;
  result.status = run_calibrate(words, streams);
  result.out = out.str();
  result.err = err.str();
  return result;
}

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path) << text;
}

// A cell that differs from its data sheet: gain 2 % high, nonlinearity, hysteresis, noise, zero.
std::string truth_file(const ScratchFolder& folder) {
  write(
      folder / "truth.toml",
      "seed = 5\n"
      "[contact]\npunch_diameter = \"4 mm\"\nlayer_thickness = \"11 mm\"\npoisson_ratio = 0.495\n"
      "[material]\nE0 = \"1.88 MPa\"\n"
      "[rig]\nframe_stiffness = \"12.5 N/mm\"\nforce_noise = \"0.5 mN\"\nforce_offset = \"20 mN\"\n"
      "drift_relative = \"0 1/s\"\noverload = \"375 gf\"\ncell_gain = \"0.7400 V/N\"\n"
      "cell_full_scale = \"1.9613 N\"\ncell_hysteresis = 0.003\ncell_nonlinearity = 0.001\n");
  return (folder / "truth.toml").string();
}

}  // namespace

TEST_CASE("dead weights on the emulated rig recover gain and hysteresis within their interval",
          "[cli][pty]") {
  const ScratchFolder folder;
  const std::string out = (folder / "cell.toml").string();
  const Calibrated run =
      calibrate({"--emulate", "--truth", truth_file(folder), "--speed", "50", "--series", "2",
                 "--gravity", "9.80665 m/s2", "--out", out, "--json"});
  REQUIRE(run.status == kDone);
  const Json found = Json::parse(run.out);
  const double gain = found["gain_V_N"];
  const double gain_u = found["gain_u_V_N"];
  CHECK(std::abs(gain - 0.74) < 2.0 * gain_u);
  CHECK(gain_u / gain < 2e-3);  // bow and loop, rectangular: 1.0e-3 and .9e-3
  CHECK(found["gain_interval_95"][0].get<double>() < 0.74);
  CHECK(found["gain_interval_95"][1].get<double>() > 0.74);
  CHECK(found["hysteresis"].get<double>() == Approx(0.003).epsilon(0.05));  // noise of the means
  CHECK(found["repeatability"].get<double>() < 1e-4);
  CHECK(found["n_series"] == 2);
  CHECK(found["budget"].size() == 5);
  // A rig file can name the record.
  const CalibrationRecord record = read_calibration(out);
  REQUIRE(record.calibration.has_value());
  CHECK(record.calibration->volts_per_newton == gain);
  CHECK(record.calibration->capacity_N == Approx(2.4517).epsilon(1e-4));
  CHECK(record.calibration->date.size() == 10);
  CHECK(record.calibration->valid_until > record.calibration->date);
  write(folder / "rig.toml",
        "[stage]\nport = \"/dev/null\"\n[load_cell]\nport = \"/dev/null\"\nvolts_per_count = 1e-6\n"
        "[calibration]\nfile = \"cell.toml\"\n[frame]\nstiffness = \"rigid\"\n");
  const RigConfig rig = read_rig(folder / "rig.toml");
  CHECK(rig.calibration.volts_per_newton == gain);
  CHECK(rig.calibration.id == record.calibration->id);
  CHECK(rig_from_toml(toml_from_rig(rig), "again").calibration.volts_per_newton == gain);
  // What was edited since carries that in its name wherever the calibration goes.
  std::string text = read_file(out);
  text.insert(text.find("capacity"), "# by hand\n");
  write_file(out, text, true);
  CapturedRun captured;
  captured.rig = read_rig(folder / "rig.toml");
  CHECK(captured.rig.calibration.id == record.calibration->id + " (edited)");
  captured.integrity.has_checksums = true;
  REQUIRE(integrity_notes(captured).size() == 1);
  CHECK(integrity_notes(captured)[0].name == "calibration-edited");
  write_file(out, text.substr(text.find('\n') + 1),
             true);  // without the sum: of before, or by hand
  CHECK(read_rig(folder / "rig.toml").calibration.id == record.calibration->id);
}

TEST_CASE("a rigid block on the emulated rig recovers the frame's stiffness within its interval",
          "[cli][pty]") {
  const ScratchFolder folder;
  const std::string out = (folder / "frame.toml").string();
  write(folder / "truth.toml",
        "[contact]\npunch_diameter = \"4 mm\"\nlayer_thickness = \"half-space\"\npoisson_ratio = "
        "0.3\n"
        "[material]\nE0 = \"200 GPa\"\n"
        "[rig]\nframe_stiffness = \"12.5 N/mm\"\nsurface_position = \"0.3 mm\"\n"
        "force_noise = \"0.5 mN\"\noverload = \"375 gf\"\n");
  const Calibrated run =
      calibrate({"--compliance", "--emulate", "--truth", (folder / "truth.toml").string(),
                 "--speed", "10", "--seconds", "1 s", "--steps", "5", "--out", out, "--json"});
  REQUIRE(run.status == kDone);
  const Json found = Json::parse(run.out);
  CHECK(found["n_points"] == 5);
  const double stiffness_N_m = found["stiffness_N_m"];
  CHECK(stiffness_N_m == Approx(12.5e3).epsilon(0.005));
  CHECK(found["stiffness_interval_95"][0].get<double>() < 12.5e3);
  CHECK(found["stiffness_interval_95"][1].get<double>() > 12.5e3);
  CHECK(found["curvature_m"].get<double>() < 0.5e-6);  // a step of the stage is .3 um
  CHECK(read_calibration(out).frame->stiffness_N_m == stiffness_N_m);
}

TEST_CASE("a table of weights and readings makes a calibration too", "[cli]") {
  const ScratchFolder folder;
  std::string table = "mass (g),voltage (mV)\n";
  for (const double mass_g : {0.0, 50.0, 100.0, 200.0, 100.0, 50.0, 0.0}) {
    const double force_N = mass_g * 1e-3 * 9.81 * (1.0 - 1.2 / 8000.0);
    table += std::to_string(mass_g) + "," + std::to_string(1e3 * (0.7255 * force_N + 0.01)) + "\n";
  }
  table += "100,n/a\n50,\n";  // readings that were missed
  write(folder / "weights.csv", table);
  const std::string out = (folder / "cell.toml").string();
  const std::vector<std::string> words{"--data",     (folder / "weights.csv").string(),
                                       "--capacity", "250 gf",
                                       "--gravity",  "9.81 m/s2",
                                       "--id",       "cell 7",
                                       "--out",      out};
  const Calibrated run = calibrate(words);
  CHECK(run.status == kDone);
  CHECK_THAT(run.err, Contains("2 rows without a number left out"));
  CHECK_THAT(run.out, Contains("cell 7"));
  CHECK_THAT(run.out, Contains("budget"));
  CHECK_THAT(run.out, Contains("not measured: go up and down more than once"));
  CHECK(read_calibration(out).calibration->volts_per_newton == Approx(0.7255).epsilon(1e-6));
  CHECK_THROWS_WITH(calibrate(words), Contains("exists already"));
}

TEST_CASE("mixed-up weights make no record, and the error names the reading", "[cli]") {
  const ScratchFolder folder;
  const std::vector<double> asked_g{0.0, 20.0, 50.0, 100.0, 200.0, 100.0, 50.0, 20.0, 0.0};
  std::vector<double> put_g = asked_g;
  put_g[6] = 20.0;  // the seventh reading
  std::string table = "mass_kg,volts_V\n";
  for (std::size_t i = 0; i < asked_g.size(); ++i) {
    table += std::to_string(asked_g[i] * 1e-3) + "," +
             std::to_string(0.1 + 0.7255 * 9.80665e-3 * put_g[i]) + "\n";
  }
  write(folder / "weights.csv", table);
  const std::string out = (folder / "cell.toml").string();
  const std::vector<std::string> words{
      "--data", (folder / "weights.csv").string(), "--capacity", "250 gf", "--out", out};
  CHECK_THROWS_WITH(calibrate(words), Contains("reading 7 of 9") && Contains("mixed up"));
  CHECK_FALSE(std::filesystem::exists(out));
}

TEST_CASE("readings of a test calibrate neither a frame nor a load cell", "[cli]") {
  const ScratchFolder folder;
  // As viscard export writes them: in air, pressed down, held while the specimen relaxes.
  std::string test = "time_s,host_time_s,volts,force_N,stage_position_m,phase\n";
  std::string bare = "position_m,force_N\n";
  for (int i = 0; i < 60; ++i) {
    const double position_m = 25e-6 * std::min(i, 40);
    const double pressed_N = 8e3 * std::max(0.0, position_m - 800e-6);
    const double force_N = i <= 40 ? pressed_N : pressed_N * (0.6 + 0.4 / (i - 39));
    const std::string place = std::to_string(position_m) + ",";
    test += std::to_string(0.1 * i) + "," + std::to_string(0.1 * i) + "," +
            std::to_string(0.7255 * force_N) + "," + std::to_string(force_N) + "," + place +
            (i <= 40 ? "ramp\n" : "hold\n");
    bare += place + std::to_string(force_N) + "\n";
  }
  write(folder / "test.csv", test);
  write(folder / "bare.csv", bare);
  const std::string out = (folder / "o.toml").string();
  const std::string exported = (folder / "test.csv").string();
  CHECK_THROWS_WITH(calibrate({"--compliance", "--data", exported, "--out", out}),
                    Contains("a table of viscard export") && Contains("--compliance --data"));
  CHECK_THROWS_WITH(calibrate({"--data", exported, "--capacity", "250 gf", "--out", out}),
                    Contains("a table of viscard export") && Contains("mass_kg"));
  CHECK_THROWS_WITH(
      calibrate({"--compliance", "--data", (folder / "bare.csv").string(), "--out", out}),
      Contains("no frame on a rigid block"));
  CHECK_FALSE(std::filesystem::exists(out));
}

TEST_CASE("wrong options of calibrate are named", "[cli]") {
  CHECK_THROWS_AS(calibrate({"--out", "x.toml"}), UsageError);
  CHECK_THROWS_WITH(calibrate({"--emulate"}), Contains("--out"));
  CHECK_THROWS_WITH(calibrate({"--emulate", "--out", "x.toml", "--weights", "20 V"}),
                    Contains("--weights"));
  CHECK_THROWS_WITH(calibrate({"--emulate", "--out", "x.toml", "--weights", "300 g"}),
                    Contains("300 g is more than"));
  CHECK_THROWS_WITH(calibrate({"--emulate", "--out", "x.toml", "--weights", "20 g, 20"}),
                    Contains("20 without a unit, in kg,") && Contains("write \"20 g\""));
  // Before anything is put on: the slow clock would take minutes.
  for (const char* weights : {"20 g", "100 g,100 g", "0 g, 100 g"}) {
    CHECK_THROWS_WITH(calibrate({"--emulate", "--out", "x.toml", "--weights", weights}),
                      Contains("fewer than two different weights"));
  }
  CHECK_THROWS_WITH(calibrate({"--emulate", "--out", "x.toml", "--capacity", "100 gf"}),
                    Contains("is more than the load cell's"));
  CHECK_THROWS_WITH(calibrate({"--emulate", "--out", "x.toml", "--gravity", "1.6 m/s2"}),
                    Contains("does not occur on Earth"));
  CHECK_THROWS_WITH(calibrate({"--emulate", "--out", "x.toml", "--valid-until", "2020-01-31"}),
                    Catch::Contains("--valid-until 2020-01-31 is in the past"));
  CHECK_THROWS_WITH(calibrate({"--emulate", "--out", "x.toml", "--valid-until", "soon"}),
                    Contains("'soon'"));
  for (const char* day :
       {"2099-02-31", "2098-13-01", "2098-06-31", "2099-02-29", "2098-6-3", "2098-06-03T10:00"}) {
    CAPTURE(day);
    CHECK_THROWS_WITH(calibrate({"--emulate", "--out", "x.toml", "--valid-until", day}),
                      Contains("--valid-until '" + std::string(day) + "'") &&
                          Contains("is not a day of the calendar"));
  }
}

TEST_CASE("options of calibrate that belong to weights, a block or the rig alone are refused there",
          "[cli]") {
  const ScratchFolder folder;
  write(folder / "forces.csv",
        "force_N,volts_V\n0,0.001\n0.5,0.351\n1,0.701\n0.5,0.351\n0,0.001\n");
  write(folder / "block.csv", "position_m,force_N\n0,0.2\n0.00001,0.4\n0.00002,0.6\n");
  const std::string out = (folder / "o.toml").string();
  const std::vector<std::string> weights{"--emulate", "--out", out},
      block{"--emulate", "--compliance", "--out", out},
      table{"--data", (folder / "forces.csv").string(), "--capacity", "250 gf", "--out", out},
      points{"--data", (folder / "block.csv").string(), "--compliance", "--out", out};
  struct Idle {
    std::vector<std::string> words;
    const char *option, *value;
  };
  for (const auto& [words, option, value] : {Idle{weights, "--to", "1 N"},
                                             Idle{weights, "--steps", "5"},
                                             Idle{weights, "--unverified", ""},
                                             Idle{block, "--weights", "20 g,50 g"},
                                             Idle{block, "--series", "2"},
                                             Idle{block, "--mass-u", "1e-3"},
                                             Idle{block, "--gravity", "9.81 m/s2"},
                                             Idle{block, "--nonlinearity", "0.002"},
                                             Idle{block, "--settle", "1 s"},
                                             Idle{block, "--capacity", "250 gf"},
                                             Idle{block, "--span", "1 V"},
                                             Idle{block, "--valid-until", "2099-01-01"},
                                             Idle{table, "--weights", "20 g,50 g"},
                                             Idle{table, "--series", "2"},
                                             Idle{table, "--settle", "1 s"},
                                             Idle{table, "--seconds", "1 s"},
                                             Idle{table, "--to", "1 N"},
                                             Idle{table, "--gravity", "9.81 m/s2"},
                                             Idle{points, "--seconds", "1 s"},
                                             Idle{points, "--to", "1 N"},
                                             Idle{points, "--steps", "5"}}) {
    std::vector<std::string> all = words;
    all.emplace_back(option);
    if (*value != '\0') all.emplace_back(value);
    CAPTURE(all);
    CHECK_THROWS_WITH(calibrate(all),
                      Contains(std::string(option) + " is for") && Contains("omit it"));
  }
  for (std::vector<std::string> words : {points, table}) {
    words.emplace_back("--yes");
    CHECK_THROWS_WITH(calibrate(words), Contains("--yes is for a block on the rig"));
    words.back() = "--unverified";
    CHECK_THROWS_WITH(calibrate(words), Contains("--unverified is for captures"));
  }
  CHECK_THROWS_WITH(calibrate({"--emulate", "--out", out, "--id", ""}), Contains("--id is empty"));
  CHECK_THROWS_WITH(calibrate({"--emulate", "--data", "w.csv", "--out", out}),
                    Contains("--data and --emulate exclude each other"));
  CHECK_THROWS_WITH(calibrate({"--rig", "none.toml", "--out", out, "--yes"}),
                    Contains("--yes is for a block"));
}

}  // namespace viscard
