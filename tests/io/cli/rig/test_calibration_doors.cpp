// Calibrations that cannot be right are refused at every door.
#include "io/basics/atomic_file.h"
#include "io/cli/rig/rig_commands.h"
#include "io/config/config_file.h"
#include "io/flow/capture_setup.h"
#include "tests/support/scratch_folder.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <fstream>
#include <sstream>

namespace viscard {
namespace {

using Catch::Matchers::Contains;
using Json = nlohmann::json;
using test::ScratchFolder;

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path) << text;
}

// Readings of a cell of 0.7255 V/N under masses, with both columns off by a factor.
std::string weights(double mass_factor, double volts_factor, const char* header) {
  std::ostringstream table;
  table.precision(12);
  table << header << "\n";
  for (const double mass_kg : {0.0, 0.02, 0.05, 0.1, 0.2, 0.1, 0.05, 0.02, 0.0}) {
    table << mass_factor * mass_kg << "," << volts_factor * (0.02 + 0.7255 * 9.80665 * mass_kg)
          << "\n";
  }
  return table.str();
}

class Door {
 public:
  Door() { write(folder_ / "weights.csv", weights(1.0, 1.0, "mass_kg,volts_V")); }
  const ScratchFolder& folder() const { return folder_; }
  std::string record() const { return (folder_ / "cell.toml").string(); }
  // The object that calibrate prints.
  Json calibrate(const std::string& table, const Words& more = {}) const {
    write(folder_ / "weights.csv", table);
    Words words{"--data",     (folder_ / "weights.csv").string(),
                "--capacity", "250 gf",
                "--gravity",  "9.80665 m/s2",
                "--out",      record(),
                "--json"};
    words.insert(words.end(), more.begin(), more.end());
    std::ostringstream out, err;
    Streams streams{out, err, false};
    run_calibrate(words, streams);
    return Json::parse(out.str());
  }
  // A rig file with these lines in [calibration], from line 5 on.
  std::filesystem::path rig(const std::string& calibration, const std::string& cell = "") const {
    write(folder_ / "rig.toml",
          "[stage]\nport = \"/dev/null\"\n[load_cell]\nport = \"/dev/null\"\n" + cell +
              "[calibration]\n" + calibration + "[frame]\nstiffness = \"rigid\"\n");
    return folder_ / "rig.toml";
  }

 private:
  ScratchFolder folder_;
};

}  // namespace

TEST_CASE("a table of weights with a wrong sign or a column a thousand times off makes no record",
          "[cli]") {
  const Door door;
  struct Case {
    double mass, volts;
    const char* header;
    const char* words;
  };
  const auto [mass, volts, header, words] =
      GENERATE(Case{1.0, -1.0, "mass_kg,volts_V", "the gain is negative"},
               Case{1e3, 1.0, "mass_kg,volts_V", "above the capacity"},
               Case{1.0, 1.0, "mass_g,volts_V", "gain x capacity"},
               Case{1e-3, 1.0, "mass_kg,volts_V", "above the span of the converter, 10 V"},
               Case{1.0, 1e3, "mass_kg,volts_V", "beyond the span of the converter, 10 V"},
               Case{1.0, 1e-6, "mass_kg,volts_V", "less than any bridge gives"});
  CAPTURE(mass, volts, header);
  const std::string table = weights(mass, volts, header);
  CHECK_THROWS_WITH(door.calibrate(table), Contains(words) && Contains("weights.csv"));
  CHECK_FALSE(exists(door.folder() / "cell.toml"));
}

TEST_CASE("a record with the line ends of Windows is not edited, and a number changed in it is",
          "[cli]") {
  const Door door;
  door.calibrate(weights(1.0, 1.0, "mass_kg,volts_V"));
  const std::string id = read_calibration(door.record()).calibration->id;
  std::string text;
  for (const char c : read_file(door.record())) text += c == '\n' ? "\r\n" : std::string(1, c);
  write(door.record(), text);
  CHECK(read_calibration(door.record()).calibration->id == id);
  const std::size_t at = text.find("volts_per_newton = 0.7");
  REQUIRE(at != std::string::npos);
  text.replace(at, 22, "volts_per_newton = 0.8");
  write(door.record(), text);
  CHECK(read_calibration(door.record()).calibration->id == id + " (edited)");
}

