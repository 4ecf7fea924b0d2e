#include "rig/protocols/grbl_protocol.h"

#include <catch2/catch.hpp>

#include <string>

namespace viscard {
namespace {

using Catch::Matchers::Contains;

}  // namespace

TEST_CASE("a status report is read with its fields in any order", "[rig]") {
  const auto status = parse_grbl_status(
      "<Jog|WCO:1.000,2.000,3.000|FS:30,0|TLR:0|A:|MPos:0.000,0.000,-0.252|Bf:15,128|Pn:Z>\r\n");
  REQUIRE(status);
  CHECK(status->state == "Jog");
  CHECK(status->substate == -1);
  CHECK(status->machine_mm == std::vector<double>{0.0, 0.0, -0.252});
  CHECK(status->work_offset_mm == std::vector<double>{1.0, 2.0, 3.0});
  CHECK(status->planner_blocks_free == 15);
  CHECK(status->feed_mm_min == 30.0);
  CHECK(status->pins == "Z");
}

TEST_CASE("work positions, sub-states and more than three axes are read", "[rig]") {
  const auto held = parse_grbl_status("<Hold:1|WPos:1.5,2.5,3.5,4.5|F:0>");
  REQUIRE(held);
  CHECK(held->state == "Hold");
  CHECK(held->substate == 1);
  CHECK(held->machine_mm.empty());
  CHECK(held->work_mm.size() == 4);
}

TEST_CASE("a line that is no status report is refused", "[rig]") {
  const std::string line =
      GENERATE("", "<>", "<Idle>", "<Idle|MPos:1,2,3", "Idle|MPos:1,2,3>", "<Id1e|MPos:1,2,3>",
               "<Idle|MPos:1,2,x>", "<Idle|MPos:0.000,0.0<Idle|MPos:0,0,0>", "ok");
  INFO(line);
  CHECK_FALSE(parse_grbl_status(line));
}

TEST_CASE("answers, alarms and welcomes of both dialects are distinguished", "[rig]") {
  CHECK(is_grbl_ok("ok\r"));
  CHECK_FALSE(is_grbl_ok("[MSG:ok]"));
  CHECK_FALSE(is_grbl_ok(">G54:ok"));
  CHECK(parse_grbl_error("error:15").value() == 15);
  CHECK_FALSE(parse_grbl_error("error:"));
  CHECK(parse_grbl_alarm("ALARM:1").value() == 1);
  const auto grbl = parse_grbl_welcome("Grbl 1.1h ['$' for help]");
  REQUIRE(grbl);
  CHECK_FALSE(grbl->is_hal);
  CHECK(grbl->version == "1.1h");
  const auto hal = parse_grbl_welcome("GrblHAL 1.1f ['$' or '$HELP' for help]");
  REQUIRE(hal);
  CHECK(hal->is_hal);
  CHECK_FALSE(parse_grbl_welcome("Grblx"));
}

TEST_CASE("alarms from 10 on have the meaning that the firmware gives them", "[rig]") {
  const bool is_hal = GENERATE(false, true);
  CHECK_THAT(grbl_alarm_text(1, is_hal), Contains("alarm 1: a limit switch was hit"));
  CHECK_THAT(grbl_alarm_text(9, is_hal), Contains("found no limit switch"));
  CHECK_THAT(grbl_alarm_text(10, is_hal),
             is_hal ? Contains("emergency stop") : Contains("second limit switch"));
  CHECK_THAT(grbl_alarm_text(11, true), Contains("homed first"));
  CHECK_THAT(grbl_alarm_text(12, true), Contains("a limit switch is pressed"));
  CHECK_THAT(grbl_alarm_text(17, true), Contains("motor driver reports a fault"));
  CHECK(grbl_alarm_text(17, false) == "alarm 17");
}

TEST_CASE("lines that answer nothing are distinguished from answers", "[rig]") {
  for (const char* push :
       {"<Idle|MPos:0,0,0>", "[MSG:Caution: Unlocked]", "[GC:G0 G54]", "[PRB:0,0,0:1]", "$0=10",
        "ALARM:3", ">G54:ok", "", "\r", "Grbl 1.1h ['$' for help]"}) {
    INFO(push);
    CHECK(is_grbl_push(push));
  }
  CHECK_FALSE(is_grbl_push("ok"));
  CHECK_FALSE(is_grbl_push("error:9"));
}

TEST_CASE("settings and messages are read", "[rig]") {
  const auto setting = parse_grbl_setting("$102=3200.000");
  REQUIRE(setting);
  CHECK(setting->number == 102);
  CHECK(setting->value == 3200.0);
  CHECK(parse_grbl_setting("$1=25 (step idle delay, msec)")->value == 25.0);
  CHECK_FALSE(parse_grbl_setting("$N0=G54"));
  CHECK(parse_grbl_message("[MSG:Reset to continue]").value() == "Reset to continue");
}

TEST_CASE("the letters of a build show whether it homes one axis alone", "[rig]") {
  CHECK(parse_grbl_build_options("[OPT:VH,15,128]").value() == "VH");
  CHECK(parse_grbl_build_options("[OPT:VNMH,35,1024,3,0]\r").value() == "VNMH");
  CHECK(parse_grbl_build_options("[OPT:,15,128]").value().empty());
  CHECK_FALSE(parse_grbl_build_options("[VER:1.1h.20190830:HOME]"));
}

TEST_CASE("a jog fits GRBL's line buffer and does not depend on the locale", "[rig]") {
  CHECK(format_grbl_jog('Z', -1.23456, 7.8) == "$J=G53G90G21Z-1.23456F7.800");
  CHECK(format_grbl_jog('X', -123.456789, 12345.678).size() < 80);
}

}  // namespace viscard
