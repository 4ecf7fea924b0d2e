// What a person does at the bench between runs, through the requests of the page.
#include "io/basics/atomic_file.h"
#include "io/basics/data_folder.h"
#include "io/capture/capture_file.h"
#include "io/config/config_file.h"
#include "io/flow/rig_actions.h"
#include "io/flow/series_files.h"
#include "io/flow/table_from_capture.h"
#include "tests/io/serve/served_rig.h"
#include "tests/support/error_text.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

namespace viscard {
namespace {

using test::ApiAnswer;
using test::contains;
using test::Json;
using test::message_of;
using test::ScratchFolder;
using test::ServedRig;

// Watches a move to its end, as the page does.
Json watched(ServedRig& rig) {
  Json move;
  do {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    move = rig.ask("/api/move").json;
  } while (move.at("is_moving") == true);
  return move;
}

TEST_CASE("the page moves the stage by hand, and its force limit holds", "[serve][pty]") {
  ServedRig rig;
  REQUIRE(rig.order("/api/move", {{"how", "away"}, {"way_m", 1e-3}, {"limit_N", 0.1}}).status ==
          200);
  const Json away = watched(rig);
  INFO(away.dump());
  CHECK(away.at("trouble") == "");
  CHECK(away.at("moved").at("to_m").get<double>() - away.at("moved").at("from_m").get<double>() ==
        Approx(-1e-3).margin(5e-6));
  // The emulated specimen lies half a millimetre below.
  REQUIRE(rig.order("/api/move", {{"how", "toward"}, {"way_m", 5e-3}, {"limit_N", 0.1}}).status ==
          200);
  const Json toward = watched(rig);
  INFO(toward.dump());
  CHECK(toward.at("moved").at("is_stopped_by_force") == true);
  for (const Json& wrong : {Json{{"how", "up"}}, Json{{"how", "away"}, {"way_m", 1e-3}},
                            Json{{"how", "away"}, {"way_m", -1e-3}, {"limit_N", 0.1}},
                            Json{{"how", "toward"}, {"way_m", -1e-3}, {"limit_N", 0.1}},
                            Json{{"how", "away"}, {"way_m", 0.0}, {"limit_N", 0.1}}}) {
    CAPTURE(wrong.dump());
    CHECK(rig.order("/api/move", wrong).status == 400);
  }
  for (const Json& wrong : {Json{{"how", "away"}, {"way_m", 1.0}, {"limit_N", 0.1}},
                            Json{{"how", "away"}, {"way_m", 1e-3}, {"limit_N", 100.0}}}) {
    CAPTURE(wrong.dump());
    CHECK(rig.order("/api/move", wrong).status == 422);
  }
}

TEST_CASE("a move by hand ends when it is stopped, and when nobody watches it", "[serve][pty]") {
  ServedRig rig(1.0);
  const Json slow = {{"how", "away"}, {"way_m", 5e-3}, {"limit_N", 0.1}};  // 25 s
  const bool is_watched = GENERATE(true, false);
  REQUIRE(rig.order("/api/move", slow).status == 200);
  CHECK(rig.order("/api/move", slow).status == 409);
  CHECK(rig.order("/api/check", Json::object()).status == 409);
  const auto has_begun = [&] { return rig.ask("/api/move").json.at("force_N") != 0.0; };
  for (int i = 0; i < 1000 && !has_begun(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  REQUIRE(rig.ask("/api/move").json.at("is_moving") == true);
  if (is_watched) {
    CHECK(rig.order("/api/run/stop", {{"how", "gently"}}).status == 200);
  } else {
    std::this_thread::sleep_for(std::chrono::milliseconds(2500));
  }
  const Json move = watched(rig);
  INFO(move.dump());
  CHECK(move.at("moved").is_null());
  CHECK(move.at("position_m").get<double>() < 0.0);  // where it was stopped
  CHECK(contains(move.at("trouble"), "the move was stopped"));
  CHECK_FALSE(contains(move.at("trouble"), "recorded"));
  CHECK(move.at("position_m").get<double>() > -4e-3);
  CHECK(contains(move.at("trouble"), "half a second") == !is_watched);
  CHECK(rig.ask("/api/state").json.at("job") == "");
}

TEST_CASE("a zero that nothing keeps is refused with its reason", "[serve][pty]") {
  ServedRig rig;
  CHECK(rig.order("/api/zero", {{"what", "time"}}).status == 400);
  CHECK(contains(message_of(rig.order("/api/zero", {{"what", "position"}})),
                 "no rig file keeps the zero of an emulated stage"));
  const ApiAnswer force = rig.order("/api/zero", {{"what", "force"}});
  CHECK(force.status == 422);
  CHECK(contains(message_of(force), "has no zero that this program can set"));
  CHECK(rig.ask("/api/state").json.at("job") == "");
}

TEST_CASE("weights on the load cell make a record on the page", "[serve][pty]") {
  ServedRig rig;
  Json points = Json::array();
  for (const double mass_kg :
       {0.0, 0.05, 0.1, 0.2, 0.1, 0.05, 0.0, 0.05, 0.1, 0.2, 0.1, 0.05, 0.0}) {
    const ApiAnswer weighed = rig.order("/api/weigh", {{"mass_kg", mass_kg}, {"largest_kg", 0.2}});
    INFO(weighed.json.dump());
    REQUIRE(weighed.status == 200);
    points.push_back(weighed.json);
  }
  const ApiAnswer made = rig.order("/api/calibrate", {{"points", points}, {"gravity_m_s2", 9.81}});
  INFO(made.json.dump());
  REQUIRE(made.status == 200);
  CHECK(made.json.at("gain_V_N").get<double>() == Approx(0.7255).epsilon(2e-3));
  const std::string file = made.json.at("file");
  CHECK(std::filesystem::path(file).parent_path() == rig.folder());
  CHECK(read_calibration(file).calibration->volts_per_newton ==
        made.json.at("gain_V_N").get<double>());
  CHECK(rig.ask("/api/state").json.at("specimens").empty());  // it is none
  // Nothing is overwritten, and an emulated cell calibrates no rig.
  CHECK(rig.order("/api/calibrate", {{"points", points}}).json.at("file") != file);
  CHECK(rig.order("/api/calibrate", {{"points", points}, {"use", true}}).status == 422);
  CHECK(contains(message_of(rig.order("/api/weigh", {{"mass_kg", 5.0}, {"largest_kg", 5.0}})),
                 "above the capacity"));
  CHECK(rig.order("/api/weigh", {{"mass_kg", -1.0}, {"largest_kg", 0.2}}).status == 400);
  points[3]["mass_kg"] = 0.1;
  CHECK(contains(message_of(rig.order("/api/calibrate", {{"points", points}})),
                 "Is a weight of one series wrong"));
  CHECK(rig.order("/api/calibrate", {{"points", {{{"mass_kg", 0.1}}}}}).status == 400);
  for (const double wrong : {-1.0, 1e300}) {
    points[3]["reading_se"] = wrong;
    CHECK(rig.order("/api/calibrate", {{"points", points}}).status == 400);
  }
}

TEST_CASE("a rig file is made to name its calibration, and its old numbers stay as comments",
          "[serve]") {
  ScratchFolder scratch;
  const auto file = scratch / "rig.toml";
  write_file(file, read_file(data_folder() / "demo" / "01_rig.toml"), false);
  const RigConfig before = read_rig(file);
  CalibrationRecord record;
  record.calibration = before.calibration;
  record.calibration->volts_per_newton = 0.5;
  write_file(scratch / "cell.toml", toml_from_calibration(record), false);
  for (int i = 0; i < 2; ++i) write_calibration_file(file, "cell.toml");
  const RigConfig after = read_rig(file);
  CHECK(after.calibration.volts_per_newton == 0.5);
  CHECK(after.stage.port == before.stage.port);
  CHECK(after.frame.stiffness_N_m == before.frame.stiffness_N_m);
  CHECK(contains(read_file(file), "# volts_per_newton = \"0.7255 V/N\""));
  write_file(scratch / "none.toml", "name = \"x\"\n", false);
  CHECK_THROWS_WITH(write_calibration_file(scratch / "none.toml", "cell.toml"),
                    Catch::Contains("has no section [calibration]"));
}

TEST_CASE("every protocol is tested from the page as text", "[serve][pty]") {
  ServedRig rig;
  const std::string specimen = rig.prepare();
  const Json texts = rig.ask("/api/test").json;
  CHECK(contains(texts.at("text"), "hold"));
  CHECK(texts.at("examples").size() >= 6);
  for (const Json& example : texts.at("examples")) {
    CAPTURE(example.at("name").get<std::string>());
    const ApiAnswer course =
        rig.order("/api/preflight", {{"specimen", specimen}, {"text", example.at("text")}});
    INFO(course.json.dump());
    CHECK(course.status == 200);
    CHECK(course.json.at("course").at("time_s").size() > 5);
  }
  const std::string own =
      "# mine\nname = \"steps\"\nprotocol = \"staircase\"\n[staircase]\nsteps = 2\ndepth = \"0.05 "
      "mm\"\nhold = \"1 s\"\n[approach]\nbaseline = \"2 s\"\n";
  CHECK(rig.order("/api/test", {{"text", own}}).json.at("protocol") == "staircase");
  CHECK(read_file(rig.folder() / "test.toml") == own);
  CHECK(rig.order("/api/test", {{"text", "protocol = \"dance\"\n"}}).status == 422);
  CHECK(read_file(rig.folder() / "test.toml") == own);
  const Json shown = rig.ask("/api/state").json.at("test");
  REQUIRE(rig.order("/api/run", {{"specimen", specimen}, {"test", shown}}).status == 200);
  const Json run = rig.wait_for_run([](const Json& now) { return now.at("is_running") == false; });
  INFO(run.dump());
  CHECK(run.at("outcome").at("status") == "finished");
}

TEST_CASE("a run has a note, and is taken away unless a material was made of it", "[serve][pty]") {
  ServedRig rig;
  const std::string specimen = rig.prepare();
  const auto run = [&](bool is_repeat) {
    const Json answer = rig.order("/api/run", {{"specimen", specimen}, {"repeat", is_repeat}}).json;
    rig.wait_for_run([](const Json& now) { return now.at("is_running") == false; });
    return answer.at("file").get<std::string>();
  };
  const std::string first = run(false), second = run(true), third = run(true);
  const auto captures = [&] {
    return rig.ask("/api/state").json.at("specimens").at(0).at("captures");
  };
  CHECK(rig.order("/api/captures/note", {{"capture", second}, {"note", "wet <b>"}}).status == 200);
  CHECK(captures().at(1).at("note") == "wet <b>");
  CHECK(rig.order("/api/captures/note", {{"capture", second}, {"note", std::string(5000, 'x')}})
            .status == 400);
  CHECK(rig.order("/api/captures/note", {{"capture", "../x"}, {"note", "x"}}).status == 404);
  REQUIRE(rig.order("/api/fit", {{"capture", first}}).status == 200);
  CHECK(
      contains(message_of(rig.order("/api/captures/remove", {{"capture", first}})), "was made of"));
  REQUIRE(rig.order("/api/captures/remove", {{"capture", second}}).json.at("file") == second);
  CHECK(read_capture(rig.folder() / "trash" / second).status == "finished");
  CHECK(read_file(rig.folder() / "trash" / (second + ".note.txt")) == "wet <b>");
  // What follows it is still there, and the next run takes no name of before.
  CHECK(captures().size() == 2);
  CHECK(captures().at(1).at("file") == third);
  CHECK(run(true) == attempt_path(first, 4));
  CHECK(rig.order("/api/captures/remove", {{"capture", "none.viscap"}}).status == 404);
  // A note of the same name in the trash is not written over.
  std::filesystem::rename(rig.folder() / "trash" / second, rig.folder() / second);
  REQUIRE(rig.order("/api/captures/note", {{"capture", second}, {"note", "dry"}}).status == 200);
  CHECK(rig.order("/api/captures/remove", {{"capture", second}}).json.at("file") != second);
  CHECK(read_file(rig.folder() / "trash" / (second + ".note.txt")) == "wet <b>");
}

TEST_CASE(
    "a capture is written as a table and drawn from its contact; a fit to look at keeps nothing",
    "[serve][pty]") {
  ServedRig rig;
  const std::string specimen = rig.prepare(), file = specimen + ".viscap";
  REQUIRE(rig.order("/api/run", {{"specimen", specimen}}).status == 200);
  rig.wait_for_end();
  REQUIRE(rig.order("/api/captures/export", {{"capture", file}}).json.at("file") ==
          specimen + ".csv");
  const auto table = rig.folder() / (specimen + ".csv");
  CHECK(read_file(table) == table_from_capture(read_capture(rig.folder() / file)));
  CHECK(rig.order("/api/captures/export", {{"capture", file}}).status == 200);  // it is there
  write_file(table, "mine\n", true);
  CHECK(rig.order("/api/captures/export", {{"capture", file}}).status == 422);
  CHECK(read_file(table) == "mine\n");
  CHECK(rig.order("/api/captures/export", {{"capture", "../x"}}).status == 404);

  const Json curve = rig.order("/api/captures/curve", {{"capture", file}}).json;
  INFO(curve.dump());
  const auto time_s = curve.at("time_s").get<std::vector<double>>();
  const auto force_N = curve.at("force_N").get<std::vector<double>>();
  REQUIRE(time_s.size() == force_N.size());
  REQUIRE(time_s.size() > 100);
  CHECK(std::is_sorted(time_s.begin(), time_s.end()));
  CHECK(time_s.front() >= 0.0);
  CHECK(std::abs(force_N.front()) < 0.2);  // the zero is taken off
  CHECK(*std::max_element(force_N.begin(), force_N.end()) > 1.0);

  const Json fit = rig.order("/api/fit", {{"capture", file}, {"keep", false}}).json;
  CHECK(fit.at("material_file").is_null());
  CHECK_FALSE(std::filesystem::exists(rig.folder() / (specimen + ".json")));
  // On one clock, and about one force.
  CHECK(fit.at("curves").at("motion_start_s").at(0).get<double>() ==
        Approx(curve.at("contact_s").get<double>()).margin(3.0));
  CHECK(rig.order("/api/fit", {{"capture", file}, {"keep", "no"}}).status == 400);
}

TEST_CASE("a specimen is renamed while nothing was captured of it", "[serve][pty]") {
  ServedRig rig;
  const std::string name = rig.prepare();
  const ApiAnswer renamed =
      rig.order("/api/specimens/rename", {{"name", name}, {"id", "PDMS 1:13"}});
  INFO(renamed.json.dump());
  REQUIRE(renamed.status == 200);
  CHECK(renamed.json.at("name") == "01_pdms-1-13");
  CHECK(read_specimen(rig.folder() / "01_pdms-1-13.toml").id == "PDMS 1:13");
  CHECK_FALSE(std::filesystem::exists(rig.folder() / (name + ".toml")));
  CHECK(rig.order("/api/specimens/rename", {{"name", "01_pdms-1-13"}, {"id", ""}}).status != 200);
  CHECK(rig.order("/api/specimens/rename", {{"name", "01_pdms-1-13"}, {"id", "a\nb"}}).status ==
        400);
  // A name without a number does not become the test or the rig, and comments stay.
  const auto own = rig.folder() / "mine.toml";
  write_file(own, "# glued twice\n" + read_file(rig.folder() / "01_pdms-1-13.toml"), false);
  const Json as_test = rig.order("/api/specimens/rename", {{"name", "mine"}, {"id", "Test"}}).json;
  CHECK(as_test.at("name") == "specimen-test");
  CHECK(contains(read_file(rig.folder() / "specimen-test.toml"), "# glued twice"));
  CHECK(rig.order("/api/specimens/rename", {{"name", "specimen-test"}, {"id", "Rig"}})
            .json.at("name") == "specimen-rig");
  write_file(rig.folder() / "01_z.truth.toml", "x = 1\n", false);
  CHECK(rig.order("/api/specimens/rename", {{"name", "01_pdms-1-13"}, {"id", "z"}}).status == 409);
  CHECK(read_file(rig.folder() / "01_z.truth.toml") == "x = 1\n");
  CHECK(rig.order("/api/specimens/rename", {{"name", "../x"}, {"id", "y"}}).status == 404);
  REQUIRE(rig.order("/api/run", {{"specimen", "01_pdms-1-13"}}).status == 200);
  rig.wait_for_run([](const Json& now) { return now.at("is_running") == false; });
  CHECK(contains(
      message_of(rig.order("/api/specimens/rename", {{"name", "01_pdms-1-13"}, {"id", "z"}})),
      "has captures"));
}

}  // namespace
}  // namespace viscard