TEST_CASE("with the span of the converter, volts that are millivolts are refused, too", "[cli]") {
  const Door door;
  const std::string table = weights(1.0, 1e-3, "mass_kg,volts_V");
  CHECK_THROWS_WITH(door.calibrate(table, {"--span", "10 V"}),
                    Contains("% of the span") && Contains("mV for V"));
  const std::string rig = door.rig("volts_per_newton = 1\ncapacity = \"250 gf\"\n").string();
  CHECK_THROWS_WITH(door.calibrate(table, {"--rig", rig}), Contains("% of the span"));
  // A bridge of some mV behind an HX711 has such readings by right.
  CHECK_NOTHROW(door.calibrate(table, {"--span", "20 mV"}));
}

TEST_CASE("a record states its range and the gain's uncertainty at each force", "[cli]") {
  const Door door;
  const Json found = door.calibrate(weights(0.1, 0.1, "mass_kg,volts_V"));  // up to 20 g
  const LoadCellCalibration cell = *read_calibration(door.record()).calibration;
  CHECK(cell.largest_force_N == Approx(0.02 * 9.80665).epsilon(1e-3));
  CHECK(found["in_use_N"].get<double>() == Approx(cell.capacity_N));
  CHECK(found["gain_u_V_N"].get<double>() == cell.volts_per_newton_u);
  for (const Json& at : found["gain_at"]) {
    CHECK(at["relative_u"].get<double>() == gain_relative_u(cell, at["force_N"].get<double>()));
  }
  CHECK(gain_relative_u(cell, cell.largest_force_N) < 1.2e-4);
}

TEST_CASE("the data sheet's nonlinearity stands where the weights do not reach", "[cli]") {
  const Door door;
  std::string table = "mass_kg,volts_V\n";  // noise of 0.1 % hides every parabola
  for (const char* row : {"0,0.0200", "0.005,0.0557", "0.01,0.0910", "0.02,0.1622", "0.01,0.0913",
                          "0.005,0.0555", "0,0.0201"}) {
    table += std::string(row) + "\n";
  }
  const auto at_capacity = [&](const Words& more) {
    Words words{"--force"};
    words.insert(words.end(), more.begin(), more.end());
    return door.calibrate(table, words)["gain_at"].back()["relative_u"].get<double>();
  };
  const double usual = at_capacity({});
  const double good = at_capacity({"--nonlinearity", "0.0003"});
  CHECK(good < usual);
  CHECK_THROWS_AS(at_capacity({"--nonlinearity", "0.5"}), UsageError);
}

TEST_CASE("weights that press a cell to its negative side give a positive gain", "[cli]") {
  const Door door;
  const std::string rig =
      door.rig("volts_per_newton = 1\ncapacity = \"250 gf\"\n", "compression_is_positive = false\n")
          .string();
  const Json found = door.calibrate(weights(1.0, -1.0, "mass_kg,volts_V"), {"--rig", rig});
  CHECK(found["gain_V_N"].get<double>() == Approx(0.7255).epsilon(1e-3));
  CHECK(found["zero_V"].get<double>() == Approx(-0.02).epsilon(1e-6));
}

