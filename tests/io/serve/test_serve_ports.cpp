// A rig whose ports are missing, or go away during a run.
#include "io/basics/atomic_file.h"
#include "io/capture/capture_file.h"
#include "rig/emulator/demo_rig.h"
#include "rig/emulator/emulated_rig.h"
#include "tests/io/serve/served_rig.h"
#include "tests/support/error_text.h"

#include <catch2/catch.hpp>
#include <sys/stat.h>

#include <filesystem>

namespace viscard {
namespace {

using test::contains;
using test::Json;
using test::ServedRig;

// The rig file of the demonstration with other ports.
std::string rig_file(const test::ScratchFolder& scratch, const std::string& stage,
                     const std::string& load_cell) {
  std::string text = read_file(VISCARD_SOURCE_DIR "/data/demo/01_rig.toml");
  const auto put = [&](const std::string& old, const std::string& port) {
    text.replace(text.find(old), old.size(), port);
  };
  put("/dev/serial/by-id/stage", stage);
  put("/dev/serial/by-id/load_cell", load_cell);
  write_file(scratch / "rig.toml", text, true);
  return (scratch / "rig.toml").string();
}

TEST_CASE("ports that do not exist are named before, in a check and in a run", "[serve]") {
  test::ScratchFolder scratch;
  ServedRig rig(
      ServeOptions{.rig_file = rig_file(scratch, "/dev/viscard-none", "/dev/viscard-none-2")});
  const std::string name = rig.prepare();
  const Json shown = rig.ask("/api/state").json.at("rig");
  CHECK_FALSE(shown.at("stage").at("trouble").get<std::string>().empty());
  CHECK_FALSE(shown.at("load_cell").at("trouble").get<std::string>().empty());
  const auto check = rig.order("/api/check", Json::object());
  CHECK(check.status == 422);
  CHECK(check.json.at("error").at("code") == "port");
  CHECK(check.json.at("error").at("where") == "/dev/viscard-none");
  for (const int number : {1, 2}) {
    REQUIRE(rig.order("/api/run", {{"specimen", name}}).status == 200);
    const Json run = rig.wait_for_end();
    INFO(run.dump());
    CHECK(run.at("number") == number);  // the page sees that this is another run
    CHECK(run.at("outcome").is_null());
    CHECK(run.at("error").at("code") == "port");
    CHECK(contains(run.at("trouble"), "/dev/viscard-none"));
  }
  CHECK_FALSE(std::filesystem::exists(rig.folder() / (name + ".viscap")));
  CHECK(rig.ask("/api/state").json.at("job") == "");
}

TEST_CASE("the rig file is set up from the page, and the text of before stays beside it",
          "[serve]") {
  test::ScratchFolder scratch;
  const std::string file = rig_file(scratch, "/dev/viscard-none", "/dev/viscard-none-2");
  const std::string before = read_file(file);
  ServedRig rig(ServeOptions{.rig_file = file});
  const Json shown = rig.ask("/api/rig").json;
  CHECK(shown.at("text") == before);
  CHECK(shown.at("is_kept") == true);
  CHECK(shown.at("stage_drivers").size() >= 6);
  std::string other = before;
  other.replace(other.find("/dev/viscard-none"), 17, "tcp://10.0.0.1:23");
  SECTION("a text is looked at without a change") {
    CHECK(rig.order("/api/rig", {{"text", other}}).status == 200);
    CHECK(read_file(file) == before);
  }
  SECTION("what is no rig is refused with its line, and nothing is written") {
    std::string wrong = other;
    wrong.replace(wrong.find("driver = \"grbl\""), 15, "driver = \"gerbil\"");
    for (const std::string& text :
         {wrong, other + "[stage]\n", std::string("x = "), std::string(60000, '#')}) {
      const auto answer = rig.order("/api/rig", {{"text", text}, {"keep", true}});
      INFO(answer.json.dump());
      CHECK(answer.status >= 400);
    }
    CHECK(read_file(file) == before);
    CHECK_FALSE(std::filesystem::exists(file + ".1"));
  }
  SECTION("a file that somebody else changed meanwhile is not overwritten") {
    write_file(file, before + "# by hand\n", true);
    const auto answer =
        rig.order("/api/rig", {{"text", other}, {"based_on", before}, {"keep", true}});
    CHECK(answer.status == 409);
    CHECK(read_file(file) == before + "# by hand\n");
  }
  SECTION("a link to the file stays a link") {
    const std::string real = file + ".real";
    std::filesystem::rename(file, real);
    std::filesystem::create_symlink(real, file);
    CHECK(rig.order("/api/rig", {{"text", other}, {"based_on", before}, {"keep", true}}).status ==
          200);
    CHECK(std::filesystem::is_symlink(file));
    CHECK(read_file(real) == other);
  }
  SECTION("a pipe in its place does not hold up the page") {
    std::filesystem::remove(file);
    REQUIRE(::mkfifo(file.c_str(), 0600) == 0);
    CHECK(rig.ask("/api/rig").status >= 400);
    CHECK(rig.ask("/api/state").status == 200);  // with the trouble in words
  }
  SECTION("it is kept, more than once") {
    CHECK(rig.order("/api/rig", {{"text", other}, {"keep", true}}).json.at("kept_before") ==
          "rig.toml.1");
    CHECK(read_file(file) == other);
    CHECK(read_file(file + ".1") == before);
    CHECK(rig.ask("/api/state").json.at("rig").at("stage").at("port") == "tcp://10.0.0.1:23");
    CHECK(rig.order("/api/rig", {{"text", before}, {"keep", true}}).json.at("kept_before") ==
          "rig.toml.2");
    CHECK(rig.order("/api/rig", {{"text", before}, {"keep", true}}).json.at("kept_before") == "");
  }
}

TEST_CASE("the rig of the demonstration is shown and not changed", "[serve]") {
  ServedRig rig;
  const Json shown = rig.ask("/api/rig").json;
  CHECK(shown.at("is_kept") == false);
  CHECK(rig.order("/api/rig", {{"text", shown.at("text")}}).status == 200);
  CHECK(rig.order("/api/rig", {{"text", shown.at("text")}, {"keep", true}}).status == 422);
}

TEST_CASE("a port that goes away ends the run; the record is kept and the next start names it",
          "[serve][pty]") {
  test::ScratchFolder scratch;
  auto bench = std::make_unique<EmulatedRig>(EmulatedRigOptions{
      .truth = demo_truth(10.0, 7), .config = demo_rig(), .is_on_wall_clock = true});
  ServedRig rig(
      ServeOptions{.rig_file = rig_file(scratch, bench->stage_port(), bench->load_cell_port())});
  const std::string name = rig.prepare();
  REQUIRE(rig.order("/api/run", {{"specimen", name}}).status == 200);
  const Json before = rig.wait_for_run([](const Json& run) {
    return !run.at("is_running").get<bool>() || run.at("phase") == "approach";
  });
  INFO(before.dump());
  REQUIRE(before.at("phase") == "approach");
  bench.reset();
  const Json run = rig.wait_for_end();
  INFO(run.dump());
  REQUIRE(run.at("is_running") == false);
  CHECK(run.at("outcome").at("status") == "interrupted");
  CHECK(run.at("outcome").at("error").at("code") == "device-lost");
  CHECK(read_capture(rig.folder() / (name + ".viscap")).status == "interrupted");
  const Json state = rig.ask("/api/state").json;
  CHECK(state.at("job") == "");
  CHECK(state.at("specimens").at(0).at("state") == "interrupted");
  CHECK_FALSE(state.at("rig").at("stage").at("trouble").get<std::string>().empty());
  REQUIRE(rig.order("/api/run", {{"specimen", name}}).status == 200);
  CHECK(rig.wait_for_end().at("error").at("code") == "port");
}

}  // namespace
}  // namespace viscard
