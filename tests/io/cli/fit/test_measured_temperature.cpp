// The temperature that a thermometer measured, from the capture to the material.
#include "io/basics/atomic_file.h"
#include "io/capture/capture_file.h"
#include "io/materials/material_file.h"
#include "tests/io/cli/fit/table_folder.h"
#include "tests/support/in_memory_run.h"
#include "tests/support/run_command.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace viscard;
using namespace viscard::test;
using Catch::Contains;

namespace {

// A capture whose thermometer goes from 24 to 24 + drift_K.
void write_warm_capture(const std::string& path, double drift_K) {
  CapturedRun captured = in_memory_run(demo_truth(13, 4), {});
  captured.specimen.id = "pdms-1to13";
  captured.specimen.rho_kg_m3 = 965.0;
  captured.specimen.temperature_C = 20.0;  // a note that is wrong
  captured.rig.thermometer.driver = "text";
  CaptureWriter writer(path, captured);
  for (const LoadSample& sample : captured.load_samples) writer.append(sample);
  for (const CommandedMove& move : captured.moves) writer.append(move);
  writer.append(RunEvent{0.0, "tare", "0.013", ""});
  const double surface_m = demo_truth(13, 4).surface_position_m;
  writer.append(RunEvent{0.0, "contact", std::to_string(surface_m), ""});
  const double end_s = captured.load_samples.back().host_time_s;
  for (int i = 0; i <= 40; ++i) {
    writer.append(TemperatureSample{end_s * i / 40.0, 24.0 + drift_K * i / 40.0});
  }
  writer.finish("finished");
}

bool has_flag(const nlohmann::json& json, const std::string& name) {
  for (const auto& flag : json["flags"]) {
    if (flag["name"] == name) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("a measured temperature is reported by the fit and becomes that of the material",
          "[cli]") {
  const TableFolder folder;
  write_warm_capture(folder.file("run.viscap"), 0.5);
  const CommandOutcome ran =
      run_command({"fit", folder.file("run.viscap"), "--out", folder.file("m.json")});
  CHECK(ran.err == "");
  REQUIRE(ran.status == kDone);
  CHECK_THAT(ran.out, Contains("temperature 24.25 C, measured: 24.00 to 24.50 C in 41 readings"));
  CHECK(*read_material(folder.file("m.json")).material.T_ref_C == Approx(24.25).epsilon(1e-12));
  const auto json =
      nlohmann::json::parse(run_command({"fit", folder.file("run.viscap"), "--json"}).out);
  CHECK(json["temperature"]["mean_C"].get<double>() == Approx(24.25).epsilon(1e-12));
  CHECK(json["temperature"]["min_C"] == 24.0);
  CHECK(json["temperature"]["max_C"] == 24.5);
  CHECK(json["temperature"]["n_readings"] == 41);
  CHECK_FALSE(has_flag(json, "temperature-drift"));
}

TEST_CASE("a temperature that drifts is flagged, and the exported table has it too", "[cli]") {
  const TableFolder folder;
  write_warm_capture(folder.file("run.viscap"), 1.5);
  const auto json =
      nlohmann::json::parse(run_command({"fit", folder.file("run.viscap"), "--json"}).out);
  CHECK(has_flag(json, "temperature-drift"));
  REQUIRE(
      run_command({"export", folder.file("run.viscap"), "--out", folder.file("run.csv")}).status ==
      kDone);
  CHECK_THAT(read_file(folder.file("run.csv")), Contains(",temperature_C,phase"));
  const CommandOutcome of_table = run_command({"fit", folder.file("run.csv"), "--json"});
  INFO(of_table.err);
  const auto table = nlohmann::json::parse(of_table.out);
  CHECK(table["temperature"]["min_C"] == 24.0);
  CHECK(table["temperature"]["max_C"].get<double>() == Approx(25.5).margin(0.05));
}

TEST_CASE("a rig check and a capture on an emulated rig show the thermometer", "[cli]") {
  const TableFolder folder;
  const std::string rig =
      folder.write("rig.toml",
                   "[thermometer]\ndriver = \"text\"\n"
                   "[calibration]\nvolts_per_newton = \"0.7255 V/N\"\ncapacity = \"250 gf\"\n"
                   "[frame]\nstiffness = \"10 N/mm\"\n");
  const CommandOutcome check = run_command({"rig", "check", "--emulate", "--rig", rig, "--json"});
  CHECK(nlohmann::json::parse(check.out)["thermometer"]["temperature_C"] == 23.4);
  CHECK_THAT(run_command({"rig", "check", "--emulate", "--rig", rig}).out,
             Contains("thermometer 23.40 C"));
  const std::string test =
      folder.write("test.toml",
                   "[approach]\nspeed = \"0.2 mm/s\"\nbaseline = \"1 s\"\n"
                   "[ramp]\ndepth = \"0.13 mm\"\nhold = \"3 s\"\n[recovery]\nhold = \"2 s\"\n");
  const CommandOutcome capture =
      run_command({"capture", "--emulate", "--speed", "500", "--rig", rig, "--test", test, "--out",
                   folder.file("run.viscap"), "--json"});
  REQUIRE(capture.status == kDone);
  CHECK(nlohmann::json::parse(capture.out)["temperature"]["mean_C"] == 23.4);
  CHECK(read_capture(folder.file("run.viscap")).temperatures.size() > 5);
}

TEST_CASE("a fit of several tests states what the run of a capture reported", "[cli]") {
  const TableFolder folder;
  CapturedRun captured = in_memory_run(demo_truth(13, 4), {});
  captured.rig.stage.depth_relative_u = 0.0;
  {
    CaptureWriter writer(folder.file("run.viscap"), captured);
    for (const LoadSample& sample : captured.load_samples) writer.append(sample);
    for (const CommandedMove& move : captured.moves) writer.append(move);
    writer.append(RunEvent{0.0, "tare", "0.013", ""});
    const double surface_m = demo_truth(13, 4).surface_position_m;
    writer.append(RunEvent{0.0, "contact", std::to_string(surface_m), ""});
    writer.append(RunEvent{0.0, "depth", "counted", ""});
    writer.append(RunEvent{0.0, "doubt", "lost_steps", "the stage has lost steps"});
    writer.finish("stopped");
  }
  const std::string table = folder.write("relaxation.csv", relaxation_table());
  const CommandOutcome ran = run_command(
      {"fit", "indentation=" + folder.file("run.viscap"), "relaxation=" + table, "--json"});
  INFO(ran.err);
  const auto json = nlohmann::json::parse(ran.out);
  for (const char* const name : {"lost-steps", "run-stopped"}) {
    CAPTURE(name);
    CHECK(has_flag(json, name));
  }
  REQUIRE(json.contains("notes"));
  CHECK_THAT(json["notes"].dump(), Contains("indentation: the depth is counted in steps"));
}