TEST_CASE("a rig file with an unbelievable gain is refused with its line", "[cli][config]") {
  const Door door;
  CHECK_THROWS_WITH(
      read_rig(door.rig("volts_per_newton = \"-0.7255 V/N\"\ncapacity = \"250 gf\"\n")),
      Contains("rig.toml:6: calibration.volts_per_newton") && Contains("negative"));
  CHECK_THROWS_WITH(
      read_rig(door.rig("volts_per_newton = \"725 V/N\"\ncapacity = \"250 gf\"\n")),
      Contains("rig.toml:6: calibration.volts_per_newton") && Contains("above the span"));
  CHECK_THROWS_WITH(
      read_rig(door.rig("capacity = \"250 kgf\"\nvolts_per_newton = \"0.7255 V/N\"\n")),
      Contains("rig.toml:7: calibration.volts_per_newton") && Contains("correct capacity"));
  CHECK_NOTHROW(read_rig(door.rig("volts_per_newton = \"0.7255 V/N\"\ncapacity = \"250 gf\"\n")));
  // Before its first calibration a rig has a guess, or the name of a record to come.
  const auto guess = door.rig("volts_per_newton = \"1 V/N\"\ncapacity = \"250 gf\"\n",
                              "volts_per_count = \"2.384 nV\"\n");
  CHECK_THROWS(read_rig(guess));
  CHECK(read_rig_to_calibrate(guess).calibration.capacity_N == Approx(2.4517).epsilon(1e-4));
  CHECK(read_rig_to_calibrate(door.rig("file = \"none.toml\"\ncapacity = \"250 gf\"\n"))
            .calibration.capacity_N == Approx(2.4517).epsilon(1e-4));
}

TEST_CASE("a record that was edited by hand is refused with its own line, by every door",
          "[cli][config]") {
  const Door door;
  const std::string record =
      "[calibration]\nid = \"cell 7\"\ndate = 2026-01-15\ncapacity = \"250 gf\"\n"
      "volts_per_newton = ";
  write(door.folder() / "cell.toml", record + "\"0.7255 V/N\"\n");
  const auto rig = door.rig("file = \"cell.toml\"\n");
  CHECK(read_rig(rig).calibration.largest_force_N == 0.0);  // of before: its range is not known
  write(door.folder() / "cell.toml", record + "\"-0.7255 V/N\"\n");
  const auto is_named = Contains("cell.toml:5: calibration.volts_per_newton");
  CHECK_THROWS_WITH(read_rig(rig), is_named);
  CHECK_THROWS_WITH(setup_from_files({.rig_file = rig.string(), .is_emulated = true}), is_named);
  // A configuration that did not come from a file meets the same check before it moves.
  CaptureSetup setup = setup_from_files({.is_emulated = true});
  setup.rig.calibration.volts_per_newton = GENERATE(-0.7255, 725.5, 0.7255e-3);
  CHECK_THROWS_WITH(safe_preflight(setup), Contains("calibration.volts_per_newton"));
}

TEST_CASE("a frame whose positions are in mm where the column says m makes no record", "[cli]") {
  const Door door;
  std::string table = "position_m,force_N\n";
  for (int i = 1; i <= 8; ++i) {
    table += std::to_string(0.02 * i) + "," + std::to_string(0.2 * i) + "\n";
  }
  const auto calibrate = [&](const std::string& header) {
    write(door.folder() / "block.csv", header + table.substr(table.find('\n')));
    std::ostringstream out, err;
    Streams streams{out, err, false};
    return run_calibrate({"--compliance", "--data", (door.folder() / "block.csv").string(), "--out",
                          (door.folder() / "frame.toml").string()},
                         streams);
  };
  CHECK_THROWS_WITH(calibrate("position_m,force_N"), Contains("10 N/m; expected 100 N/m"));
  CHECK_FALSE(exists(door.folder() / "frame.toml"));
  CHECK(calibrate("position_mm,force_N") == kDone);
  CHECK(read_calibration(door.folder() / "frame.toml").frame->stiffness_N_m == Approx(10e3));
}

TEST_CASE("a test far above the weights of the calibration is announced with the numbers",
          "[cli]") {
  CaptureSetup setup = setup_from_files({.is_emulated = true});
  CHECK(safe_preflight(setup).warnings.empty());
  setup.rig.calibration.largest_force_N = 0.2;
  setup.rig.calibration.common_u = 2e-4;
  setup.rig.calibration.curvature_u = 2e-3;
  const std::vector<std::string> warnings = safe_preflight(setup).warnings;
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Contains("times the largest one of the load cell's calibration, 0.2 N"));
}

}  // namespace viscard
