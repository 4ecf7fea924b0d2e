#include "rig/emulator/pty_port.h"
#include "rig/lines/who_answers.h"
#include "rig/protocols/grbl_protocol.h"
#include "rig/stages/grbl_stage.h"
#include "tests/rig/rig_fixture.h"

#include <catch2/catch.hpp>

#include <string>
#include <vector>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

// The error of a driver for GRBL on a port whose device sends this.
std::string error_of_grbl_on(const std::string& sent) {
  PtyPort device;
  const RigClock clock;
  SerialLine line(device.path(), 115200, clock);
  GrblStage stage(
      line, StageConfig{}, clock, [](const RunRecord&) {}, 0.05);
  device.write(sent);
  try {
    stage.connect([&] {
      wait_readable({&line}, clock, 0.01);
      stage.service();
    });
  } catch (const RigError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("devices that a rig cannot use are named from their first lines", "[rig]") {
  const auto [line, name] = GENERATE(table<std::string, std::string>(
      {{"echo:Marlin 2.1.2.1", "Marlin"},
       {"{\"r\":{\"fv\":0.98,\"fb\":440.20},\"f\":[1,0,0]}", "TinyG"},
       {"Smoothie", "Smoothieware"},
       {"Grbl 1.1h ['$' for help]", "swapped"},
       {"<Idle|MPos:0.000,0.000,0.000|FS:0,0>", "swapped"},
       {"@01 0 OK IDLE WR 0", "swapped"},
       {"(c)2013 Physik Instrumente (PI), C-863.11, 0, 1.2.1.0", "PI"},
       {"1VE SMC_CC V2.0.0", "Newport"},
       {"8388607", "swapped"},
       {"12.5 g", "swapped"},
       {"1042,-3126", "swapped"}}));
  CHECK_THAT(who_answers({line}), Contains(name));
}

TEST_CASE("lines that tell nothing name no device", "[rig]") {
  CHECK(who_answers({}).empty());
  CHECK(who_answers({"", " "}).empty());
  CHECK(who_answers({"hello world"}).empty());
  CHECK(who_answers({"ok", "ok"}).find("G-code") != std::string::npos);
}

TEST_CASE("a stage that speaks another protocol is quoted and named", "[rig][pty]") {
  const std::string marlin = error_of_grbl_on("start\r\necho:Marlin 2.1.2\r\n");
  CHECK_THAT(marlin,
             Contains("It sent 'start', 'echo:Marlin 2.1.2'") && Contains("This is Marlin"));
  CHECK_THAT(error_of_grbl_on("ok\r\nok\r\n"), Contains("G-code controller"));
  CHECK_THAT(error_of_grbl_on("123456\r\n123460\r\n"), Contains("swapped"));
  CHECK_THAT(error_of_grbl_on(""), Contains("Is this the stage's port"));
}

TEST_CASE("GRBL 0.9 is refused with its version, and its alarms are read", "[rig][pty]") {
  CHECK_THAT(error_of_grbl_on("Grbl 0.9j ['$' for help]\r\n"),
             Contains("runs Grbl 0.9j") && Contains("GRBL 1.1"));
  CHECK(parse_grbl_alarm("ALARM: Hard/soft limit") == 1);
  CHECK(parse_grbl_alarm("ALARM: Abort during cycle") == 3);
  CHECK(parse_grbl_alarm("ALARM:2") == 2);
}

}  // namespace viscard
