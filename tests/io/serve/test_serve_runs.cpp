// Runs on the emulated rig, started, watched and stopped as the page does it.
#include "io/basics/atomic_file.h"
#include "io/capture/capture_file.h"
#include "io/config/config_file.h"
#include "io/materials/material_file.h"
#include "tests/io/serve/served_rig.h"
#include "tests/support/error_text.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <thread>
#include <vector>

namespace viscard {
namespace {

using test::contains;
using test::Json;
using test::ServedRig;

double largest(const Json& values) {
  double most = 0.0;
  for (const Json& value : values) most = std::max(most, value.get<double>());
  return most;
}

// The stage stands above the contact when a run has ended.
bool is_punch_lifted(const std::filesystem::path& file) {
  const CapturedRun run = read_capture(file);
  double contact_m = 0.0;
  for (const RunEvent& event : run.events) {
    if (event.name == "contact") contact_m = std::stod(event.value);
  }
  REQUIRE(contact_m > 0.0);
  REQUIRE_FALSE(run.stage_reports.empty());
  return run.stage_reports.back().position_m < contact_m - 0.1e-3;
}

TEST_CASE("a run that the page starts is captured, fitted, and found again in the folder",
          "[serve][pty]") {
  ServedRig rig;
  const std::string name = rig.prepare();
  CHECK(name == "01_pdms-1-10");
  REQUIRE(rig.order("/api/run", {{"specimen", name}}).json.at("file") == name + ".viscap");
  const auto second = rig.order("/api/run", {{"specimen", name}});
  CHECK(second.status == 409);
  CHECK(second.json.at("error").at("code") == "busy");
  CHECK(contains(second.json.at("error").at("message"), "the run of " + name + " must end"));

  CHECK(rig.ask("/api/state").json.at("specimens").at(0).at("state") == "running");
  const Json run = rig.wait_for_end();
  INFO(run.dump());
  CHECK(run.at("number") == 1);
  REQUIRE(run.at("outcome").at("status") == "finished");
  const Json& points = run.at("points");
  CHECK(largest(points.at("force_N")) > 1.0);
  CHECK(largest(points.at("depth_m")) == Approx(0.13e-3).margin(0.02e-3));
  CHECK(points.at("time_s").size() == points.at("force_N").size());
  CHECK(read_capture(rig.folder() / (name + ".viscap")).status == "finished");
  // Only what is new is sent again.
  const std::size_t n = points.at("time_s").size();
  const Json rest = rig.ask("/api/run?from=" + std::to_string(n - 3) +
                            "&keep_every=" + std::to_string(points.at("keep_every").get<int>()))
                        .json.at("points");
  CHECK(rest.at("from") == n - 3);
  CHECK(rest.at("time_s").size() == 3);

  const auto fit = rig.order("/api/fit", {{"capture", name + ".viscap"}});
  INFO(fit.json.dump());
  REQUIRE(fit.status == 200);
  CHECK(fit.json.at("E0_Pa").get<double>() == Approx(1.88e6).epsilon(0.05));
  CHECK(fit.json.at("curves").at("measured").size() == fit.json.at("curves").at("fitted").size());
  CHECK(std::filesystem::exists(rig.folder() / (name + ".json")));
  const Json state = rig.ask("/api/state").json;
  CHECK(state.at("specimens").at(0).at("state") == "finished");
  CHECK(state.at("specimens").at(0).at("material").at("E0_Pa") == fit.json.at("E0_Pa"));
  CHECK(state.at("next").is_null());

  CHECK(rig.order("/api/run", {{"specimen", name}}).json.at("error").at("code") == "finished");
}

TEST_CASE("stop ends the run, lifts the punch and keeps the record", "[serve][pty]") {
  const std::string how = GENERATE("gently", "at once");
  ServedRig rig(20.0);
  const std::string name = rig.prepare();
  REQUIRE(rig.order("/api/test", {{"test", {{"hold_s", 600.0}}}}).status == 200);
  REQUIRE(rig.order("/api/run", {{"specimen", name}}).status == 200);
  REQUIRE(rig.wait_for_force(0.5).at("is_running") == true);
  REQUIRE(rig.order("/api/run/stop", {{"how", how}}).status == 200);
  const Json run = rig.wait_for_end();
  INFO(run.dump());
  CHECK(run.at("outcome").at("status") == "interrupted");
  CHECK(run.at("outcome").at("error").at("code") == "interrupted");
  CHECK(contains(run.at("outcome").at("reason"), "above the contact"));
  CHECK(read_capture(rig.folder() / (name + ".viscap")).status == "interrupted");
  CHECK(is_punch_lifted(rig.folder() / (name + ".viscap")));
  CHECK(rig.order("/api/run/stop", {{"how", how}}).json.at("error").at("code") == "no-run");
}

TEST_CASE("a run goes on while no page watches it, and ends when the program does",
          "[serve][pty]") {
  test::ScratchFolder scratch;
  std::string name;
  {
    RigServer server({.folder = scratch.path(), .is_emulated = true, .speed = 20.0});
    httplib::Client client("127.0.0.1", server.port());
    client.set_default_headers({{"X-Viscard-Token", server.token()}});
    const auto order = [&](const char* path, const Json& body) {
      return Json::parse(client.Post(path, body.dump(), "application/json")->body);
    };
    name = order("/api/specimens", {{"specimen", ServedRig::specimen()}}).at("name");
    order("/api/run", {{"specimen", name}});
    client.stop();
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    CHECK(server.last_run().is_running);
    server.close();
    CHECK_FALSE(server.last_run().is_running);
    REQUIRE(server.last_run().outcome);
    CHECK(server.last_run().outcome->status == "interrupted");
  }
  CHECK(read_capture(scratch / (name + ".viscap")).status == "interrupted");
}

TEST_CASE("after a crash the folder shows what to run again, in a new file", "[serve][pty]") {
  ServedRig rig;
  const std::string name = rig.prepare();
  {
    CapturedRun about;
    about.plan = read_test(rig.folder() / "test.toml");
    about.specimen = read_specimen(rig.folder() / (name + ".toml"));
    const CaptureWriter writer(rig.folder() / (name + ".viscap"), about);  // never finished
    const Json running = rig.ask("/api/state").json.at("specimens").at(0);
    CHECK(running.at("state") == "running");
    const auto refused = rig.order("/api/run", {{"specimen", name}});
    CHECK(refused.status == 422);
    CHECK(contains(refused.json.at("error").at("message"), "is being written by another capture"));
  }
  const Json state = rig.ask("/api/state").json;
  CHECK(state.at("specimens").at(0).at("state") == "interrupted");
  CHECK(state.at("next") == name);
  REQUIRE(rig.order("/api/run", {{"specimen", name}}).json.at("file") == name + ".2.viscap");
  CHECK(rig.wait_for_end().at("outcome").at("status") == "finished");
  CHECK(rig.ask("/api/state").json.at("specimens").at(0).at("state") == "finished");
}

TEST_CASE("of two pages that start at the same moment one is refused", "[serve][pty]") {
  ServedRig rig;
  const std::string name = rig.prepare();
  std::vector<int> statuses(4, 0);
  std::vector<std::thread> pages;
  for (int& status : statuses) {
    pages.emplace_back([&] {
      httplib::Client client("127.0.0.1", rig.server().port());
      client.set_default_headers({{"X-Viscard-Token", rig.server().token()}});
      const Json wanted = {{"specimen", name}};
      status = client.Post("/api/run", wanted.dump(), "application/json")->status;
    });
  }
  for (std::thread& page : pages) page.join();
  std::sort(statuses.begin(), statuses.end());
  CHECK(statuses == std::vector<int>{200, 409, 409, 409});
  CHECK(rig.wait_for_end().at("outcome").at("status") == "finished");
  CHECK_FALSE(std::filesystem::exists(rig.folder() / (name + ".2.viscap")));
}

TEST_CASE("a material that cannot be saved does not hide the fit", "[serve][pty]") {
  ServedRig rig;
  const std::string name = rig.prepare();
  REQUIRE(rig.order("/api/run", {{"specimen", name}}).status == 200);
  REQUIRE(rig.wait_for_end().at("outcome").at("status") == "finished");
  std::filesystem::create_symlink("nowhere/else", rig.folder() / (name + ".json"));
  const auto fit = rig.order("/api/fit", {{"capture", name + ".viscap"}});
  INFO(fit.json.dump());
  CHECK(fit.status == 200);
  CHECK(fit.json.at("E0_Pa").get<double>() == Approx(1.88e6).epsilon(0.05));
  CHECK(fit.json.at("material_file").is_null());
  CHECK(contains(fit.json.at("material_trouble"), name + ".json"));
}

TEST_CASE("the material of another record is not stated as that of this run", "[serve][pty]") {
  ServedRig rig;
  const std::string name = rig.prepare();
  REQUIRE(rig.order("/api/run", {{"specimen", name}}).status == 200);
  REQUIRE(rig.wait_for_end().at("outcome").at("status") == "finished");
  const Json wanted = {{"capture", name + ".viscap"}};
  for (int i = 0; i < 2; ++i)
    CHECK(rig.order("/api/fit", wanted).json.at("material_file") == name + ".json");
  // Nor is that of another version, whose numbers may differ, or one that was edited.
  const std::filesystem::path file = rig.folder() / (name + ".json");
  const std::string own = read_file(file);
  MaterialFile older = read_material(file);
  older.material.provenance.created_by = "viscard 0.0.1";
  older.material.E0_Pa *= 1.1;
  std::string edited = own;
  edited.insert(edited.find_first_of("0123456789", edited.find("\"E0_Pa\":") + 8), "1");
  for (const auto& [text, why] :
       {std::pair{json_from_material(older), "was written by viscard 0.0.1, and this is viscard "},
        {edited, "was edited since it was written; rename it"}}) {
    write_file(file, text, true);
    const auto kept = rig.order("/api/fit", wanted);
    INFO(kept.json.dump());
    CHECK(kept.json.at("material_file").is_null());
    CHECK(contains(kept.json.at("material_trouble"), why));
    CHECK(read_file(file) == text);
  }
  std::filesystem::copy_file(VISCARD_SOURCE_DIR "/data/materials/pdms_1to10_seed.json",
                             rig.folder() / (name + ".json"),
                             std::filesystem::copy_options::overwrite_existing);
  const auto fit = rig.order("/api/fit", wanted);
  INFO(fit.json.dump());
  CHECK(fit.json.at("material_file").is_null());
  CHECK(contains(fit.json.at("material_trouble"), "is the material of another record"));
}

TEST_CASE("the page checks the rig without moving anything", "[serve][pty]") {
  ServedRig rig(1.0);
  const auto found = rig.order("/api/check", Json::object());
  INFO(found.json.dump());
  REQUIRE(found.status == 200);
  CHECK(found.json.at("is_usable") == true);
  CHECK(found.json.at("load_cell").at("rate_Hz").get<double>() == Approx(80.0).epsilon(0.05));
}

}  // namespace
}  // namespace viscard
